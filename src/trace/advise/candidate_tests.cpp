// Copies a test near the middle of the campaign and changes its settings.
#include "trace/advise/candidate_tests.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/text.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/recordings.h"
#include "data/roles.h"
#include "trace/columns/candidates.h"
#include "trace/tuning.h"

namespace frictab::trace {

using data::Column;
using data::Dataset;

namespace {

bool is_state(const std::string& name) {
  return data::find_quantity(name) != nullptr;
}

bool is_temperature(const std::string& name) {
  return name == "T_tool_C" || name == "T_contact_C";
}

// Adds the value rounded to three digits, because nobody sets a rig more finely.
void add_value(Setting& setting, double value) {
  setting.values.push_back(std::stod(fmt::format("{:.3g}", value)));
  setting.text.push_back(shortest(setting.values.back()));
}

// Settings by which a column can be changed; "" if there are none.
std::vector<std::string> settings_that_change(const Dataset& data, const std::string& column) {
  if (column == "s_mm" || column == "time_s" || column == "psi" || column == "tau_R_MPa")
    return {"v_rel_mm_s", "sigma_n_MPa"};
  if (column == "T_contact_C" && data.has("T_tool_C")) return {"T_tool_C", "v_rel_mm_s"};
  return {column};
}

struct Range {
  double low, high;
  double width() const { return high - low; }
  Range widened() const {
    const double end = tuning::range_extension * width();
    // Non-negative quantities stay non-negative, and positive ones stay away from 0.
    return {low > 0    ? std::max(low - end, tuning::kept_share_of_least * low)
            : low == 0 ? 0
                       : low - end,
            high + end};
  }
};

// Values that several tests share, as of a switch or of grades; no others can be set. Empty if
// there are many.
std::vector<double> levels_of(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t tests = values.size();
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() > tuning::most_fixed_values ||
      values.size() * tuning::tests_per_fixed_value > tests)
    values.clear();
  return values;
}

Range range_of(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  return {*low, *high};
}

bool names_batches(const std::string& column) {
  return data::has_word(data::words_of_name(column),
                        {"batch", "lot", "charge", "heat", "coil", "melt", "schmelze", "delivery",
                         "lieferung", "bottle", "drum", "fass", "gebinde"});
}

class CandidateTestBuilder {
public:
  CandidateTestBuilder(const Dataset& data, std::vector<Setting> settings) : data_(data) {
    built_.settings = std::move(settings);
    if (built_.settings.size() > tuning::most_varied_settings)
      built_.settings.resize(tuning::most_varied_settings);
    choose_template();
    find_nested_texts();
  }

  CandidateTests run() {
    built_.data.columns = data_.columns;
    for (Column& column : built_.data.columns)
      column.values.clear();
    std::vector<std::size_t> at(built_.settings.size(), 0);
    do {
      add(at);
    } while (next(at));
    return std::move(built_);
  }

private:
  // Advances to the next combination, the last setting varying fastest.
  bool next(std::vector<std::size_t>& at) const {
    for (std::size_t s = at.size(); s-- > 0;) {
      if (++at[s] < built_.settings[s].values.size()) return true;
      at[s] = 0;
    }
    return false;
  }

  // Chooses the test nearest to the medians of all numbers, in units of their ranges.
  void choose_template() {
    std::vector<double> away(data_.experiments.size(), 0);
    for (const Column& column : data_.columns) {
      if (!column.levels.empty()) continue;
      const std::vector<double> means = test_means(data_, column.values);
      std::vector<double> sorted = means;
      std::ranges::sort(sorted);
      const double width = sorted.back() - sorted.front(), median = sorted[sorted.size() / 2];
      for (std::size_t e = 0; width > 0 && e < away.size(); ++e)
        away[e] += std::pow((means[e] - median) / width, 2);
    }
    const auto nearest = std::ranges::min_element(away) - away.begin();
    built_.like = data_.experiments[nearest];
    begin_ = data_.first_row[nearest];
    rows_ = data_.first_row[nearest + 1] - begin_;
  }

  std::vector<double> of_template(const Column& column) const {
    const std::size_t kept = std::min(rows_, tuning::most_candidate_rows);
    std::vector<double> values;
    for (std::size_t i = 0; i < kept; ++i)
      values.push_back(column.values[begin_ + i * rows_ / kept]);
    return values;
  }

  void add(const std::vector<std::size_t>& at) {
    std::map<std::string, std::vector<double>> rows;
    for (const Column& column : data_.columns)
      rows[column.name] = of_template(column);
    for (std::size_t s = 0; s < at.size(); ++s)
      set(rows, built_.settings[s].column, built_.settings[s].values[at[s]]);
    if (!is_reachable(rows) || !follow_nesting(rows)) return;
    for (Column& column : built_.data.columns) {
      const std::vector<double>& values = rows.at(column.name);
      column.values.insert(column.values.end(), values.begin(), values.end());
    }
    built_.data.experiments.push_back(fmt::format("candidate {}", built_.at.size() + 1));
    built_.data.first_row.push_back(built_.data.first_row.back() +
                                    std::min(rows_, tuning::most_candidate_rows));
    built_.at.push_back(at);
  }

