// Finds recordings by name, by clock, and by the course of friction over a running number.
#include "data/recordings.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "data/middle.h"
#include "data/name_words.h"
#include "data/quantity.h"

namespace frictab::data {

namespace {

using Tests = std::vector<std::size_t>;
using TestsByName = std::map<std::string, Tests>; // by the recording's name

// Set by hand; their error rate has not been measured.
constexpr double few_steps = 0.05;    // of a test's duration: a gap between intervals
constexpr double mostly = 0.9;        // share of tests that continue the one before
constexpr double same_setting = 0.05; // relative to its mean: a setting that was not changed
constexpr std::size_t least_to_ask = 6;

// ---- order ----

void reorder(std::vector<double>& values, const Dataset& data, const Tests& order) {
  if (values.empty()) return;
  std::vector<double> sorted;
  sorted.reserve(values.size());
  for (const std::size_t e : order)
    sorted.insert(sorted.end(), values.begin() + static_cast<long>(data.first_row[e]),
                  values.begin() + static_cast<long>(data.first_row[e + 1]));
  values = std::move(sorted);
}

template <class T> void reorder(std::vector<T>& of_tests, const Tests& order) {
  if (of_tests.empty()) return;
  std::vector<T> sorted;
  for (const std::size_t e : order)
    sorted.push_back(std::move(of_tests[e]));
  of_tests = std::move(sorted);
}

// Reorders one column at a time, because a campaign may fill half the memory.
void sort_tests(Dataset& data) {
  Tests order(data.experiments.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](std::size_t a, std::size_t b) {
    return natural_less(data.experiments[a], data.experiments[b]);
  };
  if (std::is_sorted(order.begin(), order.end(), before)) return;
  std::sort(order.begin(), order.end(), before);
  for (Column& column : data.columns)
    reorder(column.values, data, order);
  reorder(data.oracle_MPa, data, order);
  if (data.condensed) {
    reorder(data.condensed->rows, data, order);
    reorder(data.condensed->within_MPa2, data, order);
    for (Column& history : data.condensed->histories)
      reorder(history.values, data, order);
    reorder(data.condensed->experiments, order);
  }
  std::vector<std::size_t> first{0};
  for (const std::size_t e : order)
    first.push_back(first.back() + data.first_row[e + 1] - data.first_row[e]);
  data.first_row = std::move(first);
  reorder(data.experiments, order);
  reorder(data.filed, order);
  reorder(data.file_of, order);
}

// ---- clocks ----

class Clock {
public:
  explicit Clock(const Dataset& data) : data_(data), time_(data.find("time_s")) {}

  double start(std::size_t test) const { return time_->values[data_.first_row[test]]; }
  double end(std::size_t test) const { return time_->values[data_.first_row[test + 1] - 1]; }

  Tests in_time(Tests tests) const {
    if (time_)
      std::stable_sort(tests.begin(), tests.end(),
                       [&](std::size_t a, std::size_t b) { return start(a) < start(b); });
    return tests;
  }

