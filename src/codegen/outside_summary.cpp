// Fills templates/fortran/frictab_seen.f.
#include "codegen/outside_summary.h"

#include <cmath>

#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "codegen/fortran_parts.h"
#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "table/outside.h"

namespace frictab::codegen {

namespace {

constexpr const char* summary_key = "outside_summary";

TemplateValues end_values(const table::Table& table, const table::AxisEnds& axis,
                          const InputArgument& argument) {
  const SolverUnit& unit = argument.solver;
  const bool log = argument.axis && table.axes[*argument.axis].log;
  const double length = log ? std::log(axis.high / axis.low) : axis.high - axis.low;
  TemplateValues one;
  one.flags["log"] = log;
  one.text = {{"index", std::to_string(axis.input + 1)},
              {"low", fortran_number(axis.low)},
              {"high", fortran_number(axis.high)},
              {"length", fortran_number(length > 0 ? length : 1)},
              {"name", fortran::in_apostrophes(unit.same() ? axis.name : argument.argument)},
              {"to_solver", from_canonical_text(unit, Notation::fortran)},
              {"unit", unit.name == "1" ? "" : " " + fortran::in_apostrophes(unit.name)},
              {"range", fmt::format("{:.6g} .. {:.6g}", unit.from_canonical(axis.low),
                                    unit.from_canonical(axis.high))}};
  return one;
}

} // namespace

ExportOption outside_summary_option() {
  return {
      summary_key,
      {"none", "at_exit", "at_exit_windows"},
      "one message on the standard output when the program ends, if contact points were outside "
      "the range of the law: how often, and the state furthest beyond an end"};
}

std::string fortran::outside_summary(const Exporter& exporter, const ExportRequest& request) {
  const std::string said = request.option_or_empty(summary_key);
  const std::vector<table::AxisEnds> ends = table::all_ends(request.table);
  if (!exporter.offers(summary_key) || said.empty() || said == "none" || ends.empty()) return "";
  TemplateValues values;
  const std::vector<InputArgument> arguments = entry_arguments(request.table, request.units);
  for (const table::AxisEnds& axis : ends) {
    values.lists["ends"].push_back(
        end_values(request.table, axis, argument_named(arguments, axis.name)));
    values.lists["ends"].back().text["number"] = std::to_string(values.lists["ends"].size());
  }
  const bool windows = said == "at_exit_windows";
  values.flags["windows"] = windows;
  values.text = {{"locks", locks("ft", windows)},
                 {"model", fortran::in_apostrophes(request.table.model)},
                 {"n_x", std::to_string(inputs_size(request.table))}};
  return render_part("fortran/frictab_seen.f", values);
}

} // namespace frictab::codegen
