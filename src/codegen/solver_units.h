// The units of a solver. frictab has stress in MPa, length in mm, time in s, temperature in degC;
// an analysis has one of the systems below. Every number that enters or leaves a routine is
// converted here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frictab::codegen {

// A base unit of a system: canonical value = value * 10^power.
struct BaseUnit {
  const char* name;
  int power;
};

struct UnitSystem {
  const char* name; // of length, time and mass, and the stress where these leave a doubt
  BaseUnit stress, length, time, force;
};

// The known systems; a further one is one row.
std::span<const UnitSystem> unit_systems();
std::vector<std::string> unit_system_names();
std::vector<std::string> temperature_units(); // degC, K
// "mm-t-s (MPa, mm/s), m-kg-s (Pa, m/s) or ..."
std::string unit_systems_text();

// The system and the temperature of an analysis. Throws InputError for unknown ones.
class SolverUnits {
public:
  SolverUnits(const std::string& system, const std::string& temperature = "degC");
  SolverUnits(const char* system = "mm-t-s") : SolverUnits(std::string(system)) {}

  const UnitSystem& system() const { return *system_; }
  bool kelvin() const { return kelvin_; }
  // "mm-t-s", "mm-t-s, K"
  std::string text() const;

private:
  const UnitSystem* system_ = nullptr;
  bool kelvin_ = false;
};

// K at 0 degC.
inline constexpr double zero_celsius = 273.15;

// A unit of the solver: canonical = (value - zero) * times / over. At most one of the three differs
// from what changes nothing, so that every conversion is one correctly rounded operation, the same
// on the host and in generated code.
struct SolverUnit {
  std::string name;
  double times = 1;
  double over = 1;
  double zero = 0;
  double to_canonical(double value) const { return (value - zero) * times / over; }
  double from_canonical(double value) const { return value / times * over + zero; }
  bool same() const { return times == 1 && over == 1 && zero == 0; }
};

// Returns the solver's unit. Products, quotients and powers of MPa, mm, s, N and degC follow from
// these; a unit with any other in it (%, um, a traced column's) is unchanged. degC alone is a
// temperature, inside a product it is a difference.
SolverUnit solver_unit(std::string_view canonical_unit, const SolverUnits& units);

// Returns the unit of a derivative, of `a` by `b`.
SolverUnit per(const SolverUnit& a, const SolverUnit& b);

// Returns the end of an argument's name for a unit: "mm_s" for "mm/s", "C" for "degC".
std::string unit_suffix(std::string_view unit);

// Return the text that generated code has after a value to convert it: " * 1000.0" in C and Lua,
// "/1000000.0D0" and "-273.15D0" in Fortran; empty if the units are equal.
enum class Notation { c, fortran };
std::string to_canonical_text(const SolverUnit& unit, Notation notation);
std::string from_canonical_text(const SolverUnit& unit, Notation notation);

// Lists the names: "stress in MPa, speed in mm/s, length in mm, temperature in degC", or without
// "in".
std::string names_of_units(const SolverUnits& units, std::string_view in);

} // namespace frictab::codegen
