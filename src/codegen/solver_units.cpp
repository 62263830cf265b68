// Derives the units of a system from its row in the table.
#include "codegen/solver_units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "codegen/number_text.h"
#include "core/error.h"
#include "core/text.h"

namespace frictab::codegen {

namespace {

constexpr std::array systems = {
    UnitSystem{"mm-t-s", {"MPa", 0}, {"mm", 0}, {"s", 0}, {"N", 0}},
    UnitSystem{"m-kg-s", {"Pa", -6}, {"m", 3}, {"s", 0}, {"N", 0}},
    UnitSystem{"mm-ms-kg-GPa", {"GPa", 3}, {"mm", 0}, {"ms", -3}, {"kN", 3}},
    UnitSystem{"mm-ms-g-MPa", {"MPa", 0}, {"mm", 0}, {"ms", -3}, {"N", 0}}};

constexpr const char *celsius = "degC", *kelvins = "K";

// Finds the counterpart of a base unit. Numbers and K, a difference of temperatures, have none and
// need none.
bool find_base(std::string_view canonical, const SolverUnits& units, BaseUnit& found) {
  const UnitSystem& system = units.system();
  if (canonical == "MPa") return found = system.stress, true;
  if (canonical == "mm") return found = system.length, true;
  if (canonical == "s") return found = system.time, true;
  if (canonical == "N") return found = system.force, true;
  if (canonical == celsius) return found = {units.kelvin() ? kelvins : celsius, 0}, true;
  if (canonical == kelvins) return found = {kelvins, 0}, true;
  if (canonical == "1") return found = {"1", 0}, true;
  return false;
}

bool separates(char c) {
  return c == ' ' || c == '*' || c == '/' || c == '^';
}

SolverUnit of_power(std::string name, int power) {
  return {std::move(name), std::pow(10, std::max(power, 0)), std::pow(10, std::max(-power, 0))};
}

std::string number_of(double value, Notation notation) {
  return notation == Notation::c ? c_number(value) : fortran_number(value);
}

std::string operation(char sign, double value, Notation notation) {
  const std::string blank = notation == Notation::c ? " " : "";
  return blank + sign + blank + number_of(value, notation);
}

} // namespace

std::span<const UnitSystem> unit_systems() {
  return systems;
}

std::vector<std::string> unit_system_names() {
  std::vector<std::string> names;
  for (const UnitSystem& system : systems)
    names.emplace_back(system.name);
  return names;
}

std::vector<std::string> temperature_units() {
  return {celsius, kelvins};
}

std::string unit_systems_text() {
  std::string text;
  for (const UnitSystem& system : systems) {
    if (!text.empty()) text += &system == &systems.back() ? " or " : ", ";
    text += fmt::format("{} ({}, {}/{})", system.name, system.stress.name, system.length.name,
                        system.time.name);
  }
  return text;
}

SolverUnits::SolverUnits(const std::string& system, const std::string& temperature)
    : kelvin_(temperature == kelvins) {
  for (const UnitSystem& known : systems)
    if (known.name == system) system_ = &known;
  if (!system_)
    throw InputError({}, fmt::format("unknown unit system '{}' in export.units", system),
                     "known: " + unit_systems_text());
  if (!kelvin_ && temperature != celsius)
    throw InputError({}, fmt::format("unknown unit '{}' in export.temperature", temperature),
                     "known: degC, K");
}

std::string SolverUnits::text() const {
  return std::string(system_->name) + (kelvin_ ? ", K" : "");
}

SolverUnit solver_unit(std::string_view canonical_unit, const SolverUnits& units) {
  if (canonical_unit == celsius && units.kelvin()) return {kelvins, 1, 1, zero_celsius};
  const SolverUnit unchanged{std::string(canonical_unit)};
  std::string name;
  int power = 0;
  char before = ' ';
  for (std::size_t at = 0; at < canonical_unit.size();) {
    std::size_t end = at;
    while (end < canonical_unit.size() && !separates(canonical_unit[end]))
      ++end;
    BaseUnit base;
    if (!find_base(canonical_unit.substr(at, end - at), units, base)) return unchanged;
    name += base.name;
    int exponent = 1;
    if (end < canonical_unit.size() && canonical_unit[end] == '^') {
      const char* const first = canonical_unit.data() + end + 1;
      const auto [stop, error] =
          std::from_chars(first, canonical_unit.data() + canonical_unit.size(), exponent);
      const auto next = static_cast<std::size_t>(stop - canonical_unit.data());
      if (error != std::errc{} ||
          (next < canonical_unit.size() && !separates(canonical_unit[next])))
        return unchanged;
      name += canonical_unit.substr(end, next - end);
      end = next;
    }
    power += base.power * (before == '/' ? -exponent : exponent);
    if (end < canonical_unit.size()) name += before = canonical_unit[end++];
    at = end;
  }
  constexpr int most_exact = 22; // largest power of ten that is a double without rounding
  return std::abs(power) > most_exact ? unchanged : of_power(name, power);
}

SolverUnit per(const SolverUnit& a, const SolverUnit& b) {
  const double times = a.times * b.over, over = a.over * b.times;
  return times > over ? SolverUnit{"", times / over, 1} : SolverUnit{"", 1, over / times};
}

std::string unit_suffix(std::string_view unit) {
  if (unit == celsius) return "C";
  std::string suffix;
  for (const char c : unit)
    if (std::isalnum(static_cast<unsigned char>(c)) || separates(c))
      suffix += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return suffix;
}

std::string to_canonical_text(const SolverUnit& unit, Notation notation) {
  if (unit.zero != 0) return operation('-', unit.zero, notation);
  if (unit.times != 1) return operation('*', unit.times, notation);
  return unit.over != 1 ? operation('/', unit.over, notation) : "";
}

std::string from_canonical_text(const SolverUnit& unit, Notation notation) {
  if (unit.zero != 0) return operation('+', unit.zero, notation);
  if (unit.times != 1) return operation('/', unit.times, notation);
  return unit.over != 1 ? operation('*', unit.over, notation) : "";
}

std::string names_of_units(const SolverUnits& units, std::string_view in) {
  std::string text;
  for (const auto& [what, unit] :
       {std::pair{"stress", "MPa"}, std::pair{"speed", "mm/s"}, std::pair{"length", "mm"}})
    text += fmt::format("{}{}{}, ", what, in, solver_unit(unit, units).name);
  return text + (in == " in " ? "temperature in " : "") + solver_unit(celsius, units).name;
}

} // namespace frictab::codegen
