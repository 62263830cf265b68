// The simple shapes in which the friction of whole tests may follow a column.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "trace/candidates.h"

namespace frictab::trace {

// One way in which the gain of a test may follow a column: the regressors of a fit, tests x degrees
// of freedom.
struct TestShape {
  Cause cause;
  std::string form; // line | log | above | below | log1p | levels | one level | product
  Eigen::MatrixXd columns;
};

// All shapes of all columns but the order of tests, histories, time and distance. A number counts
// by its mean over the test: as it is, as its logarithm, and as straight lines above and below its
// median, where it has values enough. A text column counts by its levels, and by each level against
// the rest; a level of one test joins the rest.
std::vector<TestShape> test_shapes(const Candidates& candidates, const Blocks& blocks);

} // namespace frictab::trace
