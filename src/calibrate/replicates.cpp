// Groups experiments by profiles of their inputs.
#include "calibrate/replicates.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <string>

#include "data/clear_levels.h"
#include "data/middle.h"
#include "data/options.h"
#include "data/quantity.h"
#include "data/roles.h"

namespace frictab::calibrate {

namespace {

constexpr std::size_t parts = 10;

using Profile = std::vector<double>; // inputs x parts, in units of replicate_tolerance

// An input in its own coordinate, and how far apart two tests at one setting may be in it.
struct Input {
  std::vector<double> x; // empty if constant
  double tolerance = 0;
  bool differs = true; // between tests, or within them beyond its scatter
};

// Standard deviation of a row, by the scatter of rows about their neighbours; the median does not
// see the steps of a course.
double noise_of_row(const data::Dataset& data, const std::vector<double>& x) {
  constexpr double of_median = 0.6745, of_difference = 6;
  std::vector<double> sizes;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e] + 2; i < data.first_row[e + 1]; ++i)
      sizes.push_back(std::abs(x[i] - 2 * x[i - 1] + x[i - 2]));
  return sizes.empty() ? 0
                       : data::median_of(std::move(sizes)) / of_median / std::sqrt(of_difference);
}

// Tests at one setting differ by the noise of their readings, and by how exactly the rig is set: to
// a fiftieth of a pressure or speed, one kelvin, or the width of a level that is clearly apart from
// the next one.
Input input_of(const data::Quantity& quantity, const data::Dataset& data) {
  constexpr double set_again = 0.02, kelvin = 1, noises = 3, most_noise = 0.1, most_held = 15;
  const std::span<const double> values = data.values(quantity.name);
  Input in{{values.begin(), values.end()}, 0, true};
  if (in.x.empty()) return {};
  const bool log = quantity.log_axis && *std::ranges::min_element(in.x) > 0;
  if (log)
    for (double& value : in.x)
      value = std::log(value);
  const auto [least, most] = std::ranges::minmax_element(in.x);
  const double range = *most - *least;
  if (!(range > 0)) return {};
  std::vector<double> means;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    double sum = 0;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      sum += data.row_weight(i) * in.x[i];
    means.push_back(sum / static_cast<double>(data.source_rows(e)));
  }
  const double same = quantity.name == "s_mm"           ? set_again * range
                      : quantity.name == "psi"          ? 0
                      : quantity.name.starts_with("T_") ? kelvin
                      : log                             ? set_again
                                                        : 0;
  const data::ClearLevels levels = data::clear_levels(means, same);
  const double of_row = noise_of_row(data, in.x),
               rows = static_cast<double>(in.x.size()) /
                      static_cast<double>(data.experiments.size() * parts);
  // A state that is held scatters; one with a course is an input, if the same in all tests.
  in.differs = quantity.name == "s_mm" || levels.count != 1 || range > most_held * of_row;
  const double noise = noises * std::numbers::sqrt2 * of_row / std::sqrt(std::max(rows, 1.0));
  in.tolerance = std::max({replicate_tolerance * range, same, levels.width}) +
                 (in.differs ? std::min(noise, most_noise * range) : noise);
  return in;
}

void append_means(Profile& profile, std::span<const double> x, double scale) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t begin = std::min(k * n / parts, n - 1);
    const std::size_t end = std::max((k + 1) * n / parts, begin + 1);
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i)
      sum += x[i];
    profile.push_back(scale * sum / static_cast<double>(end - begin));
  }
}

// ---- recorded columns ----

// A column of few levels that changes within tests (a direction) is compared by the share of rows
// at each level; a column of more levels is a reading.
constexpr std::size_t few_levels = 12;
constexpr double same_share = 0.1;

// Values of a column by test: two tests agree if no two numbers at one position differ by more than
// `tolerance`. Empty if the column does not distinguish tests.
struct Setting {
  std::vector<Profile> of_tests;
  double tolerance = 0;
};

bool may_be_set(const data::Column& column) {
  return (data::may_be_cause(column.role) || column.why.starts_with(data::many_texts)) &&
         !data::find_quantity(column.name) && column.name != data::origin_column;
}

// Step in which a column is written: 1, 0.1, ... 1e-6; 0 for finer ones.
double written_step(std::span<const double> values) {
  for (double step = 1; step > 5e-7; step /= 10)
    if (std::ranges::all_of(values, [&](double v) {
          return std::abs(v / step - std::round(v / step)) <
                 1e-6 * std::max(1.0, std::abs(v / step));
        }))
      return step;
  return 0;
}

std::string without_digits(const std::string& text) {
  std::string stem;
  for (const char c : text)
    if (!std::isdigit(static_cast<unsigned char>(c)))
      stem += c;
    else if (stem.empty() || stem.back() != '#')
      stem += '#';
  return stem;
}

