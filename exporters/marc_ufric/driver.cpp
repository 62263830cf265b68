// UFRIC's argument list as the Fortran compiler passes it: all by reference.
#include "driver.h"

#include <cmath>
#include <numbers>

#include "codegen/compile.h"
#include "source.h"

namespace frictab::marc_ufric {

namespace {

using Ufric = void (*)(int*, double*, double*, double*, double*, double*, double*, double*, int*,
                       int*);

// Where no state says otherwise: there is contact, and a flow stress.
constexpr double some_pressure = 1, some_flow_stress = 480; // MPa

} // namespace

double UfricCall::run(void* function) const {
  int body[4] = {11, 2, 1, 7}, increment = 1, touched = touched_body;
  double coordinates[3] = {0, 0, 0}, fn = normal, yield = flow_stress, time = 0, result = 777;
  double speed[2] = {slip[0], slip[1]}, field[2] = {temperature[0], temperature[1]};
  reinterpret_cast<Ufric>(function)(body, coordinates, &fn, speed, field, &yield, &result, &time,
                                    &increment, &touched);
  return result;
}

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau) {
  void* function = Library::address(built.library, "ufric_");
  auto* constants = static_cast<double*>(Library::address(built.library, "ftcons_"));
  const std::vector<SolverInput> inputs = solver_inputs(request, gives());
  const Choices chosen = choices(request);
  const SolverUnit stress = solver_unit("MPa", request.units);
  for (std::size_t r = 0; r < rows; ++r) {
    UfricCall call;
    double pressure = some_pressure, flow = some_flow_stress;
    for (std::size_t c = 0; c < inputs.size(); ++c) {
      const double value = columns[c][r];
      const double solver = inputs[c].argument.solver.from_canonical(value);
      if (inputs[c].source == Source::pressure) pressure = value;
      if (inputs[c].source == Source::flow_stress) flow = value;
      if (inputs[c].source == Source::speed) call.slip[0] = solver;
      if (inputs[c].source == Source::temperature) call.temperature[0] = solver;
      if (inputs[c].source == Source::constant) constants[c] = value;
    }
    call.normal = stress.from_canonical(pressure);
    call.flow_stress = stress.from_canonical(flow);
    const double over = chosen.coefficient == fortran::Coefficient::coulomb
                            ? std::abs(pressure)
                            : flow * std::numbers::inv_sqrt3;
    tau[r] = call.run(function) * over;
  }
}

} // namespace frictab::marc_ufric
