// Tests that occur twice under two names: a copied file, or a glob that matches both.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// For each experiment of `data`, the first other one in `others` with the same rows, or of which
// one is the beginning of the other: bit for bit, in every canonical quantity that both have.
// (Other columns may be labels: a batch, a place in the order of tests.) `others` may be `data`
// itself. Experiments of fewer than 4 rows or with a constant tau_R_MPa are not compared: summaries
// of repeated tests may be equal by chance.
std::vector<std::optional<std::size_t>> tests_of_equal_rows(const Dataset& data,
                                                            const Dataset& others);

// For each test of `data`, a test of `others` that has the same noise: to within a fiftieth the
// same stress in every row, and second differences that go together, as those of two measurements
// never do. A copy whose values were changed a little; equal rows are not looked for again. Tests
// need rows enough for a correlation (noise_rows).
inline constexpr std::size_t noise_rows = 25;
std::vector<std::optional<std::size_t>> tests_of_same_noise(const Dataset& data,
                                                            const Dataset& others);

} // namespace frictab::data
