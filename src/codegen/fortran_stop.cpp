// Fills templates/fortran/frictab_refuse.f.
#include "codegen/fortran_stop.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/fortran_parts.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "table/outside.h"

namespace frictab::codegen::fortran {

std::string quit(const std::string& statement) {
  TemplateValues values;
  values.text["statement"] = statement;
  return without_last_break(render_template("fortran/frictab_quit.f", values));
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

std::string stop(const table::Table& table) {
  TemplateValues values;
  Lines refusing = sides(table, table::Outside::error);
  std::size_t side = 0;
  const auto say = [&](const table::AxisEnds& axis, const char* where, double end) {
    refusing[side++].text["name"] =
        fmt::format("{} {} {:.6g}", in_apostrophes(axis.name), where, end);
  };
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    if (axis.below == table::Outside::error) say(axis, "below", axis.low);
    if (axis.above == table::Outside::error) say(axis, "above", axis.high);
  }
  values.text["n_x"] = std::to_string(std::max<std::size_t>(table.inputs().size(), 1));
  values.lists["refusing"] = refusing;
  return without_last_break(render_template("fortran/frictab_refuse.f", values));
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
