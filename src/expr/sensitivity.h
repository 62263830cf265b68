// Bounds on the change of a formula when one of its symbols changes.
//
// Two intervals are propagated through the formula, operation by operation: the range of values
// (bounds.h), and a slope S such that f(v) - f(w) lies in S (v - w) for any two values v, w of the
// symbol (a Lipschitz interval). A smooth operation multiplies S by the interval of its derivative
// over the operand's range (mean value theorem). min and max take the slope of the chosen operand,
// or an interval around both slopes if either may be chosen. Kinks are thus covered, which a
// derivative would not do.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "expr/bounds.h"

namespace frictab::expr {

class Sensitivity {
public:
  // `columns`: every symbol of the formula; `of`: the one that changes.
  Sensitivity(const Expr& formula, const std::vector<std::string>& columns, const std::string& of);

  struct Result {
    Bounds range; // of the formula over the box
    // f(.., v, ..) - f(.., w, ..) lies in slope (v - w) for all v, w in the range of `of` and all
    // values of the other symbols in their ranges. The whole line if nothing is known.
    Bounds slope;
  };
  Result operator()(std::span<const Bounds> box) const;

private:
  struct Step {
    Op op;
    double value = 0;
    std::size_t symbol = 0;
    std::size_t a[4] = {};
    bool changes = false; // depends on the symbol `of`
  };
  std::vector<Step> steps_;
  std::size_t of_;
};

} // namespace frictab::expr
