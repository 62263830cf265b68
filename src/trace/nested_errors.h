// Nested cross-validation: what the search is worth on tests it has not seen.
//
// A search over thousands of shapes always finds something that fits the tests it has seen. So the
// whole search (columns, forms, noise) is repeated without one test, or a twentieth of the tests
// where there are more than 40, and its laws predict the tests left out. Two measures of a test:
//   error  mean of |ln(measured / predicted)| over its rows;
//   score  log density of its block means under the fold's law and noise model, with the tails of
//          Student's t (5 degrees of freedom), so that one test for which a noise model is too sure
//          of itself does not outweigh all others. An effect within tests shows in the score even
//          where the tests lie high or low as a whole, which the error mostly sees.
// The mean gain of either over tests has a standard error. Effects pay where the error falls by
// more than one of it, or, with at least 20 tests, where the score gains by more than one of its
// own and the error hardly grows: by less than a quarter of that many standard errors, and by less
// than one.
#pragma once

#include <algorithm>

#include "calibrate/resampling.h"
#include "trace/search.h"

namespace frictab::trace {

// Errors on left-out tests, for the law with its first 0, 1, 2, ... effects, each as the search of
// that fold found them (its last law, where it found fewer).
struct NestedErrors {
  // [weights: 0 the noise model's, 1 all rows alike][number of effects][test]
  std::vector<std::vector<calibrate::ErrorSums>> sums[2];
  std::vector<Eigen::VectorXd> relative[2]; // mean of |ln(measured / predicted)| over a test's rows
  // Log density of the test's block means under the fold's law and noise model: a shape that is
  // right within tests shows in it, although tests lie high or low as a whole.
  std::vector<Eigen::VectorXd> score[2];
  std::size_t folds = 0;

  std::size_t lengths() const { return sums[0].size(); }
  // Mean over tests of what the first `effects` gain against the first `before` of them, with
  // standard errors. The error without any effect is that of the better weights: effects are not
  // credited with mending what the noise model's weights have spoiled.
  struct Gain {
    double score = 0, score_se = 0;
    double error = 0, error_se = 0; // relative, smaller by so much
    std::size_t tests = 0;
    // Enough for a further effect beside effects that pay: it was significant, and it gains in
    // both.
    bool adds() const { return pays() || (error > 0 && score > 0); }
    bool pays() const {
      constexpr std::size_t enough = 20;
      if (error > error_se) return true;
      const double sure = score / std::max(score_se, 1e-300); // standard errors
      return tests >= enough && sure > 1 && error > -std::min(0.25 * sure, 1.0) * error_se;
    }
  };
  Gain gain(std::size_t effects, std::size_t weights, std::size_t before = 0) const;
  // Those that predict left-out tests better: 0 the noise model's, 1 all rows alike.
  std::size_t better_weights(std::size_t effects) const;
  // How many effects pay (0: none do), and the weights that predict left-out tests best with them.
  struct Best {
    std::size_t effects = 0, weights = 0;
  };
  Best best() const;
};

// As many as tests up to 40 of them, then 20; above 400 tests fewer, and never fewer than 4.
std::size_t count_of_folds(std::size_t tests);

// Leave-one-test-out, or 20 folds above 40 tests. `all`: the search on all tests, which says how
// many effects to look at and where to start the noise.
NestedErrors nested_errors(const Search& all);

} // namespace frictab::trace