  // Median gap between consecutive tests beyond the usual time step of a row, in durations of a
  // test; nullopt if the tests do not follow each other, for example if each starts at its own
  // zero.
  std::optional<double> gap(const Tests& tests) const {
    if (!time_ || tests.size() < 2) return {};
    std::vector<double> gaps, durations, steps;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      durations.push_back(end(tests[i]) - start(tests[i]));
      const std::size_t rows = data_.first_row[tests[i] + 1] - data_.first_row[tests[i]];
      steps.push_back(durations.back() / static_cast<double>(std::max<std::size_t>(rows - 1, 1)));
      if (i > 0) gaps.push_back(start(tests[i]) - end(tests[i - 1]));
    }
    const double duration = upper_median(durations);
    if (!(duration > 0)) return {};
    const auto follow = std::count_if(gaps.begin(), gaps.end(),
                                      [&](double g) { return g > -few_steps * duration; });
    if (static_cast<double>(follow) < mostly * static_cast<double>(gaps.size())) return {};
    return std::max(upper_median(gaps) - upper_median(steps), 0.0) / duration;
  }

private:
  const Dataset& data_;
  const Column* time_;
};

// ---- names ----

struct Numbered {
  std::string stem; // "cycle_#" of cycle_001
  double number = 0;
};

std::optional<Numbered> last_number(const std::string& name) {
  constexpr const char* digits = "0123456789";
  const std::size_t last = name.find_last_of(digits);
  if (last == name.npos) return {};
  const std::size_t before = name.find_last_not_of(digits, last);
  const std::size_t first = before == name.npos ? 0 : before + 1;
  return Numbered{name.substr(0, first) + "#" + name.substr(last + 1),
                  std::strtod(name.substr(first, last + 1 - first).c_str(), nullptr)};
}

// Tests by stem, in the order of their names. `running`: only stems with a running number, in which
// more than 70 % of the steps are 1; levels (5, 50, 500) are excluded.
TestsByName numbered(const Dataset& data, const std::vector<char>& taken, bool running) {
  std::map<std::string, std::vector<double>> numbers;
  TestsByName groups;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    if (const auto name = last_number(data.experiments[e]); name && !taken[e]) {
      groups[name->stem].push_back(e);
      numbers[name->stem].push_back(name->number);
    }
  if (!running) return groups;
  std::erase_if(groups, [&](const auto& group) {
    const std::vector<double>& n = numbers[group.first];
    std::size_t ones = 0;
    for (std::size_t i = 1; i < n.size(); ++i)
      ones += n[i] == n[i - 1] + 1;
    return n.size() < 3 || 10 * ones < 7 * (n.size() - 1);
  });
  return groups;
}

// ---- the course of friction ----

double mean_in_test(const Dataset& data, const Column& column, std::size_t test) {
  const auto from = column.values.begin();
  const std::size_t first = data.first_row[test], end = data.first_row[test + 1];
  return std::accumulate(from + static_cast<long>(first), from + static_cast<long>(end), 0.0) /
         static_cast<double>(end - first);
}

// True if a state differs between these tests, or a recorded column other than their number and
// readings that differ in each test.
bool anything_set_differs(const Dataset& data, const Tests& tests) {
  for (const Column& column : data.columns) {
    const Quantity* quantity = find_quantity(column.name);
    if (quantity ? !quantity->state : is_measured(column.name)) continue;
    std::vector<double> means;
    for (const std::size_t e : tests)
      means.push_back(mean_in_test(data, column, e));
    std::vector<double> levels = means;
    if (std::any_of(levels.begin(), levels.end(), [](double v) { return std::isnan(v); })) continue;
    std::sort(levels.begin(), levels.end());
    const double scale = std::max(std::abs(levels.front()), std::abs(levels.back()));
    if (quantity && levels.back() - levels.front() > same_setting * scale) return true;
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    if (!quantity && levels.size() > 1 && 2 * levels.size() <= tests.size()) return true;
  }
  return false;
}

// Von Neumann's ratio of the tests' coefficients in this order: 2 for independent tests, towards 0
// for a smooth course. smooth_below() is its 1 % quantile for independent tests, in normal
// approximation.
double smoothness(const Dataset& data, const Tests& tests) {
  const Column &tau = *data.find("tau_R_MPa"), &sigma = *data.find("sigma_n_MPa");
  std::vector<double> mu;
  for (const std::size_t e : tests)
    mu.push_back(mean_in_test(data, tau, e) / mean_in_test(data, sigma, e));
  const auto n = static_cast<double>(mu.size());
  const double mean = std::accumulate(mu.begin(), mu.end(), 0.0) / n;
  double squares = 0, steps = 0;
  for (std::size_t i = 0; i < mu.size(); ++i) {
    squares += (mu[i] - mean) * (mu[i] - mean) / n;
    if (i > 0) steps += (mu[i] - mu[i - 1]) * (mu[i] - mu[i - 1]) / (n - 1);
  }
  return squares > 0 ? steps / squares : 2;
}
double smooth_below(std::size_t tests) {
  return 2 * (1 - 2.33 / std::sqrt(static_cast<double>(tests)));
}

// ---- recordings ----

// Numbers may count the repeats of each setting instead.
bool names_tests(const Column& column) {
  const bool has_letters =
      !column.levels.empty() &&
      std::all_of(column.levels.begin(), column.levels.end(), [](const std::string& text) {
        return std::any_of(text.begin(), text.end(),
                           [](unsigned char c) { return std::isalpha(c); });
      });
  return has_letters &&
         has_match("^(test|versuch|experiment|specimen)_(id|no|nr|number|nummer|name)$",
                   plain_name(column.name));
}

class RecordingFinder {
public:
  RecordingFinder(Dataset& all, const ReadRequest& options)
      : all_(all), options_(options), clock_(all), taken_(all.experiments.size(), 0) {}

