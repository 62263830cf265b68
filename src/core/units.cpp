// Units that tribometers and FE codes use, by dimension.
#include "core/units.h"

#include <array>

namespace frictab {

namespace {

enum class Dimension { stress, speed, length, time, force, temperature, ratio };

struct Unit {
  std::string_view name;
  Dimension dimension;
  double factor; // to the first unit of the dimension
  double offset = 0;
};

constexpr std::array units = {
    Unit{"MPa", Dimension::stress, 1},
    Unit{"N/mm2", Dimension::stress, 1},
    Unit{"N/mm^2", Dimension::stress, 1},
    Unit{"Pa", Dimension::stress, 1e-6},
    Unit{"kPa", Dimension::stress, 1e-3},
    Unit{"GPa", Dimension::stress, 1e3},
    Unit{"bar", Dimension::stress, 0.1},
    Unit{"psi", Dimension::stress, 6.894757293168e-3},
    Unit{"ksi", Dimension::stress, 6.894757293168},
    Unit{"mm/s", Dimension::speed, 1},
    Unit{"m/s", Dimension::speed, 1e3},
    Unit{"cm/s", Dimension::speed, 10},
    Unit{"um/s", Dimension::speed, 1e-3},
    Unit{"µm/s", Dimension::speed, 1e-3},
    Unit{"micron/s", Dimension::speed, 1e-3},
    Unit{"m/min", Dimension::speed, 1e3 / 60},
    Unit{"mm/min", Dimension::speed, 1.0 / 60},
    Unit{"mm", Dimension::length, 1},
    Unit{"m", Dimension::length, 1e3},
    Unit{"cm", Dimension::length, 10},
    Unit{"um", Dimension::length, 1e-3},
    Unit{"micron", Dimension::length, 1e-3},
    Unit{"microns", Dimension::length, 1e-3},
    Unit{"µm", Dimension::length, 1e-3}, // U+00B5
    Unit{"μm", Dimension::length, 1e-3}, // U+03BC
    Unit{"in", Dimension::length, 25.4},
    Unit{"s", Dimension::time, 1},
    Unit{"ms", Dimension::time, 1e-3},
    Unit{"us", Dimension::time, 1e-6},
    Unit{"min", Dimension::time, 60},
    Unit{"h", Dimension::time, 3600},
    Unit{"N", Dimension::force, 1},
    Unit{"mN", Dimension::force, 1e-3},
    Unit{"kN", Dimension::force, 1e3},
    Unit{"MN", Dimension::force, 1e6},
    Unit{"lbf", Dimension::force, 4.4482216152605},
    Unit{"degC", Dimension::temperature, 1},
    Unit{"C", Dimension::temperature, 1},
    Unit{"°C", Dimension::temperature, 1},
    Unit{"K", Dimension::temperature, 1, -273.15},
    Unit{"degF", Dimension::temperature, 5.0 / 9, -160.0 / 9},
    Unit{"1", Dimension::ratio, 1},
    Unit{"-", Dimension::ratio, 1},
    Unit{"%", Dimension::ratio, 0.01},
};

const Unit* find(std::string_view name) {
  for (const Unit& unit : units)
    if (unit.name == name) return &unit;
  return nullptr;
}

} // namespace

std::optional<Conversion> convert(std::string_view from, std::string_view to) {
  const Unit* a = find(from);
  const Unit* b = find(to);
  if (!a || !b || a->dimension != b->dimension) return std::nullopt;
  if (a == b) return Conversion{};
  return Conversion{a->factor / b->factor, (a->offset - b->offset) / b->factor};
}

std::vector<std::string> units_like(std::string_view unit) {
  std::vector<std::string> names;
  const Unit* wanted = find(unit);
  for (const Unit& one : units)
    if (wanted && one.dimension == wanted->dimension) names.emplace_back(one.name);
  return names;
}

} // namespace frictab
