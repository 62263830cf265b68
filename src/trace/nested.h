// What the search is worth on tests it has not seen: the whole of it - columns, forms, noise - once
// for every part of the tests that is left out.
#pragma once

#include <algorithm>

#include "calibrate/resampling.h"
#include "trace/search.h"

namespace frictab {

// Errors on left-out tests, for the law with its first 0, 1, 2, ... effects, each as the search of
// that fold found them (its last law, where it found fewer).
struct NestedErrors {
  // [weights: 0 the noise model's, 1 all rows alike][number of effects][test]
  std::vector<std::vector<ErrorSums>> sums[2];
  std::vector<Eigen::VectorXd> relative[2]; // mean of |ln(measured / predicted)| over a test's rows
  // Log density of the test's block means under the fold's law and noise model: a shape that is
  // right within tests shows in it, although tests lie high or low as a whole.
  std::vector<Eigen::VectorXd> score[2];
  std::size_t folds = 0;

  std::size_t lengths() const { return sums[0].size(); }
  // Mean over tests of what the first `effects` gain against the first `before` of them, with
  // standard errors; against none, under those weights that do better without any: no effect is to
  // mend what the weights spoil. They pay where the error falls by more than a standard error, or,
  // with tests enough to know that error by, where the score gains as much and the error hardly
  // grows: by less than a quarter of that many standard errors, and by less than one.
  struct Gain {
    double score = 0, score_se = 0;
    double error = 0, error_se = 0; // relative, smaller by so much
    std::size_t tests = 0;
    // Beside effects that pay: what is significant and gains, if less than sure, stays.
    bool adds() const { return pays() || (error > 0 && score > 0); }
    bool pays() const {
      constexpr std::size_t enough = 20;
      if (error > error_se) return true;
      const double sure = score / std::max(score_se, 1e-300); // standard errors
      return tests >= enough && sure > 1 && error > -std::min(0.25 * sure, 1.0) * error_se;
    }
  };
  Gain gain(std::size_t effects, std::size_t weights, std::size_t before = 0) const;
  // That predict left-out tests better.
  std::size_t better_weights(std::size_t effects) const;
  // So many effects that the next ones do not pay, with the weights that predict left-out tests
  // best; 0 where none do.
  struct Best {
    std::size_t effects = 0, weights = 0;
  };
  Best best() const;
};

// Leave-one-test-out, or 20 folds above 40 tests. `all`: the search on all tests, which says how
// many effects to look at and where to start the noise.
NestedErrors nested_errors(const Search& all);

} // namespace frictab
