// Which of the terms that were found are worth having, on tests that did not help to find them.
//
// Ten folds leave out whole tests (those of one recording, and those at one setting, together:
// repeats would tell each other), and each walks as far as all tests did. Two measures of a test
// left out: the mean size of what the regression leaves there, and a log score with the tails of
// Student's t. Terms without which the score falls by less than a standard error over tests are
// taken off again, the least first, whatever their place. The rest is worth having where the mean
// error falls by more than a standard error, or the score gains more than one and the error falls.
#pragma once

#include "trace/joint_search.h"

namespace frictab::trace {

// Tests left out together, and the terms that the others find; without those dropped on all tests.
struct JointFold {
  std::vector<std::size_t> out;
  std::vector<std::size_t> terms;
};

struct JointChoice {
  std::vector<JointStep> kept;    // in the order in which they entered
  std::vector<JointStep> dropped; // did not pay
  std::vector<JointFold> folds;   // none: nothing was found
  bool pays = false;              // what the folds find, on the tests that they leave out
};

// `modes` of the tests; `states`: per test, scaled to a standard deviation of 1 (may have no
// columns).
JointChoice choose_jointly(const JointData& data, const Modes& modes, const JointOffer& offer,
                           const JointSettings& settings, const JointPath& path,
                           const Eigen::MatrixXd& states);

// Whether a column is in one of the products of `of_all`: it stays for these.
bool is_in_product(const std::vector<std::size_t>& columns,
                   const std::vector<std::vector<std::size_t>>& of_all);

// Of the mean over tests.
double std_error(const Eigen::VectorXd& per_test);

// The fold of each test.
std::vector<std::size_t> folds_of_settings(const std::vector<std::size_t>& units,
                                           const Eigen::MatrixXd& states, std::size_t folds,
                                           std::uint64_t seed);

} // namespace frictab::trace
