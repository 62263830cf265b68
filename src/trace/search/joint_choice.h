// Choice among the terms that were found: those that improve predictions of tests that did not help
// to find them.
//
// Ten folds leave out whole tests. Tests of one recording, and tests at one setting, are left out
// together, because repeats would predict each other. Each fold repeats the search over as many
// terms as on all tests. A left-out test has two measures: the mean absolute residual of the
// regression, and a log score with the tails of Student's t. Terms without which the score falls by
// less than one standard error over tests are removed, the least important first, in any order of
// entry. The remaining terms improve predictions if the mean error falls by more than its standard
// error, or if the score gains more than its own and the error falls.
#pragma once

#include "trace/search/joint_search.h"

namespace frictab::trace {

// Tests left out together, and the terms that the search finds on the others, without those dropped
// on all tests.
struct JointFold {
  std::vector<std::size_t> out;
  std::vector<std::size_t> terms;
};

struct JointChoice {
  std::vector<JointStep> kept;    // in the order in which they entered
  std::vector<JointStep> dropped; // did not improve predictions
  std::vector<JointFold> folds;   // empty: nothing was found
  // whether the folds' terms improve predictions of the tests that they leave out
  bool pays = false;
};

// Repeats the search in folds and chooses. `modes`: of the tests; `states`: per test, scaled to a
// standard deviation of 1 (may have no columns).
JointChoice choose_jointly(const JointData& data, const Modes& modes, const JointOffer& offer,
                           const JointSettings& settings, const JointPath& path,
                           const MatrixXd& states);

// Standard error of the mean over tests.
double std_error(const VectorXd& per_test);

} // namespace frictab::trace
