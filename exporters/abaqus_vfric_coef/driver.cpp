// A block of contact points behind VFRIC_COEF's argument list.
#include "driver.h"

#include "../abaqus/explicit_driver.h"
#include "call.h"

namespace frictab::abaqus_vfric_coef {

namespace {

template <class Real> class Block : public abaqus::ExplicitBlock {
public:
  Block(void* function, const std::vector<SolverInput>& inputs) : function_(function) {
    call_.properties.assign(property_count(inputs), Real(0));
    call_.temperatures = true;
  }

  void resize(std::size_t points, std::size_t fields) override {
    call_.fields = static_cast<int>(fields);
    call_.resize(static_cast<int>(points));
  }
  void property(std::size_t number, double value) override {
    call_.properties[number] = static_cast<Real>(value);
  }
  void pressure(std::size_t k, double value) override {
    call_.pressure[k] = static_cast<Real>(value);
  }
  void speed(std::size_t k, double value) override {
    call_.slip_rate[k] = static_cast<Real>(value);
  }
  void temperature(std::size_t k, double value) override {
    call_.temperature[k] = static_cast<Real>(value);
  }
  void field(std::size_t number, std::size_t k, double value) override {
    call_.field[number * static_cast<std::size_t>(call_.points) + k] = static_cast<Real>(value);
  }
  void run() override { call_.run(function_); }
  double stress(std::size_t k) const override {
    return static_cast<double>(call_.coefficient[k]) * static_cast<double>(call_.pressure[k]);
  }

private:
  void* function_;
  VfricCoefCall<Real> call_;
};

} // namespace

void drive(const Built& built, const SolverGives& gives, const ExportRequest& request,
           std::size_t rows, std::span<const double* const> columns, std::span<double> tau) {
  abaqus::drive_blocks<Block>("vfric_coef_", built, gives, request, rows, columns, tau);
}

} // namespace frictab::abaqus_vfric_coef
