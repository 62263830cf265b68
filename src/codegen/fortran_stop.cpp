// Fills templates/fortran/frictab_refuse.f.
#include "codegen/fortran_stop.h"

#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "codegen/fortran_parts.h"
#include "codegen/sides.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"

namespace frictab::codegen::fortran {

std::string quit(const std::string& statement) {
  return render_part("fortran/frictab_quit.f", {.text = {{"statement", statement}}});
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
  values.text["n_x"] = std::to_string(inputs_size(table));
  Lines& refusing = values.lists["refusing"];
  refusing = sides(table, table::Outside::error);
  std::size_t number = 0;
  for (const Side& side : codegen::sides(table, table::Outside::error)) {
    const InputArgument& argument = argument_named(arguments, side.axis);
    const SolverUnit& unit = argument.solver;
    auto& text = refusing[number++].text;
    text["to_solver"] = from_canonical_text(unit, Notation::fortran);
    text["name"] =
        fmt::format("{} {} {:.6g}", in_apostrophes(unit.same() ? side.axis : argument.argument),
                    side.above ? "above" : "below", unit.from_canonical(side.end));
  }
  return render_part("fortran/frictab_refuse.f", values);
}

bool refuses(const table::Table& table) {
  return has_side(table, table::Outside::error);
}

bool ends(const ExportRequest& request) {
  return refuses(request.table) || values_in_file(request) || !request.law_stem.empty();
}

} // namespace frictab::codegen::fortran