// Whether a column numbers or names the tests, without a repeated value: 1, 2, 3 ...; S01, S02 ...;
// dates.
bool counts_tests(const data::Column& column, const std::vector<double>& values,
                  const std::set<double>& levels) {
  if (levels.size() < values.size() || column.role == data::Role::setting ||
      column.role == data::Role::label)
    return false;
  if (column.levels.empty())
    return std::ranges::all_of(values, [](double v) { return v >= 1 && v == std::round(v); }) &&
           *levels.rbegin() - *levels.begin() < 2 * static_cast<double>(levels.size());
  const std::string stem = without_digits(column.levels[static_cast<std::size_t>(values.front())]);
  return stem.find('#') != stem.npos && std::ranges::all_of(values, [&](double v) {
           return without_digits(column.levels[static_cast<std::size_t>(v)]) == stem;
         });
}

// Settings with one value in each test. Levels that tests share are set: they are equal or differ.
// A reading with its own value in each test (a humidity) agrees within the step it is written in,
// or 1 % of its span.
Setting set_by_test(const data::Column& column, const std::vector<double>& values) {
  const std::set<double> levels(values.begin(), values.end());
  if (levels.size() < 2 || counts_tests(column, values, levels)) return {};
  Setting setting;
  for (const double value : values)
    setting.of_tests.push_back({value});
  const double span = *levels.rbegin() - *levels.begin();
  const double share = replicate_tolerance * span;
  if (column.levels.empty()) // slightly wider, for rounding
    setting.tolerance = 2 * levels.size() <= values.size()
                            ? (1 - 1e-9) * share
                            : (1 + 1e-9) * std::max(share, written_step(values));
  return setting;
}

// A column that hardly moves within a test (a humidity) agrees within what it usually moves by.
Setting means_in_tests(const data::Column& column, const data::Dataset& data) {
  Setting setting;
  std::vector<double> means, ranges;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::span<const double> test = data.of_test(column.values, e);
    const auto [low, high] = std::ranges::minmax_element(test);
    ranges.push_back(*high - *low);
    means.push_back(std::accumulate(test.begin(), test.end(), 0.0) /
                    static_cast<double>(test.size()));
    setting.of_tests.push_back({means.back()});
  }
  const auto [low, high] = std::ranges::minmax_element(means);
  setting.tolerance = std::max(replicate_tolerance * (*high - *low), data::median_of(ranges));
  return setting;
}

Setting set_within_tests(const data::Column& column, const data::Dataset& data) {
  const std::set<double> levels(column.values.begin(), column.values.end());
  if (levels.size() > few_levels) return means_in_tests(column, data);
  Setting setting;
  setting.tolerance = same_share;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    Profile shares;
    for (const double level : levels) {
      double rows = 0, all = 0;
      for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
        all += data.row_weight(i);
        if (column.values[i] == level) rows += data.row_weight(i);
      }
      shares.push_back(rows / all);
    }
    setting.of_tests.push_back(std::move(shares));
  }
  return setting;
}

Setting setting_of(const data::Column& column, const data::Dataset& data) {
  if (!may_be_set(column) ||
      std::ranges::any_of(column.values, [](double v) { return std::isnan(v); }))
    return {};
  std::vector<double> values;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::span<const double> test = data.of_test(column.values, e);
    if (std::ranges::any_of(test, [&](double v) { return v != test.front(); }))
      return set_within_tests(column, data);
    values.push_back(test.front());
  }
  return set_by_test(column, values);
}

bool alike(const Profile& a, const Profile& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= replicate_tolerance)) return false;
  return true;
}

} // namespace

std::vector<std::vector<std::size_t>> replicate_groups(const data::Dataset& data) {
  std::vector<Profile> profiles(data.experiments.size());
  std::size_t inputs = 0;
  for (const data::Quantity& quantity : data::quantities()) {
    if (!data.has(quantity.name) || !(quantity.state || quantity.name == "T_tool_C")) continue;
    const Input in = input_of(quantity, data);
    if (in.x.empty()) continue;
    inputs += in.differs;
    for (std::size_t e = 0; e < profiles.size(); ++e)
      append_means(profiles[e], data.of_test(in.x, e), replicate_tolerance / in.tolerance);
  }
  for (const data::Column& column : data.columns) {
    const Setting setting = setting_of(column, data);
    if (setting.of_tests.empty()) continue;
    ++inputs;
    // With a tolerance of 0 any difference separates tests.
    const double scale = replicate_tolerance / std::max(setting.tolerance, 1e-12);
    for (std::size_t e = 0; e < profiles.size(); ++e)
      for (const double value : setting.of_tests[e])
        profiles[e].push_back(value * scale);
  }
  if (inputs < 2) return {};
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t e = 0; e < profiles.size(); ++e) {
    const auto group = std::ranges::find_if(groups, [&](const auto& members) {
      const bool kin = std::ranges::any_of(members, [&](std::size_t other) {
        return !data.recording.empty() && data.recording[other] == data.recording[e];
      });
      return !kin && alike(profiles[members.front()], profiles[e]);
    });
    if (group == groups.end())
      groups.push_back({e});
    else
      group->push_back(e);
  }
  std::erase_if(groups, [](const auto& members) { return members.size() < 2; });
  return groups;
}

} // namespace frictab::calibrate
