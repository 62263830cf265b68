// Tests that occur twice under two names: a copied file, or a glob that matches both.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// For each experiment of `data`, the first other one in `others` with the same rows: bit for bit,
// in every canonical quantity that both have. (Other columns may be labels: a batch, a place in the
// order of tests.) `others` may be `data` itself. Experiments of fewer than 4 rows or with a
// constant tau_R_MPa are not compared: summaries of repeated tests may be equal by chance.
std::vector<std::optional<std::size_t>> tests_of_equal_rows(const Dataset& data,
                                                            const Dataset& others);

} // namespace frictab::data
