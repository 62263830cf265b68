// Units: every one converts within its dimension, and to none outside it.
#include <gtest/gtest.h>

#include "core/units.h"

namespace frictab::units_test {
namespace {

TEST(Units, ConvertsToCanonicalUnits) {
  const auto value = [](double x, const char* from, const char* to) {
    return (*convert(from, to))(x);
  };
  EXPECT_DOUBLE_EQ(value(2e6, "Pa", "MPa"), 2);
  EXPECT_DOUBLE_EQ(value(2, "GPa", "MPa"), 2000);
  EXPECT_DOUBLE_EQ(value(3, "N/mm2", "MPa"), 3);
  EXPECT_DOUBLE_EQ(value(0.15, "m/s", "mm/s"), 150);
  EXPECT_DOUBLE_EQ(value(6, "m/min", "mm/s"), 100);
  EXPECT_DOUBLE_EQ(value(250, "micron", "mm"), 0.25);
  EXPECT_DOUBLE_EQ(value(250, "microns", "mm"), 0.25);
  EXPECT_DOUBLE_EQ(value(250, "\u00b5m", "mm"), 0.25);
  EXPECT_DOUBLE_EQ(value(2, "min", "s"), 120);
  EXPECT_DOUBLE_EQ(value(1.5, "h", "s"), 5400);
  EXPECT_DOUBLE_EQ(value(3, "kN", "N"), 3000);
  EXPECT_EQ(value(300, "K", "degC"), 300 - 273.15); // 26.85 less the cancellation
  EXPECT_DOUBLE_EQ(value(212, "degF", "degC"), 100);
  EXPECT_DOUBLE_EQ(value(13, "%", "1"), 0.13);
  EXPECT_DOUBLE_EQ(value(20, "degC", "K"), 293.15);
}

TEST(Units, ReadsThemAsRigsWriteThem) {
  const auto factor = [](const char* from, const char* to) { return (*convert(from, to)).factor; };
  EXPECT_DOUBLE_EQ(factor("Nm", "N m"), 1);
  EXPECT_DOUBLE_EQ(factor("kNm", "N m"), 1000);
  EXPECT_DOUBLE_EQ(factor("Ncm", "N m"), 0.01);
  EXPECT_DOUBLE_EQ(factor("mNm", "N m"), 1e-3);
  EXPECT_DOUBLE_EQ(factor("Nmm", "N m"), 1e-3);
  EXPECT_DOUBLE_EQ(factor("kp", "N"), 9.80665);
  EXPECT_DOUBLE_EQ(factor("kp/mm²", "MPa"), 9.80665);
  EXPECT_DOUBLE_EQ(factor("kpm", "N m"), 9.80665);
  EXPECT_NEAR(factor("ksi", "MPa"), 6.894757, 1e-6);
  EXPECT_DOUBLE_EQ(factor("kgcm", "N m"), 0.0980665);
  EXPECT_DOUBLE_EQ(factor("lbs", "lbf"), 1);
  EXPECT_DOUBLE_EQ(factor("Sek", "s"), 1);
  for (const char* const celsius : {"C", "deg C", "ºC", "°C"})
    EXPECT_DOUBLE_EQ((*convert(celsius, "K"))(20), 293.15) << celsius;
  EXPECT_DOUBLE_EQ((*convert("F", "degC"))(212), 100);
  EXPECT_FALSE(convert("N", "N m"));
  EXPECT_FALSE(convert("Nkm", "N m"));
}

TEST(Units, RefusesUnknownUnitsAndOtherDimensions) {
  EXPECT_FALSE(convert("kN", "MPa"));
  EXPECT_FALSE(convert("mpa", "MPa"));
  EXPECT_FALSE(convert("", "MPa"));
}

TEST(Units, ThereAndBackIsTheSameWithinRounding) {
  for (const char* base : {"MPa", "mm/s", "mm", "s", "N", "degC", "1"})
    for (const std::string& unit : units_like(base)) {
      ASSERT_TRUE(convert(unit, base)) << unit;
      EXPECT_NEAR((*convert(base, unit))((*convert(unit, base))(12.5)), 12.5, 1e-12) << unit;
    }
}

} // namespace
} // namespace frictab::units_test
