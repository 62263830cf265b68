// USRBCC's argument list and COMMON blocks as the Fortran compiler lays them out.
#include "driver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "codegen/compile.h"
#include "codegen/driver_rows.h"
#include "codegen/histories.h"
#include "source.h"

namespace frictab::deform_usrbcc {

namespace {

using Usrbcc = void (*)(double*, int*, int*, int*, int*, int*, double*, double*, double*, int*,
                        double*, double*, double*, double*, int*, int*, int*, int*);

// Where no state says otherwise: there is contact, and a flow stress.
constexpr double some_pressure = 1, some_flow_stress = 480; // MPa

// The states of one row, put where USRBCC finds them.
class Edge {
public:
  Edge(void* library, const ExportRequest& request)
      : function_(Library::address(library, "usrbcc_")),
        contact_(static_cast<Ufhcom*>(Library::address(library, "ufhcom_"))),
        surface_(static_cast<Ufhcom2*>(Library::address(library, "ufhcom2_"))),
        constants_(static_cast<double*>(Library::address(library, "ftcons_"))),
        inputs_(inputs_of(request)), kind_(coefficient_kind(request)),
        stress_(solver_unit("MPa", request.units)) {
    call_.user_variables = static_cast<int>(state_count(inputs_));
    for (const SolverInput& input : inputs_)
      call_.user_variables = std::max(call_.user_variables, static_cast<int>(input.field));
    // Of laws whose histories follow them without taking them.
    call_.temperature[0] = call_.temperature[1] = contact_->sliding_speed = 0;
    call_.nodal.assign(2 * static_cast<std::size_t>(call_.user_variables), 0.0);
  }

  const std::vector<SolverInput>& inputs() const { return inputs_; }

  double tau(std::span<const double* const> columns, std::size_t row) {
    pressure_ = some_pressure, flow_ = some_flow_stress;
    for (std::size_t c = 0; c < columns.size(); ++c)
      set(inputs_[c], c, columns[c][row]);
    const std::vector<double> past = history_values(inputs_, columns, row);
    for (std::size_t i = 0; i < past.size(); ++i)
      nodal(4 + i, past[i]);
    contact_->pressure = stress_.from_canonical(pressure_);
    surface_->effective_stress = stress_.from_canonical(flow_);
    call_.run(function_);
    if (kind_ == fortran::Coefficient::stress) return stress_.to_canonical(call_.variable);
    return call_.variable * (kind_ == fortran::Coefficient::coulomb
                                 ? std::abs(pressure_)
                                 : flow_ * std::numbers::inv_sqrt3);
  }

private:
  void nodal(std::size_t number, double value) {
    const auto stride = static_cast<std::size_t>(call_.user_variables);
    call_.nodal[number - 1] = call_.nodal[stride + number - 1] = value;
  }

  void set(const SolverInput& input, std::size_t column, double value) {
    const double solver = input.argument.solver.from_canonical(value);
    if (input.argument.name == "sigma_f_MPa") flow_ = value;
    switch (input.source) {
    case Source::pressure:
      pressure_ = value;
      break;
    case Source::speed:
      contact_->sliding_speed = solver;
      break;
    case Source::temperature:
      call_.temperature[0] = call_.temperature[1] = solver;
      break;
    case Source::expansion:
      surface_->stretch = solver;
      break;
    case Source::slip:
      nodal(1, solver);
      break;
    case Source::work:
      nodal(2, stress_.same() ? value : value * 1e3);
      break;
    case Source::peak_pressure:
      nodal(3, solver);
      break;
    case Source::field:
      nodal(input.field, solver);
      break;
    case Source::constant:
      constants_[column] = value;
      break;
    default:
      break; // the flow stress: with the pressure, for k
    }
  }

  void* function_;
  Ufhcom* contact_;
  Ufhcom2* surface_;
  double* constants_;
  std::vector<SolverInput> inputs_;
  fortran::Coefficient kind_;
  SolverUnit stress_;
  UsrbccCall call_;
  double pressure_ = 0, flow_ = 0; // canonical
};

} // namespace

void UsrbccCall::run(void* function) {
  int element = 5, die = 2;
  std::vector<int> codes(2 * static_cast<std::size_t>(freedoms), 0);
  std::vector<double> displacement(codes.size(), 0.0);
  double coordinates[4] = {0, 0, 1, 0}, environment = 20, before[2] = {20, 20}, time = 0;
  reinterpret_cast<Usrbcc>(function)(&variable, &first, &second, &element, codes.data(), &die,
                                     coordinates, displacement.data(), nodal.data(),
                                     &user_variables, &environment, before, temperature, &time,
                                     &model, &mode, &type, &freedoms);
}

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau) {
  Edge edge(built.library, request);
  for (std::size_t r = 0; r < rows; ++r)
    if (posed(edge.inputs(), columns, r, some_pressure)) tau[r] = edge.tau(columns, r);
}

} // namespace frictab::deform_usrbcc
