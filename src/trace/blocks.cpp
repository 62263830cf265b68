// Cuts experiments into blocks of rows.
#include "trace/blocks.h"

#include <algorithm>

namespace frictab {

namespace {

constexpr std::size_t usual_blocks = 55;
constexpr std::size_t most_blocks = 4 * usual_blocks; // of an experiment much longer than others

std::size_t median_rows(const Dataset& data) {
  std::vector<std::size_t> rows;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    rows.push_back(data.first_row[e + 1] - data.first_row[e]);
  std::nth_element(rows.begin(), rows.begin() + static_cast<long>(rows.size() / 2), rows.end());
  return rows[rows.size() / 2];
}

} // namespace

Eigen::VectorXd Blocks::mean(std::span<const double> per_row) const {
  Eigen::VectorXd means(static_cast<Eigen::Index>(count()));
  for (std::size_t b = 0; b < count(); ++b) {
    double sum = 0;
    for (std::size_t i = first_row[b]; i < first_row[b + 1]; ++i)
      sum += per_row[i];
    means(static_cast<Eigen::Index>(b)) =
        sum / static_cast<double>(first_row[b + 1] - first_row[b]);
  }
  return means;
}

Blocks make_blocks(const Dataset& data) {
  const std::size_t size = std::max<std::size_t>(1, median_rows(data) / usual_blocks);
  Blocks blocks;
  blocks.first.push_back(0);
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t begin = data.first_row[e], rows = data.first_row[e + 1] - begin;
    const std::size_t count = std::clamp<std::size_t>(rows / size, 1, most_blocks);
    for (std::size_t b = 0; b < count; ++b)
      blocks.first_row.push_back(begin + b * rows / count);
    blocks.first.push_back(blocks.first_row.size());
  }
  blocks.first_row.push_back(data.rows());
  return blocks;
}

} // namespace frictab
