// Finds the turn of a table's angle, and fills templates/fortran/frictab_direction.f.
#include "codegen/sliding_direction.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "codegen/number_text.h"
#include "core/template.h"
#include "table/outside.h"

namespace frictab::codegen {

namespace {

// Degrees by which a slip in single precision may miss its angle, with a wide margin.
constexpr double rounding_of_angle = 1e-3;

bool is_global_axis(const Axis& axis) {
  return std::count(axis.begin(), axis.end(), 0.0) == 2;
}

} // namespace

bool Turn::represents(double degrees, const Axis& reference) const {
  if (std::isnan(degrees)) return true;
  const bool is_exact = degrees == low && std::fmod(low, 90) == 0 && is_global_axis(reference);
  return is_exact || (degrees > low + rounding_of_angle && degrees < high() - rounding_of_angle);
}

Turn turn_of(const table::Table& table) {
  const std::string name(direction_name);
  auto range = table.range(name);
  for (const table::AxisEnds& end : table::all_ends(table))
    if (end.name == name) range = {end.low, end.high};
  if (!range) return {};
  const double period = range->second - range->first > 180 ? 360 : 180;
  return {0.5 * (range->first + range->second) - 0.5 * period, period};
}

namespace fortran {

std::string direction_functions(const Turn& turn, const std::optional<Axis>& reference) {
  TemplateValues values = {.text = {{"low", fortran_number(turn.low)},
                                    {"low_text", fmt::format("{:g}", turn.low)},
                                    {"high_text", fmt::format("{:g}", turn.high())},
                                    {"period", fortran_number(turn.period)}},
                           .flags = {{"in_space", reference.has_value()}}};
  if (reference)
    for (std::size_t d = 0; d < 3; ++d)
      values.text["reference_" + std::to_string(d + 1)] = fortran_number((*reference)[d]);
  return render_part("fortran/frictab_direction.f", values);
}

} // namespace fortran

} // namespace frictab::codegen
