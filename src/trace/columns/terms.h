// Terms: possible effects as columns of a regression on the logarithm of friction. A term is a
// smooth curve of a number, a factor per level of a text, or a product of two of these.
//
// A curve has a straight part and a bent one, in ln x where x is positive and spans a factor of
// four. The bent part is a natural cubic spline, in coordinates in which its coefficients are
// independent a priori, the smoothest bend first. A pair has straight x straight, and straight x
// the three smoothest bends of the other column. All parts are scaled to a mean square of 1 over
// the campaign, so that a coefficient is the size of an effect, in ln of friction.
#pragma once

#include <vector>

#include "trace/basics.h"
#include "trace/columns/candidates.h"

namespace frictab::trace {

// Columns of a term, per block: straight ones, then bent ones.
struct TermBasis {
  MatrixXd columns;
  Index straight = 0;
};

class TermMaker {
public:
  explicit TermMaker(const Candidates& candidates);
  TermBasis of(const Cause& cause) const; // for a cause of one or two columns

private:
  std::vector<TermBasis> of_column_;
};

} // namespace frictab::trace
