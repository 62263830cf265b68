// Tests that lie apart from all others, whatever the law.
//
// ln of a test's median coefficient is regressed on the medians of its states (ln sigma_N, ln v, T,
// ln psi: a product of powers comes near every law of the field between tests). A test is apart
// where the residual from the fit of the others, over its standard error (studentised and deleted:
// Beckman and Trussell 1974), is one of 20 such campaigns' largest at most (Bonferroni, 5 %), and
// the test is off by a factor of 1.5 and more. Then again without it, up to a tenth of the tests.
// The last of them has to be 2.5 times as far off, in standard errors, as the furthest of the rest:
// where tests scatter with long tails there is always a furthest one, and rarely such a gap.
//
// A test that alone has its level of a recorded column (a mixture, a lubricant) is not called
// apart: that level may be the reason.
//
// That a test is not named does not say that it is like the others: of tests off by 1.5 half are
// found, and of two alike half.
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
  double factor;    // of its friction, over what the others say
};

struct TestOf {
  const Dataset* data;
  std::size_t test;
  std::string file() const; // empty where it is not known
};

// Whether a recorded column has other levels in the odd tests than in all others (a lubricant, a
// material, a rig), which may be the reason why they differ. A column of which most tests do not
// share their level names tests.
bool are_set_otherwise(std::span<const TestOf> tests,
                       const std::function<bool(std::size_t test)>& is_odd);

// The furthest first. With fewer than 6 tests nothing can be said.
std::vector<TestApart> find_tests_apart(const Dataset& data);

} // namespace frictab::data
