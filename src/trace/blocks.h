// Rows of each experiment in blocks of neighbours: noise is correlated over many rows, so nothing
// is lost, and everything costs a tenth.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "data/dataset.h"

namespace frictab::trace {

// Up to so many experiments nothing is cut, and each has so many blocks at most.
inline constexpr std::size_t uncut_experiments = 200, most_blocks = 40;
inline constexpr std::size_t block_budget = uncut_experiments * most_blocks; // of all

struct Blocks {
  std::vector<std::size_t> first;     // per experiment its first block, then the number of blocks
  std::vector<std::size_t> first_row; // per block its first row, then the number of rows
  // Per block, where its middle lies in its experiment: -1/2 first row, 1/2 last row.
  Eigen::VectorXd position;
  double usual_rows = 1;          // median of a block: what the noise model's white part belongs to
  std::size_t most = most_blocks; // of an experiment
  std::vector<double> weights;    // per row how many it stands for; empty: one each

  std::size_t count() const { return first.back(); }
  std::size_t experiments() const { return first.size() - 1; }
  double rows(std::size_t block) const;
  // Per block, the mean of its rows.
  Eigen::VectorXd mean(std::span<const double> per_row) const;
  // Per experiment, the mean of its blocks.
  Eigen::MatrixXd experiment_means(const Eigen::MatrixXd& per_block) const;
};

// At most `most` blocks per experiment, all of about the same number of rows within it; an
// experiment with fewer rows has a block for each.
Blocks make_blocks(const data::Dataset& data, std::size_t most);

// The same with 40, which one long experiment needs. Above 200 experiments the blocks of all share
// a budget of 40 x 200, and an experiment keeps at least 8: what many experiments have in common
// shows in the sum over them (docs/tracing.md).
Blocks make_blocks(const data::Dataset& data);

} // namespace frictab::trace
