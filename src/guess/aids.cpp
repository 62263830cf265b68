#include "guess/aids.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/computed.h"
#include "data/name_words.h"
#include "data/scale.h"
#include "io/csv.h"

namespace frictab::guess {

namespace {

using data::has_word;

// Unit in the file, or at the end of the name; empty: none.
std::string unit_given(const Column& column, const std::string& wanted) {
  return column.unit.empty() ? data::unit_in_name(column.name, wanted) : column.unit;
}

// True if the column may be in this unit: it converts, or the file gives none.
bool may_be_in(const Column& column, const std::string& wanted) {
  const std::string unit = unit_given(column, wanted);
  return unit.empty() || convert(unit, wanted).has_value();
}

bool is_in(const Column& column, const std::string& wanted) {
  return !unit_given(column, wanted).empty() && may_be_in(column, wanted);
}

bool is_diameter(const std::string& name) {
  return data::has_part(name, {"diameter", "durchmesser"}) ||
         has_word(name, {"dia", "diam", "ø", "Ø"});
}

bool is_radius(const std::string& name) {
  return name.find("radius") != name.npos || has_word(name, {"r track", "track r"});
}

bool is_of_ball(const std::string& name) {
  return data::has_part(name, {"kugel"}) || has_word(name, {"ball", "sphere"});
}

bool is_of_track(const std::string& name) {
  return data::has_part(name, {"track", "spur", "laufbahn", "laufkreis", "reibdurch", "reibradius",
                               "ringdurch", "mittlere"}) ||
         has_word(name, {"ring", "mean"});
}

bool is_of_pin(const std::string& name) {
  return data::has_part(name, {"stift", "stempel", "proben", "zylinder", "pindurch"}) ||
         has_word(name, {"pin", "punch", "specimen", "sample", "probe", "cylinder"});
}

// Edges, roundings and rims, at which no contact slides.
bool is_of_edge(const std::string& name) {
  return data::has_part(name, {"innen", "aussen", "außen", "kante", "matrize", "rundung"}) ||
         has_word(name, {"inner", "outer", "edge", "corner", "nose", "tip", "fillet", "die", "bore",
                         "shaft", "welle"});
}

bool names_stroke(const std::string& name) {
  return (data::has_part(name, {"schwingweite", "hublänge", "hublaenge", "stroke length"}) ||
          has_word(name, {"stroke", "hub"})) &&
         !data::has_part(name, {"freq", "anzahl"}) &&
         !has_word(name, {"rate", "no", "count", "number"});
}

bool names_frequency(const std::string& name) {
  return data::has_part(name, {"freq"}) &&
         !data::has_part(name, {"sampl", "abtast", "mess", "acquis", "record", "eigen", "filter",
                                "cut", "natural"});
}

bool names_position(const std::string& name) {
  const bool is_path = data::has_part(name, {"position", "displacement", "verschiebung"}) ||
                       name.ends_with("weg") || data::has_part(name, {"weg "}) || name == "travel";
  return is_path &&
         !data::has_part(name, {"wear", "verschlei", "depth", "tiefe", "penetr", "eindring",
                                "normal", "vertical", "vertikal", "bewegung"});
}

bool names_friction(const std::string& name) {
  return data::has_part(name,
                        {"friction", "reib", "tangential", "lateral", "attrito", "frottement"}) ||
         has_word(name, {"fr", "ft", "ff", "fx", "f r", "f t", "f x"});
}

// Marks of wear, which change.
bool is_of_wear(const std::string& name) {
  return data::has_part(name, {"scar", "kalotte", "verschlei"}) ||
         (name.find("wear") != name.npos && name.find("track") == name.npos);
}

// True if formulas can take the column by its name.
bool has_name_in_formulas(const Column& column) {
  const std::string name = data::name_in_formulas(column.name);
  if (name.empty() || column.number > 0) return false;
  const auto first = static_cast<unsigned char>(name.front());
  return std::isalpha(first) != 0 || first >= 0x80;
}

} // namespace

bool is_aid(const Column& column, Aid aid) {
  const bool has_meaning =
      !column.canonical.empty() && !(aid == Aid::position && column.canonical == "s_mm");
  if (has_meaning || column.text || !has_name_in_formulas(column)) return false;
  const std::string name = data::words_of_name(io::read_header_name(column.name).name);
  if (is_of_wear(name)) return false;
  const bool length = may_be_in(column, "mm");
  switch (aid) {
  case Aid::track_radius:
    return length && is_radius(name) &&
           (is_of_track(name) || !(is_of_ball(name) || is_of_pin(name) || is_of_edge(name)));
  case Aid::track_diameter:
    return length && is_diameter(name) && is_of_track(name) && !is_of_edge(name);
  case Aid::pin_diameter:
    return length && is_diameter(name) && is_of_pin(name) && !is_of_ball(name) &&
           !is_of_track(name) && !is_of_edge(name);
  case Aid::ball_radius:
    return length && is_radius(name) && is_of_ball(name);
  case Aid::ball_diameter:
    return length && is_diameter(name) && is_of_ball(name);
  case Aid::stroke:
    return is_in(column, "mm") && names_stroke(name);
  case Aid::frequency:
    return names_frequency(name) && may_be_in(column, "Hz");
  case Aid::position:
    return !column.above && is_in(column, "mm") && names_position(name);
  case Aid::voltage:
    return !column.above && is_in(column, "V") && names_friction(name);
  case Aid::calibration:
    return is_in(column, "N/V");
  }
  return false;
}

double factor_to(const Column& column, const std::string& unit) {
  const std::string given = unit_given(column, unit);
  const auto conversion = convert(given.empty() ? unit : given, unit);
  return conversion ? conversion->factor : 1;
}

std::string term_of(const Column& column, const std::string& unit, double divided_by) {
  constexpr double rounding = 1e-9;
  const std::string name = data::name_in_formulas(column.name);
  const double factor = factor_to(column, unit) / divided_by;
  if (std::abs(factor - 1) < rounding) return name;
  const double over = std::round(1 / factor);
  if (std::abs(over * factor - 1) < rounding) return fmt::format("{}/{:.0f}", name, over);
  return fmt::format("{:.10g}*{}", factor, name);
}

} // namespace frictab::guess
