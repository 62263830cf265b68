// One value per test: which few columns together does it follow, more than any would by chance?
//
// Two effects may hide each other, so that neither shows alone. A path therefore adds a second and
// a third column before anything is judged: each time the one with the smallest p-value of its
// partial F, q degrees of freedom against those left,
//   F = (squares explained / q) / (squares left with it / degrees left).
// Besides the best first column, eleven others start paths of their own (a beam). The same search
// is repeated on permuted residuals (Freedman and Lane 1983). For each length the best path gets
// its rank among the permutations; the smallest rank over the lengths, ranked in turn, is the
// p-value. It holds for everything that was tried. All of it runs on the Gram matrix of the shapes:
// taking a column is one step of a Cholesky factorisation.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace frictab::trace {

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

struct PathResult {
  bool possible = false; // enough tests, and a shape to try
  double p_value = 1;
  std::vector<std::size_t> chosen; // shapes of the shortest path that reaches alpha, else the best
  // Logarithm of the p-value by the F distribution that a single column needs to reach alpha.
  double critical_log_p = 0;
};

PathResult search_path(const PathInput& input);

// Log of the upper tail of F(q, free - q) at the partial R^2 of q columns.
double log_p_of(double r_squared, double q, double free);

} // namespace frictab::trace
