// Selection of whole tests that represents a large campaign for purposes that a few hundred tests
// serve as well: the few parameters of the noise model, starts of fits, the choice of forms to fit
// to all tests. P-values, sizes and errors always use every test.
#pragma once

#include <memory>

#include "trace/columns/candidates.h"

namespace frictab::trace {

struct Selection {
  std::vector<Index> rows; // indices of the selected tests' blocks
  stats::Blocks blocks;    // blocks of these tests; `usual_rows` is that of all tests
  Candidates candidates;   // with values in by_symbol only, none in the columns
  double share = 1;        // of all blocks
};

// Selects evenly over the tests in their sorted order: from each of 200 runs of neighbours one,
// drawn by `seed`. (Equal steps could hit the same level of a factorial design every time.) Returns
// nullptr if the campaign has no more tests than that.
std::shared_ptr<const Selection> select_tests(const stats::Blocks& blocks,
                                              const Candidates& candidates, std::uint64_t seed);

} // namespace frictab::trace
