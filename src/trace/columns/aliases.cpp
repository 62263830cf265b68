// Compares settings of tests with the means of their states.
#include "trace/columns/aliases.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/text.h"
#include "data/options.h"
#include "data/quantity.h"
#include "data/recordings.h"
#include "data/roles.h"
#include "trace/columns/candidates.h"
#include "trace/tuning.h"

namespace frictab::trace {

using data::Column;
using data::Dataset;
using data::Role;

namespace {

// Returns the setting of each test; empty if the column is not constant within tests.
std::vector<double> setting_of(const Column& column, const Dataset& data) {
  const auto [low, high] = std::ranges::minmax_element(column.values);
  const double allowed = column.levels.empty() ? tuning::held_share_of_range * (*high - *low) : 0;
  std::vector<double> values;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const double first = column.values[data.first_row[e]];
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      if (!(std::abs(column.values[i] - first) <= allowed)) return {}; // or not recorded
    values.push_back(first);
  }
  return values;
}

// A column from which the job computes a state acts through that state.
bool may_act(const Column& column, const TraceOptions& options) {
  return data::may_be_searched(column.role) && column.role != Role::state &&
         !data::find_quantity(column.name) && column.name != data::origin_column &&
         column.name != data::interval_column && !contains(options.ignore, column.name);
}

// Test means of a state.
struct State {
  std::string name;
  std::vector<double> means; // per test
  std::vector<double> at;    // the means or their logarithms
  bool in_law = false;
};

// Whether the tests were run at different values: not where their means differ little, or by a
// small part of what each test runs through.
bool differs_between_tests(const Dataset& data, const State& state) {
  const auto [low, high] = std::ranges::minmax_element(state.means);
  const double size = std::max(std::abs(*low), std::abs(*high));
  return *high - *low >
         std::max(tuning::same_value_share_of_mean * size,
                  tuning::apart_share_of_range * usual_range(data.values(state.name), data));
}

std::vector<State> states_of(const Dataset& data, const models::Model& model) {
  models::Conventions unlimited = model.conventions;
  unlimited.shear_limit = false;
  const std::vector<std::string> inputs = models::inputs(*model.law, unlimited);
  std::vector<State> states;
  for (const Column& column : data.columns) {
    const std::string& name = column.name;
    const bool in_law = contains(inputs, name);
    // The flow stress follows from the material.
    if (!names_state(name) || (name == "sigma_f_MPa" && !in_law)) continue;
    State state{name, test_means(data, column.values), {}, in_law};
    if (!differs_between_tests(data, state)) continue;
    const bool log =
        data::find_quantity(name)->log_axis && *std::ranges::min_element(state.means) > 0;
    for (const double mean : state.means)
      state.at.push_back(log ? std::log(mean) : mean);
    states.push_back(std::move(state));
  }
  return states;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values)
    sum += v;
  return sum / static_cast<double>(values.size());
}

double squares_about(const std::vector<double>& values, double middle) {
  double sum = 0;
  for (const double v : values)
    sum += (v - middle) * (v - middle);
  return sum;
}

using Levels = std::map<double, std::vector<double>>; // per level, the values of its tests

Levels by_level(const std::vector<double>& setting, const std::vector<double>& values) {
  Levels levels;
  for (std::size_t e = 0; e < setting.size(); ++e)
    levels[setting[e]].push_back(values[e]);
  return levels;
}

// R^2 corrected for the degrees of freedom of `used` means or lines.
double corrected(double left, double all, std::size_t tests, std::size_t used) {
  if (!(all > 0) || tests <= used) return 0;
  return 1 - left / all * static_cast<double>(tests - 1) / static_cast<double>(tests - used);
}

double explained_by_levels(const std::vector<double>& setting, const std::vector<double>& at) {
  const Levels levels = by_level(setting, at);
  double left = 0;
  for (const auto& [level, values] : levels)
    left += squares_about(values, mean_of(values));
  return corrected(left, squares_about(at, mean_of(at)), at.size(), levels.size());
}

double explained_by_one_line(const std::vector<double>& setting, const std::vector<double>& at) {
  const double x0 = mean_of(setting), y0 = mean_of(at);
  double xy = 0;
  for (std::size_t e = 0; e < at.size(); ++e)
    xy += (setting[e] - x0) * (at[e] - y0);
  const double xx = squares_about(setting, x0), yy = squares_about(at, y0);
  return xx > 0 ? corrected(yy - xy * xy / xx, yy, at.size(), 2) : 0;
}

// R^2 of a straight line in the number or in its logarithm.
double explained_by_line(const std::vector<double>& setting, const std::vector<double>& at) {
  std::vector<double> logarithms;
  for (const double value : setting)
    if (value > 0) logarithms.push_back(std::log(value));
  const double plain = explained_by_one_line(setting, at);
  if (logarithms.size() < setting.size()) return plain;
  return std::max(plain, explained_by_one_line(logarithms, at));
}

