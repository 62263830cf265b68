// Order statistics without a full sort.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace frictab {

// Reorders values begin .. end - 1 so that each of these ranks (ascending, in that range) holds the
// value that a full sort would put there.
inline void place_ranks(std::vector<double>& values, std::size_t begin, std::size_t end,
                        std::span<const std::size_t> ranks) {
  if (ranks.empty()) return;
  const std::size_t rank = ranks[ranks.size() / 2];
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<long>(i); };
  std::nth_element(at(begin), at(rank), at(end));
  const auto [same, above] = std::equal_range(ranks.begin(), ranks.end(), rank);
  place_ranks(values, begin, rank, {ranks.begin(), same});
  place_ranks(values, rank + 1, end, {above, ranks.end()});
}

inline void place_ranks(std::vector<double>& values, std::span<const std::size_t> ranks) {
  place_ranks(values, 0, values.size(), ranks);
}

} // namespace frictab
