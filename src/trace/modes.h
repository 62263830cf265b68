// A test as a few numbers with independent noise: the means of at most twelve pieces, turned into
// cosines along the test. The first is the test's mean (its gain), the second about its slope, two
// more are slow waves; the others are what is left. Noise that is slow within tests, and larger
// between them than within, is nearly diagonal in them: one variance for each of four classes.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "trace/blocks.h"

namespace frictab::trace {

inline constexpr std::size_t mode_classes = 4; // gain | slope | two slow waves | the rest

class Modes {
public:
  explicit Modes(const Blocks& blocks);

  // Modes x columns, the classes one behind the other, of columns of block values.
  Eigen::MatrixXd of(const Eigen::Ref<const Eigen::MatrixXd>& per_block) const;
  // Mean size of the pieces of a test whose modes these are (of all tests: of `modes`, its own).
  double mean_size(const Eigen::VectorXd& modes, std::size_t test) const;

  std::size_t tests() const { return of_test_.size(); }
  // Where a class begins; behind the last one their number.
  const std::array<Eigen::Index, mode_classes + 1>& first() const { return first_; }
  const std::vector<std::size_t>& test() const { return test_; } // of each mode
  // Places of a test's modes, from its gain to its fastest wave.
  const std::vector<Eigen::Index>& of_test(std::size_t test) const { return of_test_[test]; }
  static std::size_t class_of(std::size_t mode);

private:
  std::vector<std::size_t> first_block_; // per test, and behind the last one
  std::array<Eigen::Index, mode_classes + 1> first_{};
  std::vector<std::size_t> test_;
  std::vector<std::vector<Eigen::Index>> of_test_;
  std::vector<Eigen::MatrixXd> waves_; // by number of pieces: modes x pieces
};

} // namespace frictab::trace