  using Rows = std::map<std::string, std::vector<double>>;

  void set(Rows& rows, const std::string& name, double value) const {
    std::vector<double>& values = rows.at(name);
    if (!is_state(name)) {
      std::ranges::fill(values, value);
      return;
    }
    double mean = 0;
    for (const double v : values)
      mean += v / static_cast<double>(values.size());
    if (is_temperature(name)) {
      shift(values, value - mean);
      if (const auto contact = rows.find("T_contact_C");
          name == "T_tool_C" && contact != rows.end())
        shift(contact->second, value - mean);
      return;
    }
    const double factor = mean > 0 ? value / mean : 1;
    for (double& v : values)
      v *= factor;
    if (const auto time = rows.find("time_s"); name == "v_rel_mm_s" && time != rows.end())
      for (double& t : time->second)
        t /= factor;
  }

  // Batches, each of which belongs to one level of another text: to a supplier. Other texts that
  // are nested so may be so by chance, and could be run otherwise.
  struct Nested {
    std::string inner, outer;
    std::map<double, double> outer_of; // by level of inner
  };

  void find_nested_texts() {
    for (const Column& inner : data_.columns)
      for (const Column& outer : data_.columns) {
        if (outer.levels.size() < 2 || inner.levels.size() <= outer.levels.size() ||
            !names_batches(inner.name))
          continue;
        Nested nested{inner.name, outer.name, {}};
        const bool belongs = std::ranges::all_of(
            data_.first_row.begin(), data_.first_row.end() - 1, [&](std::size_t row) {
              const double level = outer.values[row];
              return nested.outer_of.emplace(inner.values[row], level).first->second == level;
            });
        if (belongs && 2 * nested.outer_of.size() <= data_.experiments.size())
          nested_.push_back(std::move(nested));
      }
  }

  // Gives a batch its supplier; false for tests of a batch with another one.
  bool follow_nesting(Rows& rows) const {
    const auto is_set = [&](const std::string& name) {
      return contains(built_.settings, name, &Setting::column);
    };
    for (const Nested& nested : nested_) {
      if (!is_set(nested.inner) && !is_set(nested.outer)) continue;
      const auto outer = nested.outer_of.find(rows.at(nested.inner).front());
      if (outer == nested.outer_of.end()) return false;
      if (rows.at(nested.outer).front() == outer->second) continue;
      if (is_set(nested.outer)) return false;
      std::ranges::fill(rows.at(nested.outer), outer->second);
    }
    return true;
  }

  static void shift(std::vector<double>& values, double by) {
    for (double& v : values)
      v += by;
  }

  bool is_reachable(const Rows& rows) const {
    return std::ranges::all_of(built_.settings, [&](const Setting& setting) {
      const Column& column = *data_.find(setting.column);
      if (!column.levels.empty()) return true;
      const Range all = range_of(column.values).widened(), own = range_of(rows.at(setting.column));
      const double rounding = tuning::reach_tolerance * all.width();
      return own.low >= all.low - rounding && own.high <= all.high + rounding;
    });
  }

  const Dataset& data_;
  CandidateTests built_;
  std::size_t begin_ = 0, rows_ = 0;
  std::vector<Nested> nested_;
};

// Whether the column is an order of tests (a date, 1, 2, 3, ...), which nobody sets.
bool numbers_tests(const Column& column) {
  return data::is_order(column) || column.name == data::interval_column ||
         column.name == "test_order" || column.name == "run_order" || column.name == "test_number";
}

} // namespace

std::vector<Setting> settings_of(const Dataset& data, const std::vector<std::string>& columns) {
  std::vector<Setting> settings;
  const auto add = [&](const std::string& name) {
    const Column* column = data.find(name);
    const bool known = contains(settings, name, &Setting::column);
    if (known || !column || numbers_tests(*column)) return;
    Setting setting{name, {}, column->levels};
    if (!column->levels.empty()) {
      for (std::size_t level = 0; level < column->levels.size(); ++level)
        setting.values.push_back(static_cast<double>(level));
    } else {
      if (!is_state(name) && varies_within(column->values, data)) return;
      const Range run = range_of(test_means(data, column->values));
      if (!(run.width() > tuning::varied_share_of_mean * std::abs(run.low + run.high) / 2)) return;
      const Range range = run.widened();
      if (const auto levels = levels_of(test_means(data, column->values)); !levels.empty()) {
        for (const double value : {levels.front(), levels[levels.size() / 2], levels.back()})
          if (setting.values.empty() || value != setting.values.back()) add_value(setting, value);
      } else
        for (const double value : {range.low, (range.low + range.high) / 2, range.high})
          add_value(setting, value);
    }
    if (setting.values.size() > 1) settings.push_back(std::move(setting));
  };
  for (const std::string& column : columns)
    for (const std::string& name : settings_that_change(data, column))
      add(name);
  return settings;
}

CandidateTests candidate_tests(const Dataset& data, std::vector<Setting> settings) {
  return CandidateTestBuilder(data, std::move(settings)).run();
}

} // namespace frictab::trace