// Rounds to two significant digits if that changes less than 1 %, else to three, as rigs are set:
// "800" for 801.3, "1530" for 1532.
std::string figure(double value) {
  if (value == 0) return "0";
  const double two = std::pow(10, std::floor(std::log10(std::abs(value))) - 1);
  const double short_value = two * std::round(value / two);
  const bool near =
      std::abs(short_value - value) < tuning::rounded_share_of_value * std::abs(value);
  return fmt::format("{:g}", near ? short_value : two / 10 * std::round(10 * value / two));
}

std::string values_text(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  const double middle = mean_of(values);
  if (*high - *low <= tuning::same_value_share_of_mean * std::abs(middle)) return figure(middle);
  return figure(*low) + " to " + figure(*high);
}

// "A only at 800, B only at 1500; one test of A at 1500 would"
std::string levels_text(const Column& column, const std::vector<double>& setting,
                        const State& state) {
  constexpr std::size_t shown = 4;
  const Levels levels = by_level(setting, state.means);
  const auto called = [&](double level) {
    if (column.levels.empty()) return fmt::format("{:g}", level);
    const std::string& name = column.levels[static_cast<std::size_t>(level)];
    return name.empty() ? std::string("an empty cell") : name;
  };
  std::vector<std::string> texts;
  auto lowest = levels.begin(), highest = levels.begin();
  for (auto at = levels.begin(); at != levels.end(); ++at) {
    if (texts.size() < shown)
      texts.push_back(called(at->first) + " only at " + values_text(at->second));
    if (mean_of(at->second) < mean_of(lowest->second)) lowest = at;
    if (mean_of(at->second) > mean_of(highest->second)) highest = at;
  }
  if (levels.size() > shown) texts.push_back(fmt::format("{} more", levels.size() - shown));
  return fmt::format("{}; one test of {} at {} would", join(texts, ", "), called(lowest->first),
                     figure(mean_of(highest->second)));
}

std::string line_text(const std::string& column, const std::vector<double>& setting,
                      const State& state) {
  const auto least = std::ranges::min_element(setting);
  const auto most = std::ranges::max_element(setting);
  const double there = state.means[most - setting.begin()];
  return fmt::format("they change together; one test with {} {:g} at {} {} would", column, *least,
                     state.name, figure(there));
}

// Nobody sets a date or a running number.
std::string order_text(const State& state) {
  return fmt::format("they change together; tests at the {} of the first ones would", state.name);
}

// Whether each level of a text was tested in one recording only.
bool names_recordings(const Column& column, const std::vector<double>& setting,
                      const data::Units& units) {
  if (column.levels.empty() || units.count == setting.size()) return false;
  std::map<double, std::size_t> recording;
  for (std::size_t e = 0; e < setting.size(); ++e)
    if (recording.emplace(setting[e], units.of[e]).first->second != units.of[e]) return false;
  return recording.size() > 1;
}

} // namespace

std::vector<Alias> find_aliases(const Dataset& training, const models::Model& model,
                                const TraceOptions& options) {
  std::vector<Alias> aliases;
  const std::size_t tests = training.experiments.size();
  if (tests < tuning::fewest_tests_for_aliases) return aliases;
  const std::vector<State> states = states_of(training, model);
  const data::Units units = data::units_of(training);
  for (const Column& column : training.columns) {
    if (!may_act(column, options)) continue;
    const std::vector<double> setting = setting_of(column, training);
    if (setting.empty()) continue;
    if (names_recordings(column, setting, units))
      aliases.push_back(
          {column.name, "the recording", 1,
           fmt::format("{} cannot be distinguished from the recording: each of its "
                       "levels was tested in one; a second recording of one of them would",
                       column.name)});
    const std::size_t levels = by_level(setting, setting).size();
    const bool few = 2 * levels <= tests;
    if (levels < 2 || (!few && !column.levels.empty())) continue;
    for (const State& state : states) {
      const double by_levels = few ? explained_by_levels(setting, state.at) : 0;
      const double by_line = column.levels.empty() ? explained_by_line(setting, state.at) : 0;
      if (std::max(by_levels, by_line) <=
          (state.in_law ? tuning::aliased_share_of_variance : tuning::same_share_of_variance))
        continue;
      const std::string how = data::is_order(column) ? order_text(state)
                              : by_levels > tuning::aliased_share_of_variance
                                  ? levels_text(column, setting, state)
                                  : line_text(column.name, setting, state);
      aliases.push_back(
          {column.name, state.name, std::max(by_levels, by_line),
           fmt::format("{} cannot be distinguished from {}: {}", column.name, state.name, how)});
    }
  }
  return aliases;
}

} // namespace frictab::trace
