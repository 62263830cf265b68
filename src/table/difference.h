// How far two tables are from each other as tau_R, over the states that both hold.
#pragma once

#include <array>

#include "table/build.h"
#include "table/states.h"

namespace frictab::table {

struct TableDifference {
  std::vector<StateRange> ranges; // common to both
  std::size_t states = 0;         // compared: nodes and cell centres of both, Halton points
  Drift drift;                    // |tau_R of A - tau_R of B|
  std::vector<double> worst;      // state of drift.max_abs, in the order of the ranges
  std::array<double, 2> tau_MPa;  // of A and B there
  // Share of each table's own range, in the coordinates of its axes, that the other has not.
  std::array<double, 2> outside{};
};

// `held`: states at one value, which inputs without a known range need. Throws InputError where the
// ranges of an input have nothing in common, or none is known.
TableDifference difference(const Table& a, const Table& b, const HeldStates& held);

std::string difference_text(const TableDifference& difference,
                            const std::array<std::string, 2>& names);
std::string difference_json(const TableDifference& difference,
                            const std::array<std::string, 2>& names);

} // namespace frictab::table
