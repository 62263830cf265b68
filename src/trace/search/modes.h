// Transform of a test to a few numbers with independent noise: the means of at most twelve pieces,
// transformed to cosines along the test. The first is the test's mean (its gain), the second
// roughly its slope, the next two slow waves; the remaining ones form the last class. Noise that is
// slow within tests, and larger between tests than within, has a nearly diagonal covariance in
// these modes: one variance for each of the four classes.
//
// Above 500 tests each test has fewer than twelve pieces: 6,000 / tests, rounded down, and at least
// two. Many tests determine shared structure as well with fewer pieces each.
#pragma once

#include <array>
#include <vector>

#include "stats/blocks.h"
#include "trace/basics.h"

namespace frictab::trace {

inline constexpr std::size_t mode_classes = 4; // gain | slope | two slow waves | the rest

class Modes {
public:
  explicit Modes(const stats::Blocks& blocks);

  // Transforms columns of block values to modes x columns, sorted by class.
  MatrixXd of(const Eigen::Ref<const MatrixXd>& per_block) const;
  // Mean absolute value over the pieces of a test, computed from its modes (`modes` holds those of
  // all tests).
  double mean_size(const VectorXd& modes, std::size_t test) const;

  std::size_t tests() const { return of_test_.size(); }
  // First mode of each class; last, the number of modes.
  const std::array<Index, mode_classes + 1>& first() const { return first_; }
  const std::vector<std::size_t>& test() const { return test_; } // of each mode
  // Positions of a test's modes, from its gain to its fastest wave.
  const std::vector<Index>& of_test(std::size_t test) const { return of_test_[test]; }
  static std::size_t class_of(std::size_t mode);

private:
  std::vector<std::size_t> first_block_; // per test; last, the number of blocks
  std::array<Index, mode_classes + 1> first_{};
  std::vector<std::size_t> test_;
  std::vector<std::vector<Index>> of_test_;
  std::vector<MatrixXd> waves_; // by number of pieces: modes x pieces
};

} // namespace frictab::trace
