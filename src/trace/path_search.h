// One value per test: which few columns together does it follow, more than any would by chance?
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace frictab {

// One shape of a column, as tests x degrees of freedom (a text column has one less than levels).
struct PathShape {
  std::size_t name = 0; // shapes of the same name are never taken together
  Eigen::MatrixXd columns;
};

struct PathInput {
  const Eigen::VectorXd& response; // per test
  const Eigen::MatrixXd& known; // tests x directions that are explained already, the mean as well
  const std::vector<PathShape>& shapes;
  double alpha = 0.01;
  std::size_t longest = 3; // columns of a path
  std::size_t permutations = 999;
  std::uint64_t seed = 1;
};

// Paths of one, two and three columns, each next one by the smallest p of its partial F, whose
// residual variance has the path in it: columns that hide each other are found together. A beam
// also starts from the second to twelfth best column. The p-value is the rank of the best path's,
// smallest over the lengths, among permuted residuals (Freedman and Lane 1983) for which the whole
// search is repeated: it holds for everything that was tried.
struct PathResult {
  bool possible = false; // enough tests, and a shape to try
  double p_value = 1;
  std::vector<std::size_t> chosen; // shapes of the shortest path that reaches alpha, else the best
  // Parametric log p that a single column needs to reach alpha.
  double critical_log_p = 0;
  std::size_t free = 0; // degrees of freedom behind `known`
};

PathResult search_path(const PathInput& input);

// Log of the upper tail of F(q, free - q) at the partial R^2 of q columns.
double log_p_of(double r_squared, double q, double free);

} // namespace frictab
