// Difference between two tables as tau_R, over the states that both cover.
#pragma once

#include <array>

#include "table/build.h"
#include "table/states.h"

namespace frictab::table {

struct TableDifference {
  std::vector<StateRange> ranges; // common to both tables
  // number of states compared: nodes and cell centres of both, Halton points
  std::size_t states = 0;
  Drift drift;                   // |tau_R of A - tau_R of B|
  std::vector<double> worst;     // state of drift.max_abs, in the order of the ranges
  std::array<double, 2> tau_MPa; // of A and B at the worst state
  // Share of each table's own range, in the coordinates of its axes, that the other does not cover.
  std::array<double, 2> outside{};
};

// Compares two tables. `held`: states fixed at one value, required for inputs without a known
// range. Throws InputError where the ranges of an input do not overlap, or neither is known.
TableDifference difference(const Table& a, const Table& b, const FixedStates& held);

std::string difference_text(const TableDifference& difference,
                            const std::array<std::string, 2>& names);
std::string difference_json(const TableDifference& difference,
                            const std::array<std::string, 2>& names);

} // namespace frictab::table