  void find() {
    if (options_.recording.empty())
      infer();
    else if (options_.recording != "none")
      as_said();
    std::erase_if(groups_, [](const auto& group) { return group.second.empty(); });
    const bool together = std::any_of(groups_.begin(), groups_.end(),
                                      [](const auto& group) { return group.second.size() > 1; });
    if (together) add();
  }

private:
  void take(const std::string& name, const Tests& tests, const std::string& why) {
    Tests& group = groups_[name];
    group.insert(group.end(), tests.begin(), tests.end());
    for (const std::size_t e : tests)
      taken_[e] = 1;
    if (std::find(why_.begin(), why_.end(), why) == why_.end()) why_.push_back(why);
  }

  // Tests by the value or level of a column; nullopt if the column varies within a test.
  std::optional<TestsByName> by_column(const Column& column) const {
    TestsByName groups;
    for (std::size_t e = 0; e < all_.experiments.size(); ++e) {
      const auto from = column.values.begin() + static_cast<long>(all_.first_row[e]);
      const auto end = column.values.begin() + static_cast<long>(all_.first_row[e + 1]);
      if (std::any_of(from, end, [&](double v) { return v != *from; })) return {};
      groups[column.levels.empty() ? shortest(*from)
                                   : column.levels[static_cast<std::size_t>(*from)]]
          .push_back(e);
    }
    return groups;
  }

  TestsByName by_file() const {
    TestsByName groups;
    for (std::size_t e = 0; e < all_.experiments.size(); ++e)
      groups[all_.filed[e].file].push_back(e);
    return groups;
  }

