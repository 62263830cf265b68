// The test between tests: what is constant within a test (material, additive, tool, humidity, load)
// is judged on one value per test, its gain, apart from what changes within tests.
//
// A step of the search:
// 1. Each test's gain has the weight 1/(sigma_b^2 + s_e^2): s_e^2 is how well the gain is known
//    from its own rows, sigma_b^2 the scatter between tests beyond that (Paule and Mandel 1982).
//    Without the first a few short, noisy tests hide everything.
// 2. Gains are cut at 2.5 robust standard deviations from Huber's fit, so that one wild test
//    decides nothing.
// 3. Paths of one to three columns are searched and judged by permutation (path_search.h).
// 4. Each column of the path also has to hold under unequal scatter (HC3: MacKinnon and White
//    1985); of several columns each has to be found again beside the others.
// Steps are repeated until nothing more is found.
#pragma once

#include <string>
#include <vector>

#include "trace/candidates.h"
#include "trace/path_search.h"
#include "trace/test_shapes.h"

namespace frictab::trace {

// How far the friction of each test lies from the law: mean of ln(measured / law) over its rows,
// and the variance of that mean, from means of at most ten parts of the test.
struct TestGains {
  Eigen::VectorXd gain;
  Eigen::VectorXd variance;
};
TestGains test_gains(const data::Dataset& data, std::span<const double> predicted);

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

// On a path whose p-value was small enough, and not added all the same.
struct Doubtful {
  TestShape shape;
  std::vector<TestShape> beside; // the others of the path
  double p_value = 1;            // as of a finding, of the whole path
  // True: sure if all tests scatter alike, and not if they need not (HC3), so few tests carry it.
  // False: not sure beside the others of its path.
  bool few_tests = false;
};

struct BetweenResult {
  std::vector<BetweenFinding> found; // in the order found
  std::vector<Doubtful> doubtful;    // in the order met
  double last_p_value = 1;           // of what is left
  std::vector<TestShape> leads;      // the best path of what is left
  double scatter = 0;                // of the gains behind all that: relative, standard deviation
  // The smallest relative difference between two halves of the tests that would have been found
  // with a probability of 80 %; infinite where there are too few tests.
  double smallest_seen = 0;
};

// The search described above. Products of two columns are tried once one of the two is in.
BetweenResult search_between(const BetweenInput& input);

// p-value of a shape beside these directions (tests x directions, without the mean).
double p_beside(const TestGains& gains, const Eigen::MatrixXd& known, const TestShape& shape);

// Scatter between tests beyond what `variance` says (Paule and Mandel 1982), variance; 0: none.
double scatter_between(const Eigen::VectorXd& gain, const Eigen::VectorXd& variance,
                       const Eigen::MatrixXd& known);

} // namespace frictab::trace
