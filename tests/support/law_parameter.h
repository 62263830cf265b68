// Registered laws as parameters of tests.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace frictab::test {

// The first of each formula. Constants of the literature and means share formulas with fitted laws:
// sources that are made of them are the same texts with other numbers.
std::vector<std::string> laws_by_formula();

// The law as part of a test's name: "coulomb_0_04".
std::string law_test_name(const testing::TestParamInfo<std::string>& law);

} // namespace frictab::test
