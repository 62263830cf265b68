// What a missing effect may look like, as columns of a regression on the logarithm of friction: a
// term is a smooth curve of a number, a factor per level of a text, or a product of two of these.
//
// A curve has a straight part and a bent one (natural cubic spline; its coefficients are
// independent in advance, the smoothest bend first), in ln x where x is positive and spans a factor
// of four. A pair has straight x straight, and straight x the three smoothest bends of the other.
// All parts are scaled to a mean square of 1 over the campaign, so that a coefficient is the size
// of an effect, in ln of friction.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "trace/candidates.h"

namespace frictab::trace {

// Per block: the straight columns, then the bent ones.
struct TermBasis {
  Eigen::MatrixXd columns;
  Eigen::Index straight = 0;
};

class TermMaker {
public:
  explicit TermMaker(const Candidates& candidates);
  TermBasis of(const Cause& cause) const; // of one or two columns

private:
  std::vector<TermBasis> of_column_;
};

} // namespace frictab::trace
