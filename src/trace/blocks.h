// Rows of each experiment in blocks of neighbours: noise is correlated over many rows, so nothing
// is lost, and everything costs a tenth.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "data/dataset.h"

namespace frictab {

struct Blocks {
  std::vector<std::size_t> first;     // per experiment its first block, then the number of blocks
  std::vector<std::size_t> first_row; // per block its first row, then the number of rows

  std::size_t count() const { return first.back(); }
  std::size_t experiments() const { return first.size() - 1; }
  // Per block, the mean of its rows.
  Eigen::VectorXd mean(std::span<const double> per_row) const;
};

// About 55 blocks per experiment; an experiment with few rows has a block for each.
Blocks make_blocks(const Dataset& data);

} // namespace frictab
