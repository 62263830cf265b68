// Fills in the parts that both routines of Abaqus/Standard share.
#include "standard.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fortran_build.h"
#include "codegen/fortran_core.h"
#include "codegen/fortran_stop.h"
#include "codegen/histories.h"
#include "codegen/number_text.h"
#include "codegen/outside_summary.h"
#include "codegen/solver_units.h"
#include "stop.h"
#include "table/outside.h"

namespace frictab::abaqus {

using namespace codegen;

namespace {

void add_units(TemplateValues& values, const ExportRequest& request) {
  values.text["to_mpa"] = to_canonical_text(solver_unit("MPa", request.units), Notation::fortran);
  values.text["to_mm_s"] = to_canonical_text(solver_unit("mm/s", request.units), Notation::fortran);
}

std::vector<std::string> coefficient_lines(bool frozen) {
  if (!frozen) return {"Coefficient: of the current state, with its derivatives."};
  return {"Coefficient: as the last increment left it (start_of_increment); in the first one of a "
          "contact the current state's. A stress may then exceed the shear limit by what the "
          "pressure grows within one increment."};
}

} // namespace

ExportOption coefficient_option() {
  return {"abaqus_coefficient",
          {"current", "start_of_increment"},
          "the coefficient follows the state within an increment, with derivatives; or is held at "
          "what the last increment left, which converges more easily"};
}

bool coefficient_is_frozen(const ExportRequest& request) {
  return request.option_or_empty("abaqus_coefficient") == "start_of_increment";
}

double smallest_pressure(const frictab::table::Table& table) {
  const auto range = table.range("sigma_n_MPa");
  return range && range->first > 0 ? std::min(1.0, range->first) : 1.0;
}

bool add_routine(TemplateValues& values, const Exporter& exporter, const ExportRequest& request,
                 const std::vector<SolverInput>& inputs, const SolverGives& gives, bool unknown,
                 fortran::Head head) {
  const frictab::table::Table& table = request.table;
  head.error_action = "STDB_ABQERR ends the analysis";
  head.directory_routine = directory_routine(Solver::standard);
  fortran::add_head(values, exporter, request, inputs, head);
  add_units(values, request);
  const bool refuses = values.flags["refuses"], frozen = coefficient_is_frozen(request);
  unknown = unknown || refuses || fortran::needs_unknown(inputs, gives);
  values.text["core"] =
      fortran::core(request, {.unknown = unknown,
                              .gradient = true,
                              .quit = quit(Solver::standard),
                              .summary = fortran::outside_summary(exporter, request),
                              .directory_routine = directory_routine(Solver::standard)})
          .text;
  values.text["pmin"] = fortran_number(smallest_pressure(table));
  values.text["smallest"] = fmt::format("{:.3g}", smallest_pressure(table));
  values.flags["has_ends"] = !frictab::table::all_ends(table).empty();
  values.flags["frozen"] = frozen;
  values.lists["coefficient"] = fortran::comments(coefficient_lines(frozen));
  values.lists["histories"] = fortran::comments(
      numbered(history_states(inputs, request.units), gives.before_histories + 1));
  values.flags["knows_temperature"] = takes(inputs, "T_contact_C");
  fortran::add_histories(values, inputs, request.units, true);
  return unknown;
}

std::size_t states_size(std::size_t n) {
  return 2 * n + 1;
}

void add_states(TemplateValues& values, std::size_t n) {
  const std::map<std::string, std::string> numbers = {{"n_states", std::to_string(n)},
                                                      {"stamp", std::to_string(n + 1)},
                                                      {"first", std::to_string(n + 2)},
                                                      {"depvar", std::to_string(states_size(n))}};
  values.text.insert(numbers.begin(), numbers.end());
  values.text["states_text"] = render_part("abaqus/frictab_states.f", {.text = numbers});
}

nlohmann::ordered_json state_variables(std::vector<std::pair<std::string, std::string>> all,
                                       const ExportRequest& request,
                                       const std::vector<SolverInput>& inputs) {
  for (const HistoryState& state : history_states(inputs, request.units))
    all.emplace_back(state.unit, state.meaning);
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  const auto add = [&](const std::string& unit, const std::string& meaning) {
    out.push_back({{"number", out.size() + 1}, {"unit", unit}, {"meaning", meaning}});
  };
  for (const auto& [unit, meaning] : all)
    add(unit, meaning);
  add("1", "step * 1e8 + increment that these belong to");
  for (std::size_t i = 0; i < all.size(); ++i)
    add(all[i].first, fmt::format("number {} at the start of the increment", i + 1));
  return out;
}

void compare_kept(DrivenPath& path, const std::string& pattern, std::vector<std::string> names,
                  const std::vector<double>& now, const std::vector<double>& then, double increment,
                  const std::vector<double>& st) {
  for (const HistoryState& state : history_states(path.inputs, path.request.units))
    names.push_back(state.name);
  const auto numbered = [&](std::size_t number, const std::string& name) {
    return fmt::format(fmt::runtime(pattern), number) + " " + name;
  };
  const std::size_t n = now.size();
  for (std::size_t j = 0; j < n; ++j) {
    path.compare(numbered(j + 1, names[j]), "", st[j], now[j]);
    path.compare(numbered(n + 2 + j, names[j] + " at the start"), "", st[n + 1 + j], then[j]);
  }
  path.compare(numbered(n + 1, "increment"), "", st[n], increment);
}

BuildVariant standard_variant(const ExportRequest& request, const std::string& file) {
  BuildVariant out = fortran::library_variant("double", 0x1p-53, {file}, {"-I@{dir}"});
  out.extra["aba_param.inc"] =
      "C     Stand-in for the solver's include, for tests outside the solver.\n"
      "      implicit real*8 (a-h,o-z)\n"
      "      parameter (nprecd=2)\n";
  if (fortran::ends(request)) add_stand_ins(out, Solver::standard);
  return out;
}

} // namespace frictab::abaqus
