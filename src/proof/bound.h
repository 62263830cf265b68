// Guaranteed upper bound of the difference between a table and its law, anywhere in the table's box
// of states.
#pragma once

#include <optional>

#include "table/drift.h"
#include "table/options.h"

namespace frictab::proof {

struct DriftBound {
  std::optional<double> MPa; // no state in the ranges drifts further; absent: not available
  std::string why_not;       // the reason where MPa is absent
  std::size_t boxes = 0;     // number of boxes evaluated
  bool out_of_boxes = false; // more boxes might have lowered the bound
  double found_MPa = 0;      // largest drift at the centre of a box ...
  std::vector<double> state; // ... and its state, in the order of the ranges
};

// Branch and bound. In every cell the law's piece is enclosed by a polynomial and an error bound
// (expr/taylor_model.h). The interpolant, itself a polynomial in the cell, is subtracted, and the
// difference is bounded by the sum of its Chebyshev coefficients. A bound of the combination's
// slope (expr/sensitivity.h) turns this into a bound of tau_R.
//
// Boxes whose bound is above `goal_MPa` are split until it is not, or until the cell has used its
// share of `most_boxes`. Half of these boxes is shared by all cells; the rest goes to the cells
// that are still above the goal, at most a 500th of all to each. The limit is a count and not a
// time, so that the same table has the same bound on every machine.
//
// The bound assumes exact arithmetic of the kernel; its rounding is below 1e-9 of the values. It is
// not available where the table is combined differently from the law, or where it has more cells
// than `most_boxes`.
struct BoundOptions {
  double goal_MPa = 0;
  std::size_t most_boxes = table::usual_proof_boxes;
};
DriftBound bound_drift(const models::AssembledLaw& law, const table::Table& table,
                       const std::vector<table::StateRange>& ranges, const BoundOptions& options);

// The largest drift found by search and the proven bound above it. Each helps the other: the bound
// need not be closer than a few per cent to the drift found, and the worst box centre is one more
// start for the search.
struct ProvenDrift {
  table::WorstCase worst;
  DriftBound bound;
};
ProvenDrift prove_drift(const models::AssembledLaw& law, const table::Table& table,
                        const std::vector<table::StateRange>& ranges, table::WorstCase found,
                        double allowed_MPa, std::size_t most_boxes = table::usual_proof_boxes);

} // namespace frictab::proof
