// Blocks of tests of which only the numbers of rows matter.
#pragma once

#include <fmt/format.h>

#include "stats/blocks.h"

namespace frictab::test {

inline stats::Blocks blocks_of(const std::vector<std::size_t>& rows) {
  data::Dataset data;
  for (const std::size_t count : rows) {
    data.experiments.push_back(fmt::format("{}", data.experiments.size()));
    data.first_row.push_back(data.first_row.back() + count);
  }
  return stats::make_blocks(data);
}

} // namespace frictab::test
