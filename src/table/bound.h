// A guaranteed upper bound of how far a table is from its law, anywhere in its box of states.
#pragma once

#include <optional>

#include "table/drift.h"
#include "table/options.h"

namespace frictab::table {

struct DriftBound {
  std::optional<double> MPa; // no state in the ranges drifts further; absent: not available
  std::string why_not;       // where absent
  std::size_t boxes = 0;     // that were looked at
  bool out_of_boxes = false; // more of them might have brought the bound down
  double found_MPa = 0;      // largest drift in the middle of a box ...
  std::vector<double> state; // ... and where, in the order of the ranges
};

// In every cell the law's piece is enclosed by a polynomial and its error (expr/taylor_model.h),
// the interpolant, a polynomial there itself, is taken off, and what is left is bounded by the sum
// of its Chebyshev coefficients; how much of it reaches tau_R is a bound of the combination's slope
// (expr/sensitivity.h). Boxes whose bound is above `goal_MPa` are split until it is not, or until
// the cell has had its share of `most_boxes`: half of them is shared by all cells, what these leave
// by those that are still above the goal (none more than a 500th of all). A count and not a time,
// so that the same table has the same bound on every machine. Exact arithmetic of the kernel is
// assumed; its rounding is below 1e-9 of the values. Not available where the table combines
// differently from the law, or has more cells than `most_boxes`.
struct BoundOptions {
  double goal_MPa = 0;
  std::size_t most_boxes = usual_proof_boxes;
};
DriftBound bound_drift(const models::AssembledLaw& law, const Table& table,
                       const std::vector<StateRange>& ranges, const BoundOptions& options);

// What the search found and what is proven above it. Each helps the other: the bound stops where it
// is close enough to what was found, and its largest middle is one more start for the search.
struct ProvenDrift {
  WorstCase worst;
  DriftBound bound;
};
ProvenDrift prove_drift(const models::AssembledLaw& law, const Table& table,
                        const std::vector<StateRange>& ranges, WorstCase found, double allowed_MPa,
                        std::size_t most_boxes = usual_proof_boxes);

// Three significant digits, never below the value: how a bound is shown.
double rounded_up(double value);

} // namespace frictab::table
