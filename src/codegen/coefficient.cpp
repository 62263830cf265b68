// Fills templates/fortran/frictab_coef.f and frictab_constants.f.
#include "codegen/coefficient.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fixed_form.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_parts.h"
#include "codegen/fortran_stop.h"
#include "codegen/number_text.h"
#include "core/error.h"

namespace frictab::codegen::fortran {

namespace {

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
  const std::optional<std::size_t> pressure = input_index(table, "sigma_n_MPa");
  return render_part("fortran/frictab_coef.f",
                     {.text = {{"n_x", std::to_string(inputs_size(table))},
                               {"pressure", std::to_string(pressure ? *pressure + 1 : 0)},
                               {"least", fortran_number(least_pressure)},
                               {"most", most_text()}},
                      .flags = {{"coulomb", kind == Coefficient::coulomb},
                                {"capped", kind != Coefficient::stress},
                                {"shear", kind == Coefficient::shear},
                                {"takes_pressure", pressure.has_value()}}});
}

std::string coefficient_name(Coefficient kind) {
  if (kind == Coefficient::coulomb) return "friction coefficient mu";
  return kind == Coefficient::shear ? "shear factor m" : "frictional shear stress tau_R";
}

nlohmann::ordered_json coefficient_result(Coefficient kind, const std::string& name,
                                          const std::string& meaning, const SolverUnits& units) {
  nlohmann::ordered_json out = {{"name", name}, {"meaning", meaning}};
  if (kind == Coefficient::coulomb) out["least_pressure_MPa"] = least_pressure;
  if (kind != Coefficient::stress) out["at_most"] = largest_coefficient;
  out["unit"] = kind == Coefficient::stress ? solver_unit("MPa", units).name : "1";
  return out;
}

bool same_at_every_pressure(const table::Table& table, Coefficient kind) {
  const std::optional<std::size_t> pressure = input_index(table, "sigma_n_MPa");
  if (kind != Coefficient::coulomb || !pressure) return kind != Coefficient::coulomb && !pressure;
  if (table::find_axis(table, "sigma_n_MPa")) return false;
  const table::TableFunction tau(table);
  for (const double share : {0.0, 0.5, 1.0}) {
    std::vector<double> state = state_at(table, share);
    double first = 0;
    // A shear limit would be active at the last one.
    for (const double p : {1e-6, 1.0, 1e3, 1e6, 1e12}) {
      state[*pressure] = p;
      const double mu = tau(state) / p;
      if (p == 1e-6) first = mu;
      if (!(std::abs(mu - first) <= 1e-12 * std::abs(first))) return false;
    }
  }
  return true;
}

std::string constants_common(const std::vector<SolverInput>& inputs) {
  return fmt::format("      double precision cst({})\n      common /ftcons/ cst",
                     std::max<std::size_t>(inputs.size(), 1));
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
  return render_part(
      "fortran/frictab_constants.f",
      {.text = {{"common", constants_common(inputs)}, {"data", fixed_form_data("cst", values)}}});
}

void add_coefficient(TemplateValues& values, const ExportRequest& request,
                     const std::vector<SolverInput>& inputs, const SolverGives& gives,
                     Coefficient kind, const std::string& quit) {
  values.text["stress_convert"] =
      to_canonical_text(solver_unit("MPa", request.units), Notation::fortran);
  values.text["common"] = constants_common(inputs);
  values.text["constants"] = constants_data(inputs);
  values.text["coefficient"] = coefficient(request.table, kind);
  values.text["reads"] = reads(inputs, gives);
  values.text["core"] = core(request, {.unknown = refuses(request.table), .quit = quit}).text;
}

} // namespace frictab::codegen::fortran
