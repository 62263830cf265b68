// Fills templates/fortran/frictab_refuse.f.
#include "codegen/fortran_stop.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "codegen/fortran_parts.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "table/outside.h"

namespace frictab::codegen::fortran {

std::string quit(const std::string& statement) {
  TemplateValues values;
  values.text["statement"] = statement;
  return render_part("fortran/frictab_quit.f", values);
}

std::string say() {
  return "C     Says why there are no values.\n"
         "      subroutine ftquit(text)\n"
         "      use, intrinsic :: iso_fortran_env, only: error_unit\n"
         "      implicit none\n"
         "      character(len=*), intent(in) :: text\n"
         "      write (error_unit, '(a)') trim(text)\n"
         "      end\n"
         "C";
}

std::string stop(const ExportRequest& request) {
  const table::Table& table = request.table;
  const std::vector<InputArgument> arguments = entry_arguments(table, request.units);
  TemplateValues values;
  Lines refusing = sides(table, table::Outside::error);
  std::size_t side = 0;
  const auto say = [&](const table::AxisEnds& axis, const char* where, double end) {
    const InputArgument& argument =
        *std::find_if(arguments.begin(), arguments.end(),
                      [&](const InputArgument& one) { return one.name == axis.name; });
    const SolverUnit& unit = argument.solver;
    auto& text = refusing[side++].text;
    text["to_solver"] = from_canonical_text(unit, Notation::fortran);
    text["name"] =
        fmt::format("{} {} {:.6g}", in_apostrophes(unit.same() ? axis.name : argument.argument),
                    where, unit.from_canonical(end));
  };
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    if (axis.below == table::Outside::error) say(axis, "below", axis.low);
    if (axis.above == table::Outside::error) say(axis, "above", axis.high);
  }
  values.text["n_x"] = std::to_string(std::max<std::size_t>(table.inputs().size(), 1));
  values.lists["refusing"] = refusing;
  return render_part("fortran/frictab_refuse.f", values);
}

bool refuses(const table::Table& table) {
  return std::any_of(table.axes.begin(), table.axes.end(), [](const table::TableAxis& axis) {
    return axis.below == table::Outside::error || axis.above == table::Outside::error;
  });
}

bool ends(const ExportRequest& request) {
  return refuses(request.table) || values_in_file(request) || !request.law_stem.empty();
}

} // namespace frictab::codegen::fortran
