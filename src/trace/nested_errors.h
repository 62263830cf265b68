// What a traced law is worth on tests that the search has not seen.
//
// A search over thousands of shapes always finds something that fits the tests it has seen. So
// which columns a law lacks is decided anew without each fold (joint_choice.h), the law is fitted
// with those to the tests that are left in, and predicts the others. Forms are those of the search
// on all tests where it has the same cause, else smooth ones. Two measures of a test:
//   error  mean of |ln(measured / predicted)| over its rows;
//   score  log density of its block means under the fold's law and noise model, with the tails of
//          Student's t (5 degrees of freedom), so that one test for which a noise model is too sure
//          of itself does not outweigh all others. An effect within tests shows in the score even
//          where the tests lie high or low as a whole, which the error mostly sees.
// The mean gain of either over tests has a standard error.
#pragma once

#include <memory>

#include "calibrate/resampling.h"
#include "trace/search.h"

namespace frictab::trace {

// Per test.
struct LeftOut {
  std::vector<calibrate::ErrorSums> sums;
  Eigen::VectorXd relative; // mean of |ln(measured / predicted)| over its rows
  Eigen::VectorXd score;
};

struct NestedErrors {
  // Of a law under one kind of weights.
  struct Weighted {
    LeftOut none, all;            // effects
    std::vector<LeftOut> without; // one of those of the law; under the better weights alone
  };
  Weighted weighted[2]; // the noise model's | all rows alike
  std::size_t folds = 0;

  struct Gain {
    double score = 0, score_se = 0;
    double error = 0, error_se = 0; // relative, smaller by so much
  };
  // Mean over tests, against the law without effects under the weights that suit it better: effects
  // are not credited with mending what the noise model's weights have spoiled.
  Gain gain(std::size_t weights) const;
  // Those that predict left-out tests clearly better.
  std::size_t better_weights(bool with_effects) const;
};

class FoldJudge;

// A campaign without each fold of a search.
class NestedJudge {
public:
  explicit NestedJudge(const Search& search);
  ~NestedJudge();
  // `law`: with some of the effects of the search; also without each of them.
  NestedErrors errors(const Rival& law) const;

private:
  std::size_t tests_;
  std::vector<std::unique_ptr<FoldJudge>> folds_;
};

} // namespace frictab::trace
