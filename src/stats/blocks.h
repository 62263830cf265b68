// Blocks of neighbouring rows of each experiment. Noise is correlated over many rows, so block
// means lose no information and cost a tenth.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "data/dataset.h"

namespace frictab::stats {

// Number of experiments up to which each may have the largest number of blocks.
inline constexpr std::size_t uncut_experiments = 200, most_blocks = 40;
inline constexpr std::size_t block_budget = uncut_experiments * most_blocks; // of all experiments

struct Blocks {
  std::vector<std::size_t> first;     // per experiment its first block; last, the number of blocks
  std::vector<std::size_t> first_row; // per block its first row; last, the number of rows
  // Middle of each block in its experiment: -1/2 is the first row, 1/2 the last.
  Eigen::VectorXd position;
  double usual_rows = 1;          // median of a block; the noise model's white part refers to it
  std::size_t most = most_blocks; // largest number per experiment
  std::vector<double> weights;    // number of source rows that each row represents; empty: 1

  std::size_t count() const { return first.back(); }
  std::size_t experiments() const { return first.size() - 1; }
  double rows(std::size_t block) const;
  // Returns the part of a vector over blocks, or of the rows of a matrix, of one experiment.
  template <class Vector> auto part(Vector&& vector, std::size_t experiment) const {
    return vector.segment(first[experiment], first[experiment + 1] - first[experiment]);
  }
  template <class Matrix> auto rows_of(Matrix&& matrix, std::size_t experiment) const {
    return matrix.middleRows(first[experiment], first[experiment + 1] - first[experiment]);
  }
  // Returns the mean of the rows of each block.
  Eigen::VectorXd mean(std::span<const double> per_row) const;
  // Returns the mean of the blocks of each experiment.
  Eigen::MatrixXd experiment_means(const Eigen::MatrixXd& per_block) const;
};

// Cuts each experiment into at most `most` blocks with about the same number of rows; an experiment
// with fewer rows has one block per row.
Blocks make_blocks(const data::Dataset& data, std::size_t most);

// The same with at most 40 per experiment, enough for a single long one. Above 200 experiments all
// share a budget of 40 x 200 blocks, which limits the work, but each may still have 8: 405
// experiments have 19 each, 1,000 and more have 8. Structure that many experiments share shows in
// the sum over them; waves or a run-in shorter than an eighth of the stroke are detected less well.
Blocks make_blocks(const data::Dataset& data);

} // namespace frictab::stats
