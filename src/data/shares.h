// Cuts an experiment into shares of equal numbers of rows; for condensed data, of source rows.
#pragma once

#include <algorithm>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// First stored row of each of at most `parts` shares, and the end. A block is in one share.
inline std::vector<std::size_t> equal_shares(const Dataset& data, std::size_t experiment,
                                             std::size_t parts) {
  const std::size_t begin = data.first_row[experiment], end = data.first_row[experiment + 1];
  std::vector<std::size_t> before{0}; // source rows before each stored row, and the total
  for (std::size_t i = begin; i < end; ++i)
    before.push_back(before.back() + static_cast<std::size_t>(data.row_weight(i)));
  std::vector<std::size_t> first;
  auto next = before.begin();
  for (std::size_t p = 0; p < parts; ++p) {
    next = std::lower_bound(next, before.end() - 1, p * before.back() / parts);
    if (next + 1 == before.end()) break;
    first.push_back(begin + static_cast<std::size_t>(next - before.begin()));
    ++next;
  }
  first.push_back(end);
  return first;
}

} // namespace frictab::data
