// Errors of a traced law on tests that the search has not seen.
//
// A search over thousands of shapes always finds something that fits the tests it has seen. So the
// columns that a law lacks are searched again without each fold (joint_choice.h), and the law with
// them is fitted to the remaining tests and predicts the left-out ones. Forms are those of the
// search on all tests where it has the same cause, else smooth ones. Measures of a test:
//   error  mean of |ln(measured / predicted)| over its rows;
//   score  log density of its block means under the fold's law and noise model, with the tails of
//          Student's t (5 degrees of freedom), so that one test for which a noise model is
//          overconfident does not outweigh all others. An effect within tests improves the score
//          even where tests lie high or low as a whole, which dominates the error.
// The mean gain of either over tests has a standard error.
#pragma once

#include <memory>

#include "stats/resampling.h"
#include "trace/search/search.h"

namespace frictab::trace {

// Errors of left-out tests, one entry per test.
struct LeftOut {
  std::vector<stats::ErrorSums> sums;
  VectorXd relative; // mean of |ln(measured / predicted)| over its rows
  VectorXd score;
};

struct NestedErrors {
  // Errors under one kind of weights.
  struct Weighted {
    LeftOut none, all;            // without effects, with all of them
    std::vector<LeftOut> without; // without each effect; only under the better weights
  };
  Weighted weighted[2]; // the noise model's | all rows alike
  std::size_t folds = 0;

  // Mean gain over tests, compared with the law without effects under the weights that suit it
  // better: effects are not credited for repairing a fit that the noise model's weights have
  // worsened. Leaves the numbers of effects open.
  NestedCheck gain(std::size_t weights) const;
  // Index of the weights that predict left-out tests clearly better.
  std::size_t better_weights(bool with_effects) const;
};

class FoldJudge;

// Refits of a campaign without each fold of its search.
class NestedJudge {
public:
  explicit NestedJudge(const Found& found);
  // Errors of a law with some of the effects of the search, and without each of these.
  NestedErrors errors(const Rival& law) const;

private:
  std::size_t tests_;
  std::vector<std::shared_ptr<FoldJudge>> folds_;
};

} // namespace frictab::trace
