// States at which routines are called, and the comparison of their answers with the reference.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "table/build.h"
#include "table/drift.h"
#include "table/states.h"

namespace frictab::verify {

// Answer that a driver leaves for a row that its arguments cannot represent; tau_R itself is never
// negative.
inline constexpr double not_representable = -1;

// Returns |a - b| in MPa; 0 if both are NaN, infinite if one is.
inline double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? HUGE_VAL : d;
}

inline constexpr const char* normal_stress = "sigma_n_MPa";

// Returns the place of the state among `names`.
std::optional<std::size_t> state_place(const std::vector<std::string>& names,
                                       const std::string& state);

// Returns the columns of the wanted states, all of them among `names`.
std::vector<const double*> columns_of(const std::vector<std::string>& wanted,
                                      const std::vector<std::string>& names,
                                      const table::States& states);

// Sets the states that a target fixes to their values.
void hold(table::States& states, const std::vector<std::string>& names,
          const table::FixedStates& held);

// Moves the range of the contact normal stress to the decade below it, in which forming contacts
// begin. Returns that range, or nullptr if none begins above 0.
table::StateRange* to_decade_below(std::vector<table::StateRange>& ranges);

// Returns states in these ranges, fewer than over a law's own range.
table::States points_below(const std::vector<table::StateRange>& ranges, std::size_t samples);

} // namespace frictab::verify
