// Cuts experiments into blocks of rows.
#include "stats/blocks.h"

#include <algorithm>
#include <numeric>

#include "data/shares.h"

namespace frictab::stats {

namespace {

using Eigen::Index;

constexpr std::size_t least_most = 8; // blocks that an experiment with enough rows always has

std::size_t blocks_each(const data::Dataset& data) {
  const std::size_t tests = std::max<std::size_t>(data.experiments.size(), 1);
  return std::clamp(block_budget / tests, least_most, most_blocks);
}

double median_rows(const Blocks& blocks) {
  std::vector<double> all;
  for (std::size_t b = 0; b < blocks.count(); ++b)
    all.push_back(blocks.rows(b));
  std::nth_element(all.begin(), all.begin() + all.size() / 2, all.end());
  return all[all.size() / 2];
}

Eigen::VectorXd block_positions(const Blocks& blocks) {
  Eigen::VectorXd at(blocks.count());
  const auto& row = blocks.first_row;
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    const double begin = static_cast<double>(row[blocks.first[e]]);
    const double length = static_cast<double>(row[blocks.first[e + 1]]) - begin;
    for (std::size_t b = blocks.first[e]; b < blocks.first[e + 1]; ++b) {
      const double middle = 0.5 * static_cast<double>(row[b] + row[b + 1]);
      at(b) = (middle - begin) / length - 0.5;
    }
  }
  return at;
}

} // namespace

double Blocks::rows(std::size_t block) const {
  const std::size_t begin = first_row[block], end = first_row[block + 1];
  if (weights.empty()) return static_cast<double>(end - begin);
  return std::accumulate(weights.begin() + begin, weights.begin() + end, 0.0);
}

Eigen::VectorXd Blocks::mean(std::span<const double> per_row) const {
  Eigen::VectorXd means(count());
  for (std::size_t b = 0; b < count(); ++b) {
    double sum = 0;
    for (std::size_t i = first_row[b]; i < first_row[b + 1]; ++i)
      sum += weights.empty() ? per_row[i] : weights[i] * per_row[i];
    means(b) = sum / rows(b);
  }
  return means;
}

Eigen::MatrixXd Blocks::experiment_means(const Eigen::MatrixXd& per_block) const {
  Eigen::MatrixXd means(experiments(), per_block.cols());
  for (std::size_t e = 0; e < experiments(); ++e)
    means.row(e) = rows_of(per_block, e).colwise().mean();
  return means;
}

Blocks make_blocks(const data::Dataset& data) {
  return make_blocks(data, blocks_each(data));
}

Blocks make_blocks(const data::Dataset& data, std::size_t most) {
  Blocks blocks;
  blocks.most = most;
  blocks.first.push_back(0);
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t rows = data.first_row[e + 1] - data.first_row[e];
    const auto shares = data::equal_shares(data, e, std::min(rows, most));
    blocks.first_row.insert(blocks.first_row.end(), shares.begin(), shares.end() - 1);
    blocks.first.push_back(blocks.first_row.size());
  }
  blocks.first_row.push_back(data.rows());
  const auto weights = data.row_weights();
  blocks.weights.assign(weights.begin(), weights.end());
  blocks.position = block_positions(blocks);
  blocks.usual_rows = median_rows(blocks);
  return blocks;
}

} // namespace frictab::stats
