// The low-discrepancy sequence.
#include "core/random.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace frictab::random_test {
namespace {

TEST(Halton, IsTheRadicalInverseInThePrimes) {
  std::array<double, 3> point;
  halton(0, point);
  EXPECT_EQ(point, (std::array<double, 3>{1.0 / 2, 1.0 / 3, 1.0 / 5}));
  halton(10, point); // 11 = 1011 in base 2, 102 in base 3, 21 in base 5
  EXPECT_DOUBLE_EQ(point[0], 0.5 + 0.25 + 0.0625);
  EXPECT_DOUBLE_EQ(point[1], 2.0 / 3 + 1.0 / 27);
  EXPECT_DOUBLE_EQ(point[2], 1.0 / 5 + 2.0 / 25);
}

// A traced law may have as many arguments as its effects name.
TEST(Halton, HasAnyNumberOfCoordinates) {
  std::vector<double> point(100);
  halton(0, point);
  EXPECT_DOUBLE_EQ(point[31], 1.0 / 131);
  EXPECT_DOUBLE_EQ(point[32], 1.0 / 137);
  EXPECT_DOUBLE_EQ(point[99], 1.0 / 541);
}

} // namespace
} // namespace frictab::random_test
