// Histories along an experiment, against values by hand.
#include <cmath>

#include <gtest/gtest.h>

#include "data/derived.h"

namespace frictab::derived_test {

using data::Dataset;

namespace {

// Two experiments of the same rows.
Dataset twice(const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  Dataset data;
  for (const auto& [name, values] : columns) {
    data.columns.push_back({name, "", values, {}});
    for (const double value : values)
      data.columns.back().values.push_back(value);
  }
  const std::size_t rows = columns[0].second.size();
  data.first_row = {0, rows, 2 * rows};
  data.experiments = {"one", "two"};
  return data;
}

// Of the first experiment; the second one starts anew.
std::vector<double> derived(const char* name, const Dataset& data,
                            const std::vector<double>& tau = {}) {
  const std::vector<double> all = data::derive(*data::find_derived(name), data, tau);
  const auto half = static_cast<long>(all.size() / 2);
  EXPECT_EQ(std::vector<double>(all.begin() + half, all.end()),
            std::vector<double>(all.begin(), all.begin() + half));
  return {all.begin(), all.begin() + half};
}

using Values = std::vector<double>;

const Dataset loaded =
    twice({{"sigma_n_MPa", {0, 400, 1000, 980, 500, 960, 1200}}, {"s_mm", {1, 2, 4, 5, 7, 8, 9}}});

TEST(Derived, LoadRatioIsOneWhileLoading) {
  EXPECT_EQ(derived("load_ratio", loaded), (Values{1, 1, 1, 0.98, 0.5, 0.96, 1}));
}

TEST(Derived, LoadDirectionTurnsWhereTheLoadIsFivePercentFromItsLastExtreme) {
  EXPECT_EQ(derived("load_direction", loaded), (Values{1, 1, 1, 1, 0, 1, 1}));
  const Dataset waves =
      twice({{"sigma_n_MPa", {800, 700, 600, 620, 640, 690, 0, 680, 700, 650, 0, 649, 690}}});
  EXPECT_EQ(derived("load_direction", waves), (Values{1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 1}));
}

TEST(Derived, SlipSincePeakCountsBelow95PercentOfIt) {
  EXPECT_EQ(derived("slip_since_peak", loaded), (Values{0, 0, 0, 0, 2, 0, 0}));
}

TEST(Derived, TemperatureRiseAndLagAreAboveStartAndMean) {
  const Dataset data = twice({{"T_contact_C", {20, 40, 90, 50}}, {"T_tool_C", {20, 20, 30, 30}}});
  EXPECT_EQ(derived("temperature_rise", data), (Values{0, 20, 70, 30}));
  EXPECT_EQ(derived("temperature_lag", data), (Values{0, 10, 40, 0}));
  EXPECT_EQ(derived("temperature_above_tool", data), (Values{0, 20, 60, 20}));
}

TEST(Derived, ExpansionWorkIsAnIntegralOverTheSlip) {
  const Dataset data =
      twice({{"psi", {1, 2, 3}}, {"sigma_n_MPa", {100, 100, 200}}, {"s_mm", {0, 1, 3}}});
  EXPECT_EQ(derived("expansion_work", data), (Values{0, 150, 950}));
}

TEST(Derived, FlashHeatingGrowsWithTheRootOfTheSpeed) {
  const Dataset data = twice({{"v_rel_mm_s", {0, 4, 9}}});
  EXPECT_EQ(derived("flash_heating", data, {50, 50, 100, 50, 50, 100}), (Values{0, 100, 300}));
}

TEST(Derived, QuantitiesWithoutAContinuationAreThoseOfAnExperiment) {
  for (const data::DerivedQuantity& quantity : data::derived_quantities()) {
    const bool none = quantity.continuation.rule == data::Continuation::none;
    const bool expected = quantity.name == "test_order" || quantity.name == "expansion_work" ||
                          quantity.name == "temperature_above_tool";
    EXPECT_EQ(none, expected) << quantity.name;
  }
}

} // namespace
} // namespace frictab::derived_test
