// Fills templates/fortran/frictab_coef.f and frictab_constants.f.
#include "codegen/coefficient.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "codegen/fixed_form.h"
#include "codegen/fortran_parts.h"
#include "codegen/number_text.h"
#include "core/error.h"

namespace frictab::codegen::fortran {

namespace {

std::size_t n_states(const table::Table& table) {
  return std::max<std::size_t>(table.inputs().size(), 1);
}

// Returns the number of an input, from 1; 0 if the table does not take it.
std::size_t number_of(const table::Table& table, const std::string& name) {
  const std::vector<std::string> inputs = table.inputs();
  const auto at = std::find(inputs.begin(), inputs.end(), name);
  return at == inputs.end() ? 0 : static_cast<std::size_t>(at - inputs.begin()) + 1;
}

// Returns all inputs at `share` (0 the low end, 1 the high end) of their known ranges.
std::vector<double> state_at(const table::Table& table, double share) {
  std::vector<double> state;
  for (const std::string& name : table.inputs()) {
    const auto [low, high] = table.range(name).value_or(std::pair{400.0, 600.0});
    state.push_back((1 - share) * low + share * high);
  }
  return state;
}

} // namespace

std::string most_text() {
  return fortran_number(largest_coefficient);
}

std::string coefficient(const table::Table& table, Coefficient kind) {
  const std::size_t pressure = number_of(table, "sigma_n_MPa");
  TemplateValues values;
  values.flags = {{"coulomb", kind == Coefficient::coulomb},
                  {"capped", kind != Coefficient::stress},
                  {"shear", kind == Coefficient::shear},
                  {"takes_pressure", pressure > 0}};
  values.text = {{"n_x", std::to_string(n_states(table))},
                 {"pressure", std::to_string(pressure)},
                 {"least", fortran_number(least_pressure)},
                 {"most", most_text()}};
  return render_part("fortran/frictab_coef.f", values);
}

bool same_at_every_pressure(const table::Table& table, Coefficient kind) {
  const std::size_t pressure = number_of(table, "sigma_n_MPa");
  if (kind != Coefficient::coulomb || pressure == 0)
    return kind != Coefficient::coulomb && pressure == 0;
  for (const table::TableAxis& axis : table.axes)
    if (axis.name == "sigma_n_MPa") return false;
  const table::TableFunction tau(table);
  for (const double share : {0.0, 0.5, 1.0}) {
    std::vector<double> state = state_at(table, share);
    double first = 0;
    // A shear limit would be active at the last one.
    for (const double p : {1e-6, 1.0, 1e3, 1e6, 1e12}) {
      state[pressure - 1] = p;
      const double mu = tau(state) / p;
      if (p == 1e-6) first = mu;
      if (!(std::abs(mu - first) <= 1e-12 * std::abs(first))) return false;
    }
  }
  return true;
}

std::string constants_common(std::size_t n_x) {
  return fmt::format("      double precision cst({})\n      common /ftcons/ cst", n_x);
}

std::string constants_data(const std::vector<SolverInput>& inputs) {
  std::vector<double> values(std::max<std::size_t>(inputs.size(), 1), 0.0);
  FaultList faults;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const SolverInput& input = inputs[i];
    if (input.source != Source::constant && input.source != Source::field) continue;
    if (!input.fallback)
      faults.add(input_place(input.argument.name),
                 "neither the solver nor the table knows a value of this state", "constant:1.5");
    values[i] = input.fallback.value_or(0.0);
  }
  faults.throw_if_any();
  TemplateValues fill;
  fill.text = {{"common", constants_common(values.size())},
               {"data", fixed_form_data("cst", values)}};
  return render_part("fortran/frictab_constants.f", fill);
}

} // namespace frictab::codegen::fortran
