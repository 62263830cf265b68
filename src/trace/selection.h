// Whole tests that stand for all of a large campaign where a few hundred determine a thing as well:
// the few parameters of the noise model, where a fit starts, which forms deserve to be fitted to
// all tests. Whatever gives a p-value, a size or an error takes every test.
#pragma once

#include <memory>

#include "trace/candidates.h"

namespace frictab::trace {

struct Selection {
  std::vector<Eigen::Index> rows; // blocks of the selected tests, among all
  Blocks blocks;                  // those; `usual_rows` is that of all
  Candidates candidates;          // with values of those in by_symbol, none in the columns
  double share = 1;               // of all blocks
};

// As many as the largest campaign that is not cut. (Of so many tests a standard deviation between
// tests is known to 1/sqrt(2 x 200), 5 %, which moves no weight that matters.)
inline constexpr std::size_t selected_tests = uncut_experiments;

// Spread evenly over the tests as they are sorted: one, drawn by `seed`, of each of 200 runs of
// neighbours. (At equal steps they could meet the same level of a factorial design every time.)
// nullptr where there are no more tests than that.
std::shared_ptr<const Selection> select_tests(const Blocks& blocks, const Candidates& candidates,
                                              std::uint64_t seed);

} // namespace frictab::trace
