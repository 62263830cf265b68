// Makes each row of states the first increment of a contact point that already slips.
#include "driver.h"

#include <algorithm>
#include <cmath>

#include "../abaqus/standard.h"
#include "call.h"
#include "codegen/compile.h"
#include "codegen/driver_rows.h"
#include "codegen/histories.h"
#include "source.h"

namespace frictab::abaqus_fric {

namespace {

// A power of two: dividing by it changes no bits, so what the routine sees is the row's state.
constexpr double time_increment = 0x1p-30;
// Any motion is more than this share of a slip.
constexpr double critical_slip = 0x1p-50;

class Point {
public:
  Point(void* function, const ExportRequest& request)
      : function_(function), inputs_(solver_inputs(request, gives())),
        stress_(solver_unit("MPa", request.units)), work_over_(abaqus::work_over(request.units)) {
    call_.properties.assign(property_count(inputs_) + 1, 0);
    call_.properties.back() = critical_slip;
    call_.time_increment = time_increment;
    call_.states = static_cast<int>(abaqus::states_size(state_count(inputs_)));
    for (const SolverInput& input : inputs_)
      call_.predefined = std::max(call_.predefined, static_cast<int>(input.field));
  }

  bool posed(std::size_t row, std::span<const double* const> columns) const {
    return frictab::posed(inputs_, columns, row, abaqus::any_pressure);
  }

  // Every other row slips in two directions.
  double tau(std::size_t row, std::span<const double* const> columns) {
    call_.directions = row % 2 ? 2 : 1;
    call_.mode = 0;
    call_.pressure = stress_.from_canonical(abaqus::any_pressure);
    call_.resize();
    const double along = call_.directions == 2 ? 0.6 : 1, across = 0.8;
    speed_ = 0;
    for (std::size_t c = 0; c < columns.size(); ++c)
      set(inputs_[c], columns[c][row]);
    const std::vector<double> past = history_values(inputs_, columns, row);
    std::copy(past.begin(), past.end(), call_.state.begin() + history);
    const double motion = speed_ * time_increment;
    call_.motion[0] = along * motion;
    call_.state[4] = along * critical_slip; // it slipped before, in this direction
    if (call_.directions == 2) {
      call_.motion[1] = across * motion;
      call_.state[5] = across * critical_slip;
    }
    call_.state[0] -= motion; // what was slipped before this increment
    call_.run(function_);
    const double result =
        call_.directions == 2 ? std::hypot(call_.tau[0], call_.tau[1]) : call_.tau[0];
    return stress_.to_canonical(result);
  }

private:
  void set(const SolverInput& input, double canonical) {
    const double value = input.argument.solver.from_canonical(canonical);
    switch (input.source) {
    case Source::pressure:
      call_.pressure = value;
      break;
    case Source::speed:
      speed_ = value;
      break;
    case Source::slip:
      call_.state[0] = value;
      break;
    case Source::work:
      call_.state[1] = canonical * work_over_;
      break;
    case Source::peak_pressure:
      call_.state[2] = stress_.from_canonical(canonical);
      break;
    case Source::temperature:
      call_.temperature[0] = call_.temperature[1] = value;
      break;
    case Source::field:
      call_.field[2 * input.field - 2] = call_.field[2 * input.field - 1] = value;
      break;
    case Source::property:
      call_.properties[input.property - 1] = value;
      break;
    default:
      break; // constants are in the source
    }
  }

  void* function_;
  std::vector<SolverInput> inputs_;
  SolverUnit stress_;
  double work_over_;
  double speed_ = 0;
  FricCall call_;
};

} // namespace

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau) {
  Point point(Library::address(built.library, "fric_"), request);
  for (std::size_t row = 0; row < rows; ++row)
    if (point.posed(row, columns)) tau[row] = point.tau(row, columns);
}

} // namespace frictab::abaqus_fric
