// A block of contact points behind VFRIC's argument list.
#include "driver.h"

#include <cmath>

#include "../abaqus/explicit.h"
#include "../abaqus/explicit_driver.h"
#include "call.h"

namespace frictab::abaqus_vfric {

namespace {

template <class Real> class Block : public abaqus::ExplicitBlock {
public:
  Block(void* function, const std::vector<SolverInput>& inputs) : function_(function) {
    call_.properties.assign(property_count(inputs), Real(0));
    call_.temperatures = true;
    call_.states = static_cast<int>(abaqus::state_count(inputs));
    call_.time_increment = Real(abaqus::driver_increment);
  }

  void resize(std::size_t points, std::size_t fields) override {
    call_.predefined = static_cast<int>(fields);
    call_.resize(static_cast<int>(points), static_cast<int>(points) + 3);
    for (std::size_t k = 0; k < points; ++k) {
      call_.node[k] = static_cast<int>(points - k) + 2; // backwards, and not from the first node
      call_.area[node(k)] = static_cast<Real>(area(k));
    }
  }
  void property(std::size_t number, double value) override {
    call_.properties[number] = static_cast<Real>(value);
  }
  void pressure(std::size_t k, double value) override {
    call_.normal[k] = static_cast<Real>(value * area(k));
  }
  void speed(std::size_t k, double value) override {
    call_.slip[3 * k] = static_cast<Real>(value * abaqus::driver_increment);
  }
  void temperature(std::size_t k, double value) override {
    call_.temperature[k] = call_.temperature_main[k] = static_cast<Real>(value);
  }
  void field(std::size_t number, std::size_t k, double value) override {
    const std::size_t at = number * static_cast<std::size_t>(call_.contacts) + k;
    call_.field[at] = call_.field_main[at] = static_cast<Real>(value);
  }
  void history(std::size_t k, double slip, double work, double peak,
               std::span<const double> further) override {
    const double before = slip - std::abs(static_cast<double>(call_.slip[3 * k]));
    abaqus::put_history(&call_.state[static_cast<std::size_t>(call_.states) * node(k)], before,
                        work, peak, further);
  }
  void run() override { call_.run(function_); }
  double stress(std::size_t k) const override {
    return -static_cast<double>(call_.tangential[2 * k]) / area(k);
  }

private:
  std::size_t node(std::size_t k) const { return static_cast<std::size_t>(call_.node[k]) - 1; }
  double area(std::size_t k) const { return abaqus::driver_area(node(k)); }

  void* function_;
  VfricCall<Real> call_;
};

} // namespace

void drive(const Built& built, const SolverGives& gives, const ExportRequest& request,
           std::size_t rows, std::span<const double* const> columns, std::span<double> tau) {
  abaqus::drive_blocks<Block>("vfric_", built, gives, request, rows, columns, tau);
}

} // namespace frictab::abaqus_vfric
