// Fills templates/abaqus/frictab_stop.f.
#include "stop.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/fortran_parts.h"
#include "table/outside.h"

namespace frictab::abaqus {

std::string stop(const Table& table, Solver solver) {
  TemplateValues values;
  const bool standard = solver == Solver::standard;
  values.text["include"] = standard ? "aba_param.inc" : "vaba_param.inc";
  values.text["routine"] = standard ? "stdb_abqerr" : "xplb_abqerr";
  Lines refusing = fortran::sides(table, Outside::error);
  std::size_t side = 0;
  const auto say = [&](const AxisEnds& axis, const char* where, double end) {
    std::string name = comment_text(axis.name).substr(0, 30);
    for (char& c : name)
      if (c == '\'' || c == '%') c = ' '; // the solver's messages have their own use for %
    refusing[side++].text["name"] = fmt::format("{} {} {:.6g}", name, where, end);
  };
  for (const AxisEnds& axis : axis_ends(table)) {
    if (axis.below == Outside::error) say(axis, "below", axis.low);
    if (axis.above == Outside::error) say(axis, "above", axis.high);
  }
  values.text["n_x"] = std::to_string(std::max<std::size_t>(table.inputs().size(), 1));
  values.lists["refusing"] = refusing;
  return fortran::without_last_break(render_template("abaqus/frictab_stop.f", values));
}

} // namespace frictab::abaqus
