// Ranges and means of each experiment.
#include "data/overview.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/no_value.h"
#include "data/condense.h"
#include "data/middle.h"
#include "data/quantity.h"

namespace frictab::data {

namespace {

std::pair<double, double> span_of(std::span<const double> values) {
  std::pair<double, double> span{no_value, no_value};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (!(span.first <= value)) span.first = value;
    if (!(span.second >= value)) span.second = value;
  }
  return span;
}

double mean_of_ratio(const RatioSum& ratio) {
  return ratio.rows > 0 ? ratio.sum / ratio.rows : no_value;
}

// Mean over the rows, or blocks of rows, with at least a twentieth of the test's load: with hardly
// any, a ratio is that of two noises. `whole`: that over all rows, if no row lies below.
double mean_coefficient(const Dataset& data, std::size_t e, const RatioSum& whole) {
  constexpr double least_share = 0.05, high = 0.9;
  const std::size_t begin = data.first_row[e], rows = data.first_row[e + 1] - begin;
  const auto tau = data.values("tau_R_MPa").subspan(begin, rows),
             pressure = data.values("sigma_n_MPa").subspan(begin, rows);
  const double least = least_share * quantile_of({pressure.begin(), pressure.end()}, high);
  RatioSum pressed;
  bool all = true;
  for (std::size_t i = 0; i < rows; ++i) {
    const bool is_pressed = pressure[i] >= least && pressure[i] > 0;
    all = all && (is_pressed || !(pressure[i] > 0));
    if (!is_pressed) continue;
    pressed.sum += data.row_weight(begin + i) * tau[i] / pressure[i];
    pressed.rows += data.row_weight(begin + i);
  }
  return mean_of_ratio(all ? whole : pressed);
}

// Overview from the stored summary of its source rows.
TestOverview overview_of_source(const Dataset& data, std::size_t e) {
  const RowsOfExperiment& rows = data.condensed->experiments[e];
  TestOverview test{
      data.experiments[e], rows.rows, {}, mean_coefficient(data, e, rows.over_pressure), {}};
  for (const Quantity& quantity : quantities())
    if (data.has(quantity.name))
      test.spans.emplace_back(quantity.name, rows.spans.at(quantity.name));
  if (data.has("sigma_f_MPa")) test.mean_of_k = std::numbers::sqrt3 * mean_of_ratio(rows.over_flow);
  return test;
}

} // namespace

std::vector<TestOverview> overview(const Dataset& data) {
  std::vector<TestOverview> tests;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    if (data.condensed) {
      tests.push_back(overview_of_source(data, e));
      continue;
    }
    const std::size_t first = data.first_row[e], rows = data.first_row[e + 1] - first;
    const auto of = [&](const std::string& name) { return data.values(name).subspan(first, rows); };
    TestOverview test{data.experiments[e], rows, {}, no_value, {}};
    for (const Quantity& quantity : quantities())
      if (data.has(quantity.name))
        test.spans.emplace_back(quantity.name, span_of(of(quantity.name)));
    test.mean_mu = mean_coefficient(data, e, ratio_sum(of("tau_R_MPa"), of("sigma_n_MPa")));
    if (data.has("sigma_f_MPa"))
      test.mean_of_k =
          std::numbers::sqrt3 * mean_of_ratio(ratio_sum(of("tau_R_MPa"), of("sigma_f_MPa")));
    tests.push_back(std::move(test));
  }
  return tests;
}

} // namespace frictab::data
