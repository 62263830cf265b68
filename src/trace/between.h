// Effects between tests: what is constant within a test (material, additive, tool, humidity, load)
// is judged on one value per test, apart from what changes within tests.
#pragma once

#include <string>
#include <vector>

#include "trace/candidates.h"
#include "trace/path_search.h"

namespace frictab {

// How far the friction of each test lies from the law: mean of ln(measured / law) over its rows,
// and the variance of that mean, from means of at most ten parts of the test.
struct TestGains {
  Eigen::VectorXd gain;
  Eigen::VectorXd variance;
};
TestGains test_gains(std::span<const double> measured, std::span<const double> predicted,
                     std::span<const std::size_t> first_row);

// One way in which the gain may follow a column.
struct TestShape {
  Cause cause;
  std::string form; // line | log | above | below | log1p | levels | one level | product
  Eigen::MatrixXd columns;
};

// Of every column but the order of tests: numbers by their mean over the test, text by its levels.
// `per_test`: a column's value per test.
std::vector<TestShape> test_shapes(const Candidates& candidates, const Blocks& blocks);

struct BetweenInput {
  const TestGains& gains;
  // Tests x directions that the law's own parameters, effects that are in it and what follows the
  // order of tests explain; without the mean.
  const Eigen::MatrixXd& known;
  const std::vector<TestShape>& shapes;
  const Candidates& candidates;
  double alpha = 0.01;
  std::size_t permutations = 999;
  std::uint64_t seed = 1;
};

struct BetweenFinding {
  TestShape shape;
  double p_value = 1;         // of the step that found it, over everything that was tried
  std::vector<Cause> as_good; // columns these tests cannot tell from it
};

struct BetweenResult {
  std::vector<BetweenFinding> found; // in the order found
  double last_p_value = 1;           // of what is left
  std::vector<TestShape> leads;      // the best path of what is left
  double scatter = 0;                // of the gains behind all that: relative, standard deviation
  // A column that splits the tests in halves would have been seen (80 %) from this relative
  // difference on; infinite where there are too few tests.
  double smallest_seen = 0;
};

// Forward search over paths of one to three columns on robust gains, weighted by how well each is
// known; a column also has to hold under unequal scatter (HC3), and each of several found together
// has to be found beside the others. Pairs are tried once one of the two is in.
BetweenResult search_between(const BetweenInput& input);

// p-value of a shape beside these directions (tests x directions, without the mean).
double p_beside(const TestGains& gains, const Eigen::MatrixXd& known, const TestShape& shape);

// Scatter between tests beyond what `variance` says (Paule and Mandel 1982), variance; 0: none.
double scatter_between(const Eigen::VectorXd& gain, const Eigen::VectorXd& variance,
                       const Eigen::MatrixXd& known);

} // namespace frictab
