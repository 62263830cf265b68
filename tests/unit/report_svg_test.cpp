// Plot axes, densities and numbers as text.
#include "report/svg.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/number.h"

namespace frictab {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(Svg, AxesEndAtNiceTicksAroundTheData) {
  const svg::Axis axis = svg::nice_axis(3.2, 187, "x");
  EXPECT_THAT(axis.ticks, ElementsAre(0, 50, 100, 150, 200));
  EXPECT_EQ(axis.decimals, 0);
  const svg::Axis small = svg::nice_axis(-0.012, 0.031, "x", 5);
  EXPECT_LE(small.low, -0.012);
  EXPECT_GE(small.high, 0.031);
  EXPECT_EQ(small.decimals, 2);
}

TEST(Svg, AxesOfOnePointOrOfNothingHaveRoom) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [low, high] : {std::pair{0.0, 0.0},
                                  {5.0, 5.0},
                                  {-1e-300, 1e-300},
                                  {nan, 1.0},
                                  {1e15, 1e15},
                                  {3.0, -3.0}}) {
    const svg::Axis axis = svg::nice_axis(low, high, "x");
    EXPECT_LT(axis.low, axis.high);
    EXPECT_TRUE(std::isfinite(axis.high - axis.low));
    EXPECT_GE(axis.ticks.size(), 2u);
    EXPECT_LT(axis.ticks.size(), 20u);
  }
}

TEST(Svg, EveryPointIsInOneCellOrCountedOutside) {
  const svg::Axis axis = svg::nice_axis(0, 10, "x");
  const std::vector<double> x{0, 10, 5, 11, std::numeric_limits<double>::quiet_NaN()};
  const std::vector<double> y{0, 10, 5, 5, 5};
  const svg::Density density = svg::bin(x, y, axis, axis, 2, 2);
  EXPECT_THAT(density.count, ElementsAre(1, 0, 0, 2));
  EXPECT_EQ(density.outside, 2u);
}

TEST(Svg, ColourStepsCoverTheLargestCount) {
  EXPECT_TRUE(svg::colour_steps(0).empty());
  EXPECT_THAT(svg::colour_steps(1), ElementsAre(1));
  EXPECT_THAT(svg::colour_steps(60), ElementsAre(1, 2, 5, 10, 20, 50));
  EXPECT_THAT(svg::colour_steps(700, 4), ElementsAre(1, 100, 200, 500));
  EXPECT_THAT(svg::colour_steps(4'294'967'295u).back(), 2'000'000'000u);
}

TEST(Svg, NeighbouringCellsOfOneColourAreOneShape) {
  const svg::Axis axis = svg::nice_axis(0, 10, "x");
  svg::Plot plot(axis, axis);
  const std::vector<std::uint32_t> steps{1};
  plot.density({3, 1, {4, 4, 0}, 0}, steps);
  EXPECT_THAT(plot.text("t", "d"), testing::HasSubstr("<path class=\"d0\" d=\"M0 0h2v1h-2z\"/>"));
}

TEST(Numbers, HaveFewDigitsAndThousandsSeparators) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(0.07123), "0.0712");
  EXPECT_EQ(number(12345.6), "12,346");
  EXPECT_EQ(number(-1234.5), "-1,234");
  EXPECT_EQ(number(2.13e-13), "2.1e-13");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "n/a");
  EXPECT_EQ(stress(9.349), "9.35");
  EXPECT_EQ(stress(-0.001), "-0.00100");
  EXPECT_EQ(stress(123.44), "123.4");
  EXPECT_EQ(stress(27501), "27,501");
}

TEST(Numbers, ErrorsHaveTwoDigitsAndTheirValueTheSamePlace) {
  EXPECT_EQ(with_error(0.071234, 0.00081), "0.07123 \u00b1 0.00081");
  EXPECT_EQ(with_error(0.071234, 0.000999), "0.0712 \u00b1 0.0010");
  EXPECT_EQ(with_error(12345, 150), "12,345 \u00b1 150");
  EXPECT_EQ(with_error(0.5, 0), "0.5000");
  EXPECT_EQ(with_error(0.5, std::nan("")), "0.5000 \u00b1 n/a");
  EXPECT_EQ(with_error(0.5, 1e-12), "0.5000 \u00b1 1.0e-12");
}

} // namespace frictab
