// Means of pieces of tests, and their cosine transform.
#include "trace/search/modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// First row: the mean; other rows: orthonormal cosines.
MatrixXd waves_of(std::size_t pieces) {
  const Index n = pieces;
  MatrixXd waves = MatrixXd::Constant(n, n, 1 / static_cast<double>(pieces));
  for (Index k = 1; k < n; ++k)
    for (Index i = 0; i < n; ++i)
      waves(k, i) = std::sqrt(2.0 / static_cast<double>(n)) *
                    std::cos(std::numbers::pi * static_cast<double>(k) *
                             (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  return waves;
}

} // namespace

std::size_t Modes::class_of(std::size_t mode) {
  return mode < 2 ? mode : mode < 4 ? 2 : 3;
}

Modes::Modes(const stats::Blocks& blocks)
    : first_block_(blocks.first), of_test_(blocks.experiments()) {
  const std::size_t most =
      std::clamp(tuning::most_pieces_of_campaign / std::max<std::size_t>(tests(), 1),
                 tuning::fewest_pieces_of_test, tuning::most_pieces_of_test);
  for (std::size_t pieces = 0; pieces <= most; ++pieces)
    waves_.push_back(waves_of(pieces));
  for (std::size_t c = 0; c < mode_classes; ++c) {
    first_[c] = test_.size();
    for (std::size_t t = 0; t < tests(); ++t)
      for (std::size_t mode = 0; mode < std::min(most, first_block_[t + 1] - first_block_[t]);
           ++mode)
        if (class_of(mode) == c) {
          of_test_[t].push_back(test_.size());
          test_.push_back(t);
        }
  }
  first_[mode_classes] = test_.size();
}

MatrixXd Modes::of(const Eigen::Ref<const MatrixXd>& per_block) const {
  MatrixXd modes(first_[mode_classes], per_block.cols());
  for (std::size_t t = 0; t < tests(); ++t) {
    const std::size_t pieces = of_test_[t].size(), begin = first_block_[t],
                      blocks = first_block_[t + 1] - begin;
    MatrixXd means(pieces, per_block.cols());
    for (std::size_t i = 0; i < pieces; ++i) {
      const std::size_t from = i * blocks / pieces, to = (i + 1) * blocks / pieces;
      means.row(i) = per_block.middleRows(begin + from, to - from).colwise().mean();
    }
    modes(of_test_[t], Eigen::all) = waves_[pieces] * means;
  }
  return modes;
}

double Modes::mean_size(const VectorXd& modes, std::size_t test) const {
  const auto& at = of_test_[test];
  VectorXd own = modes(at);
  MatrixXd back = waves_[at.size()].transpose();
  back.col(0).setOnes();
  return (back * own).cwiseAbs().mean();
}

} // namespace frictab::trace