  void as_said() {
    const std::string& said = options_.recording;
    TestsByName groups;
    if (said == "file" || said == "name") {
      groups = said == "file" ? by_file() : numbered(all_, taken_, false);
    } else {
      const Column* column = all_.find(said);
      if (!column)
        throw InputError(options_.place,
                         fmt::format("there is no column '{}' (data.recording)", said),
                         "\"none\", \"file\", \"name\", or a column that names the recording of "
                         "each test; " +
                             suggest(said, names()));
      const auto found = by_column(*column);
      if (!found)
        throw InputError(options_.place,
                         fmt::format("{} is not the same in all rows of a test: it names no "
                                     "recording (data.recording)",
                                     said),
                         "every test is an interval of one recording");
      groups = *found;
    }
    for (const auto& [name, tests] : groups)
      take(name, tests, fmt::format("data.recording = \"{}\"", said));
    for (std::size_t e = 0; e < taken_.size(); ++e)
      if (!taken_[e]) take(all_.experiments[e], {e}, why_.empty() ? "" : why_.front());
  }

  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Column& column : all_.columns)
      names.push_back(column.name);
    return names;
  }

  void infer() {
    if (const Column* own = all_.find(recording_column))
      if (const auto groups = by_column(*own)) {
        for (const auto& [name, tests] : *groups)
          take(name, tests, "by the column recording");
        return;
      }
    for (const Column& column : all_.columns)
      if (names_tests(column)) by_their_name(column);
    for (const auto& [file, tests] : by_file())
      if (tests.size() > 1 && !taken_[tests.front()] && options_.experiment != by_pauses)
        one_file(file, tests);
    for (const auto& [stem, tests] : numbered(all_, taken_, true))
      several_files(stem, tests);
    if (!groups_.empty())
      for (std::size_t e = 0; e < taken_.size(); ++e)
        if (!taken_[e]) groups_[all_.experiments[e]].push_back(e);
  }

  // Files that hold one name of a test or specimen are parts of it.
  void by_their_name(const Column& column) {
    const auto groups = by_column(column);
    if (!groups || groups->size() < 2 || groups->size() == all_.experiments.size()) return;
    for (const auto& [name, tests] : *groups)
      if (!name.empty() && !taken_[tests.front()])
        take(name, tests, fmt::format("by the column '{}'", column.name));
  }

  void one_file(const std::string& file, const Tests& tests) {
    if (all_.filed[tests.front()].interval)
      take(file, tests, "intervals of one file");
    else if (const auto gap = clock_.gap(clock_.in_time(tests)); gap && *gap < 1)
      take(file, tests, "the clock of the file goes on from test to test");
  }

  void several_files(const std::string& stem, const Tests& tests) {
    const std::optional<double> gap = clock_.gap(tests);
    if (gap && *gap < few_steps)
      take(stem, tests, "their clock goes on from one number to the next");
    else if (gap && *gap < 1)
      ask(tests, fmt::format("their clock goes on from one number to the next, with gaps of {:.2g} "
                             "of a test",
                             *gap));
    else if (options_.measured && tests.size() >= least_to_ask &&
             !anything_set_differs(all_, tests))
      if (const double ratio = smoothness(all_, tests); ratio < smooth_below(tests.size()))
        ask(tests,
            fmt::format("friction follows their number smoothly (von Neumann's ratio {:.2f}, "
                        "independent tests have 2) and nothing that was set differs",
                        ratio));
  }

  void ask(const Tests& tests, const std::string& why) {
    all_.notes.push_back(fmt::format(
        "{} to {}: are these {} tests intervals of one recording? {}. data.recording = \"name\" "
        "says that they are, \"none\" that each is a test of its own, as it is taken now",
        all_.experiments[tests.front()], all_.experiments[tests.back()], tests.size(), why));
  }

  void add() {
    std::vector<double> number(all_.experiments.size()), level(all_.experiments.size());
    std::vector<std::string> levels;
    std::size_t most = 0;
    for (auto& [name, tests] : groups_) {
      std::sort(tests.begin(), tests.end());
      if (const Tests in_time = clock_.in_time(tests); clock_.gap(in_time)) tests = in_time;
      for (std::size_t i = 0; i < tests.size(); ++i) {
        number[tests[i]] = static_cast<double>(i + 1);
        level[tests[i]] = static_cast<double>(levels.size());
      }
      levels.push_back(name);
      most = std::max(most, tests.size());
    }
    add_column(interval_column, number, {}, Role::setting, "the test's number in its recording");
    add_column(recording_column, level, levels, Role::test, "which tests are of one recording");
    all_.recording.assign(level.begin(), level.end());
    tell(most);
  }

  void add_column(const char* name, const std::vector<double>& of_tests,
                  std::vector<std::string> levels, Role role, const char* why) {
    std::erase_if(all_.columns, [&](const Column& column) {
      return column.name == name && name == std::string(recording_column);
    });
    if (all_.has(name)) {
      all_.notes.push_back(fmt::format("{} is the files' own column", name));
      return;
    }
    Column column{name, "", std::vector<double>(all_.rows()), std::move(levels), role, why};
    for (std::size_t e = 0; e < of_tests.size(); ++e)
      std::fill(column.values.begin() + static_cast<long>(all_.first_row[e]),
                column.values.begin() + static_cast<long>(all_.first_row[e + 1]), of_tests[e]);
    all_.columns.push_back(std::move(column));
  }

  void tell(std::size_t most) {
    std::string text =
        fmt::format("{} tests are intervals of {} recording{} ({}), up to {} of one: columns "
                    "interval and recording; ",
                    all_.experiments.size(), groups_.size(), groups_.size() == 1 ? "" : "s",
                    join(why_, "; "), most);
    text += groups_.size() > 1
                ? "those of one recording are held out and left out together, and are not repeats "
                  "of each other"
                : "with one recording alone each interval is held out and left out as a test of "
                  "its own, and how another recording would differ is not known";
    if (options_.recording.empty()) text += "; data.recording = \"none\" makes them other tests";
    all_.notes.push_back(std::move(text));
  }

  Dataset& all_;
  const ReadRequest& options_;
  const Clock clock_;
  std::vector<char> taken_;
  TestsByName groups_;
  std::vector<std::string> why_;
};

} // namespace

void find_recordings(Dataset& all, const ReadRequest& options) {
  sort_tests(all);
  RecordingFinder(all, options).find();
  all.filed.clear();
}

void group_recordings(Dataset& data) {
  data.recording.clear();
  const Column* column = data.find(recording_column);
  if (!column || column->role != Role::test) return;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    data.recording.push_back(static_cast<std::size_t>(column->values[data.first_row[e]]));
}

Units units_of(const Dataset& data) {
  Units units;
  std::map<std::size_t, std::size_t> number;
  for (const std::size_t recording : data.recording)
    units.of.push_back(number.emplace(recording, number.size()).first->second);
  units.count = number.size();
  if (units.count >= 2) return units;
  units.of.resize(data.experiments.size());
  std::iota(units.of.begin(), units.of.end(), 0);
  units.count = units.of.size();
  return units;
}

} // namespace frictab::data
