// Tests that a campaign holds twice under two names: a file that was copied, a glob that finds
// both.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// For each experiment of `data` the first other one in `others` that has the same rows: bit for
// bit, in every canonical quantity that both data have. (Its other columns may be labels: a batch,
// a place in the order of tests.) `others` may be `data` itself. Not compared are experiments of
// fewer than 4 rows and of one tau_R_MPa throughout: summaries of repeated tests may be equal by
// chance.
std::vector<std::optional<std::size_t>> tests_of_equal_rows(const Dataset& data,
                                                            const Dataset& others);

} // namespace frictab::data
