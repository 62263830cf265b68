// Tests that differ from all others under any law.
//
// ln of a test's median coefficient is regressed on the medians of its states (ln sigma_N, ln v, T,
// ln psi: a product of powers approximates every law of the field between tests). The test
// statistic is the residual of a test from the fit of the others, over its standard error
// (studentised deleted residual: Beckman and Trussell 1974). A test is apart if this statistic is
// significant at 5 % for the whole campaign (Bonferroni), and the test is off by a factor of at
// least 1.5. The regression is repeated without it, for up to a tenth of the tests. The last of
// them has to be 2.5 times as far off, in standard errors, as the furthest of the rest: with long
// tails there is always a furthest test, but rarely such a gap.
//
// A test that alone has its level of a recorded column (a mixture, a lubricant) is not reported as
// apart: that level may be the reason.
//
// A test that is not reported may still differ from the others: half of the single tests off by 1.5
// are found, and half of those that occur in pairs.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

struct TestApart {
  std::size_t test; // index
  double factor;    // of its friction, relative to the prediction from the others
};

struct TestOf {
  const Dataset* data;
  std::size_t test;
  std::string file() const; // empty if unknown
};

// True if a recorded column has other levels in the odd tests than in all others (a lubricant, a
// material, a rig), which may be the reason for the difference. A column in which most tests do not
// share their level only names tests and is ignored.
bool are_set_otherwise(std::span<const TestOf> tests,
                       const std::function<bool(std::size_t test)>& is_odd);

// Tests apart, the furthest first. Empty for fewer than 6 tests.
std::vector<TestApart> find_tests_apart(const Dataset& data);

} // namespace frictab::data
