// Lists candidate columns and pairs of them.
#include "trace/columns/candidates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>

#include "core/error.h"
#include "core/hash.h"
#include "core/order_statistics.h"
#include "core/text.h"
#include "data/derived.h"
#include "data/options.h"
#include "data/quantity.h"
#include "data/recordings.h"
#include "data/roles.h"
#include "data/time_stamps.h"
#include "stats/projection.h"
#include "trace/tuning.h"

namespace frictab::trace {

using data::Column;
using data::Dataset;

namespace {

using Rows = std::span<const double>;

bool is_constant(Rows values) {
  return std::ranges::all_of(values, [&](double v) { return v == values.front(); });
}

bool has_two_values(Rows values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  return std::ranges::all_of(
      values, [low = *low, high = *high](double v) { return v == low || v == high; });
}

std::size_t count_empty(Rows values) {
  return std::ranges::count_if(values, [](double v) { return std::isnan(v); });
}

// The rows of one test.
Rows of_test(const Dataset& data, std::size_t e, Rows values) {
  return values.subspan(data.first_row[e], data.first_row[e + 1] - data.first_row[e]);
}

// Squared correlation; 0 if a column does not vary.
double likeness(const VectorXd& a, const VectorXd& b) {
  const VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  const double xy = x.dot(y), size = x.squaredNorm() * y.squaredNorm();
  return size > 0 ? xy * xy / size : 0;
}

// Multiples of the golden ratio: evenly distributed and never periodic, so no column has this
// direction by chance.
VectorXd golden_direction(Index size) {
  VectorXd direction(size);
  double next = 0.5;
  for (double& d : direction) {
    next = std::fmod(next + std::numbers::phi - 1, 1.0);
    d = next - 0.5;
  }
  return direction.normalized();
}

// Position of a column along that direction. Identical columns have neighbouring positions, so each
// column is compared with few of a thousand others. The sign of a correlation does not matter.
double standing(const VectorXd& values, const VectorXd& direction) {
  const VectorXd x = values.array() - values.mean();
  const double size = x.norm();
  return size > 0 ? std::abs(direction.dot(x)) / size : 0;
}

// Quantiles; partially sorts `all`: every value ends up between the quantiles around it.
std::vector<double> quantiles_of(std::vector<double>& all) {
  std::vector<double> at;
  std::vector<std::size_t> ranks;
  for (std::size_t i = 0; i <= tuning::quantile_intervals; ++i)
    ranks.push_back(i * (all.size() - 1) / tuning::quantile_intervals);
  place_ranks(all, ranks);
  for (const std::size_t rank : ranks)
    at.push_back(all[rank]);
  return at;
}

double width_of(Rows values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  return *high - *low;
}

double widest_gap(const std::vector<double>& tested) {
  double widest = 0;
  for (std::size_t i = 1; i < tested.size(); ++i)
    widest = std::max(widest, tested[i] - tested[i - 1]);
  return widest;
}

// Whether each of these tests is among the others, with the same friction: validation tests that
// are searched as well.
bool are_among(const Dataset& tests, const Dataset& others) {
  std::unordered_map<std::string_view, std::size_t> known;
  for (std::size_t e = 0; e < others.experiments.size(); ++e)
    known.emplace(others.experiments[e], e);
  for (std::size_t e = 0; e < tests.experiments.size(); ++e) {
    const auto found = known.find(tests.experiments[e]);
    if (found == known.end() ||
        !std::ranges::equal(of_test(tests, e, tests.values("tau_R_MPa")),
                            of_test(others, found->second, others.values("tau_R_MPa"))))
      return false;
  }
  return true;
}

class CandidateFinder {
public:
  CandidateFinder(const Dataset& training, const Dataset& validation, const stats::Blocks& blocks,
                  Rows predicted, const std::vector<std::string>& inputs,
                  const TraceOptions& options)
      : training_(training), validation_(validation), blocks_(blocks), predicted_(predicted),
        inputs_(inputs), options_(options), golden_(golden_direction(blocks.count())) {
    for (const Column& column : validation.columns)
      validation_columns_.emplace(column.name, &column);
  }

  Candidates run() {
    check_names();
    find_order();
    // States first: of two columns that are the same, the state is the cause.
    for (const bool states : {true, false})
      for (const Column& column : training_.columns)
        if (names_state(column.name) == states && allowed(column)) add_recorded(column);
    for (const data::DerivedQuantity& quantity : data::derived_quantities())
      if (possible(quantity)) add_derived(quantity);
    return std::move(found_);
  }

private:
  void check_names() const {
    std::vector<std::string> known;
    for (const Column& column : training_.columns)
      known.push_back(column.name);
    for (const data::DerivedQuantity& quantity : data::derived_quantities())
      known.push_back(quantity.name);
    FaultList faults;
    const auto check = [&](const std::string& name, const Place& place) {
      if (!contains(known, name))
        faults.add(place, "the data have no column '" + name + "'", suggest(name, known));
    };
    for (const std::string& name : options_.ignore)
      check(name, options_.ignore_place);
    if (!options_.order.empty()) check(options_.order, options_.order_place);
    if (!options_.tool_distance.empty())
      check(options_.tool_distance, options_.tool_distance_place);
    const Column* worn = training_.find(options_.tool_distance);
    if (worn && (!worn->levels.empty() || data::is_measured(worn->name)))
      faults.add(options_.tool_distance_place,
                 fmt::format("'{}' is not a distance: it {}", worn->name,
                             worn->levels.empty() ? "is what was measured" : "holds text"),
                 "a column of numbers: how far the tool had slid before the test");
    faults.throw_if_any();
  }

  bool ignored(const std::string& name) const { return contains(options_.ignore, name); }

  // Accepts only a declared order, or a column whose name gives one, because files are often sorted
  // by condition.
  void find_order() {
    const Column* order = nullptr;
    int best = 0;
    for (const Column& column : training_.columns)
      if (const int rank = order_rank(column); rank > best) {
        order = &column;
        best = rank;
      }
    if (!order) return;
    if (const std::size_t empty = count_empty(order->values); empty > 0)
      return refuse_order(*order,
                          fmt::format("{} of {} rows without a value", thousands(empty),
                                      thousands(training_.rows())),
                          "fill them in, or name another column");
    if (const std::string why = why_no_order(*order); !why.empty())
      return refuse_order(*order, why, "a number that counts the tests, or when each was made");
    const data::TestDates dates = data::sort_dates(order->levels); // time stamps are text
    if (!dates.fault.empty()) return refuse_order(*order, dates.fault, "write dates as 2024-09-01");
    std::vector<double> values;
    for (std::size_t e = 0; e < training_.experiments.size(); ++e) {
      const double value = order->values[training_.first_row[e]];
      values.push_back(order->levels.empty() ? value
                                             : dates.place[static_cast<std::size_t>(value)]);
    }
    found_.order = sorted_tests(values);
    found_.order_column = order->name;
  }

  // Rank of a column as the order of tests; 0: it gives none. A number qualifies only if no two
  // tests share a value.
  int order_rank(const Column& column) const {
    if (!options_.order.empty()) return column.name == options_.order ? 1 : 0;
    if (!data::is_order(column) || varies_within(column.values, training_) ||
        is_constant(column.values))
      return 0;
    if (column.why == data::set_by_job) return 3;
    if (!column.levels.empty()) return 1; // a time stamp
    return values_of_tests(column, training_) == training_.experiments.size() ? 2 : 0;
  }

  // Orders tests with equal values, such as those of one day, at random instead of by name: names
  // often follow the conditions. (Experiments are sorted by name.)
  std::vector<std::size_t> sorted_tests(const std::vector<double>& values) const {
    std::vector<std::size_t> tests(values.size());
    std::iota(tests.begin(), tests.end(), 0);
    std::vector<std::uint64_t> draw;
    for (const std::string& name : training_.experiments)
      draw.push_back(hash_of(name));
    std::ranges::sort(tests, {}, [&](std::size_t e) { return std::tuple(values[e], draw[e], e); });
    return tests;
  }

  // Reason why the values of a column order no tests; empty: they do.
  std::string why_no_order(const Column& column) const {
    const std::size_t values = values_of_tests(column, training_);
    const auto has_digit = [](const std::string& text) {
      return text.find_first_of("0123456789") != std::string::npos;
    };
    if (data::is_measured(column.name)) return "it is what was measured";
    if (const auto text = std::ranges::find_if_not(column.levels, has_digit);
        text != column.levels.end())
      return fmt::format("'{}' is neither a number nor a time stamp", *text);
    if (values >= 3) return "";
    return values == 1 ? "every test begins with the same value"
                       : "the tests begin with two values only";
  }

  // Throws if the job names the column; else notes that the column is not used.
  void refuse_order(const Column& column, const std::string& why, const std::string& hint) {
    const std::string text = fmt::format("{}, the order of tests: {}", column.name, why);
    if (column.name == options_.order) throw InputError(options_.order_place, text, hint);
    found_.notes.push_back(text + ": not used");
  }

  bool allowed(const Column& column) {
    if (data::is_measured(column.name) || column.name == data::origin_column ||
        column.role == data::Role::test || ignored(column.name))
      return false;
    // Sources of the measured stress are reported when the file is read; channels and outcomes
    // become leads.
    if (!data::may_be_searched(column.role) && !data::find_quantity(column.name))
      return column.role == data::Role::response &&
             skip(fmt::format("{} belongs to the measured friction ({}){}", column.name, column.why,
                              not_searched));
    if (column.name == found_.order_column) {
      if (column.name != "run_order" && column.levels.empty())
        add_column(column.name, {column.name}, false, column.values);
      return false;
    }
    if (data::find_derived(effects::symbol_of(column.name)))
      return skip(column.name + " has the name of a history that frictab computes "
                                "itself: the column is left out; another name lets it "
                                "be tried");
    if (is_constant(column.values)) {
      found_.constant.push_back(column.name);
      return false;
    }
    if (column.name == "time_s" && is_clock(column))
      return skip(fmt::format("time_s, the time of a clock, for which time_since_start stands{}",
                              not_searched));
    if (column.name == data::interval_column)
      if (const std::string state = state_of_intervals(column); !state.empty())
        return skip(fmt::format("{}, which goes with {}{}", column.name, state, not_searched));
    const auto in_validation = validation_columns_.find(column.name);
    if (in_validation == validation_columns_.end())
      return skip(column.name + " is not in the validation data: left out");
    return is_filled(column, *in_validation->second);
  }

  // Whether a time is that of the day or of the rig: every test begins later than the longest
  // takes.
  bool is_clock(const Column& time) const {
    double first = std::numeric_limits<double>::infinity(), longest = 0;
    for (std::size_t e = 0; e < training_.experiments.size(); ++e) {
      const Rows rows = of_test(training_, e, time.values);
      first = std::min(first, rows.front());
      longest = std::max(longest, rows.back() - rows.front());
    }
    return first > longest;
  }

  // Name of a state that is set by the number of the interval in a recording, as in load steps:
  // the state is the cause, not its number. Empty: none is.
  std::string state_of_intervals(const Column& interval) const {
    const std::vector<std::size_t> recording = data::units_of(training_).of;
    for (const Column& column : training_.columns) {
      if (!names_state(column.name) || is_constant(column.values)) continue;
      std::vector<double> change = test_means(training_, column.values);
      const bool ratios = *std::ranges::min_element(change) > 0;
      std::map<std::size_t, double> reference; // of each recording, its first interval
      for (std::size_t e = 0; e < change.size(); ++e) {
        const double first = reference.emplace(recording[e], change[e]).first->second;
        change[e] = ratios ? std::log(change[e] / first) : change[e] - first;
      }
      std::map<double, std::pair<double, double>> of_number; // sum and number of tests
      for (std::size_t e = 0; e < change.size(); ++e) {
        auto& [sum, tests] = of_number[interval.values[training_.first_row[e]]];
        sum += change[e];
        ++tests;
      }
      double left = 0, all = 0;
      for (std::size_t e = 0; e < change.size(); ++e) {
        const auto& [sum, tests] = of_number.at(interval.values[training_.first_row[e]]);
        left += std::pow(change[e] - sum / tests, 2);
        all += std::pow(change[e], 2);
      }
      if (all > 0 && left < (1 - tuning::aliased_share_of_variance) * all) return column.name;
    }
    return "";
  }

  // Notes why a column is not searched.
  bool skip(std::string why) {
    found_.notes.push_back(std::move(why));
    return false;
  }

  // Skips columns with empty cells: no values are invented, and rows are not dropped for a column
  // that may be irrelevant to friction.
  bool is_filled(const Column& training, const Column& validation) {
    std::size_t empty = count_empty(training.values), rows = training_.rows();
    const std::size_t in_validation = count_empty(validation.values);
    if (empty + in_validation == 0) return true;
    if (!are_among(validation_, training_)) {
      empty += in_validation;
      rows += validation_.rows();
    }
    return skip(fmt::format("{}: {} of {} rows without a value{}", training.name, thousands(empty),
                            thousands(rows), not_searched));
  }

  bool is_order(const std::string& name) const {
    return name == "test_order" || name == found_.order_column;
  }

  void add_column(const std::string& name, std::vector<std::string> recorded, bool derived,
                  Rows values) {
    CandidateColumn column;
    column.name = name;
    column.recorded = std::move(recorded);
    column.derived = derived;
    column.values = blocks_.mean(values);
    std::vector<double> in_parts(values.begin(), values.end());
    column.tested = quantiles_of(in_parts);
    column.spread = effects::spread_of(in_parts); // faster here than on unsorted values
    column.within = varies_within(values, training_);
    column.two_values = has_two_values(values);
    const double all = width_of(values);
    column.reach = all > 0 ? usual_range(values, training_) / all : 0;
    column.gap = widest_gap(column.tested);
    column.is_reading = !derived && is_reading(name);
    column.is_order = is_order(name);
    const std::string& wear = options_.tool_distance;
    column.is_wear =
        !wear.empty() && (name == wear || (name == "test_order" && wear == found_.order_column));
    const bool course = column.within && (name == "time_s" || name == "s_mm");
    column.between = column.is_order ? column.is_wear : !derived && !course;
    column.in_law = contains(inputs_, effects::symbol_of(name));
    found_.by_symbol[effects::symbol_of(name)] = column.values;
    keep(std::move(column));
  }

  bool is_reading(const std::string& name) const {
    const Column* column = training_.find(name);
    return column && !data::find_quantity(name) && column->levels.empty() &&
           column->why != data::set_by_job &&
           2 * values_of_tests(*column, training_) > training_.experiments.size();
  }

  // First column that is identical up to offset and scale; nullptr if there is none.
  const CandidateColumn* twin_of(const VectorXd& values, double at) const {
    std::size_t first = found_.columns.size();
    for (auto near = standings_.lower_bound(at - tuning::same_projection_tolerance);
         near != standings_.end() && near->first <= at + tuning::same_projection_tolerance; ++near)
      if (near->second < first &&
          likeness(found_.columns[near->second].values, values) > tuning::identical_r2)
        first = near->second;
    return first < found_.columns.size() ? &found_.columns[first] : nullptr;
  }

  // Keeps a column unless it is the same as an earlier one; texts of more than two levels are not
  // compared, as their numbers mean nothing.
  void keep(CandidateColumn column) {
    const double at = standing(column.values, golden_);
    if (column.levels.size() <= 2)
      if (const CandidateColumn* twin = twin_of(column.values, at)) {
        found_.notes.push_back(column.name + " is the same as " + twin->name + " in these data");
        return;
      }
    standings_.emplace(at, found_.columns.size());
    found_.columns.push_back(std::move(column));
  }

  void add_recorded(const Column& column) {
    if (column.levels.empty()) return add_column(column.name, {column.name}, false, column.values);
    if (column.levels.size() > tuning::most_levels_of_text) {
      found_.notes.push_back(fmt::format("{} has {} levels, more than {}: left out", column.name,
                                         column.levels.size(), tuning::most_levels_of_text));
      return;
    }
    CandidateColumn text;
    text.name = column.name;
    text.recorded = {column.name};
    text.levels = column.levels;
    // A block that spans two levels gets the level of its first row.
    text.values.resize(blocks_.count());
    for (std::size_t b = 0; b < blocks_.count(); ++b)
      text.values(b) = column.values[blocks_.first_row[b]];
    text.within = varies_within(column.values, training_);
    text.between = !text.within;
    text.is_order = is_order(column.name);
    found_.by_symbol[effects::symbol_of(column.name)] = text.values;
    keep(std::move(text));
  }

  bool possible(const data::DerivedQuantity& quantity) const {
    if (ignored(quantity.name)) return false;
    return std::ranges::all_of(quantity.needs, [&](const std::string& need) {
      return need == "tau" || (training_.has(need) && validation_.has(need) && !ignored(need));
    });
  }

  void add_derived(const data::DerivedQuantity& quantity) {
    const std::vector<double> values = data::derive(quantity, training_, predicted_);
    if (is_constant(values)) return;
    std::vector<std::string> recorded;
    for (const std::string& need : quantity.needs)
      if (need != "tau") recorded.push_back(need);
    add_column(quantity.name, std::move(recorded), true, values);
  }

  const Dataset& training_;
  const Dataset& validation_;
  const stats::Blocks& blocks_;
  Rows predicted_;
  const std::vector<std::string>& inputs_;
  const TraceOptions& options_;
  const VectorXd golden_;
  std::unordered_map<std::string_view, const Column*> validation_columns_;
  std::multimap<double, std::size_t> standings_; // positions of the columns found
  Candidates found_;
};

// Each pair has a dozen shapes, each as long as the data. Pairs of a thousand columns would exhaust
// memory, and no effect could be significant among half a million.
bool pairs_every_column(const Candidates& candidates) {
  return candidates.columns.size() <= tuning::most_columns_for_all_pairs;
}

// Whether a column may act together with others. Among histories only four may: the others nearly
// follow these, and each further column multiplies the pairs.
bool may_act_with_others(const CandidateColumn& column) {
  const effects::Spread& s = column.spread;
  const bool numbers = s.high - s.low > tuning::pair_spread_share_of_median *
                                            std::max(std::abs(s.median), tuning::smallest_divisor);
  return (!column.levels.empty() || numbers) &&
         (!column.derived || column.name == "sliding_distance" || column.name == "friction_work" ||
          column.name == "load_ratio" || column.name == "temperature_rise");
}

// Whether two columns are nearly collinear: they are one quantity, and their product is a parabola.
bool run_alike(const CandidateColumn& a, const CandidateColumn& b) {
  return a.levels.empty() && b.levels.empty() &&
         likeness(a.values, b.values) > tuning::near_collinear_r2;
}

// Whether the columns act together as something other than one of them alone.
bool may_act_together(const CandidateColumn& a, const CandidateColumn& b) {
  return may_act_with_others(a) && may_act_with_others(b) && !run_alike(a, b);
}

int steps_from_what_is_recorded(const CandidateColumn& derived) {
  const data::Continuation& how = data::find_derived(derived.name)->continuation;
  if (how.always) return 1;
  return how.rule == data::Continuation::none ? 3 : 2;
}

} // namespace

std::vector<const CandidateColumn*> Candidates::of(const Cause& cause) const {
  std::vector<const CandidateColumn*> all;
  for (const std::size_t c : cause.columns)
    all.push_back(&columns[c]);
  return all;
}

std::size_t Candidates::texts_of(const Cause& cause) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      cause.columns, [&](std::size_t column) { return !columns[column].levels.empty(); }));
}

std::vector<std::string> Candidates::recorded_of(const Cause& cause) const {
  std::vector<std::string> names;
  for (const CandidateColumn* column : of(cause))
    for (const std::string& name : column->recorded)
      if (!contains(names, name)) names.push_back(name);
  return names;
}

MatrixXd level_columns(const CandidateColumn& text) {
  MatrixXd columns(text.values.size(), text.levels.size());
  for (Index level = 0; level < columns.cols(); ++level)
    columns.col(level) = (text.values.array() == static_cast<double>(level)).cast<double>();
  return columns;
}

bool varies_within(Rows values, const Dataset& data) {
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    if (!is_constant(of_test(data, e, values))) return true;
  return false;
}

double usual_range(Rows values, const Dataset& data) {
  std::vector<double> own;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    own.push_back(width_of(of_test(data, e, values)));
  std::ranges::sort(own);
  return own[own.size() / 2];
}

std::vector<double> test_means(const Dataset& data, Rows values) {
  std::vector<double> means;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    double sum = 0;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      sum += data.row_weight(i) * values[i];
    means.push_back(sum / static_cast<double>(data.source_rows(e)));
  }
  return means;
}

std::size_t values_of_tests(const Column& column, const Dataset& data) {
  std::set<double> values;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    values.insert(column.values[data.first_row[e]]);
  return values.size();
}

Candidates find_candidates(const Dataset& training, const Dataset& validation,
                           const stats::Blocks& blocks, Rows predicted,
                           const std::vector<std::string>& inputs, const TraceOptions& options) {
  Candidates found =
      CandidateFinder(training, validation, blocks, predicted, inputs, options).run();
  if (!pairs_every_column(found))
    found.notes.push_back(fmt::format("pairs without a state of the law, of {} columns (of all up "
                                      "to {}; data.bystanders or trace.ignore leave some out){}",
                                      thousands(found.columns.size()),
                                      tuning::most_columns_for_all_pairs, not_searched));
  if (training.has("sigma_n_MPa")) { // effects added to tau_R fade with it
    const auto sigma = training.values("sigma_n_MPa");
    found.by_symbol.try_emplace("sigma_n_MPa", blocks.mean(sigma));
    for (const double pressure : sigma)
      if (pressure > 0 && (found.lowest_pressure_MPa == 0 || pressure < found.lowest_pressure_MPa))
        found.lowest_pressure_MPa = pressure;
  }
  for (const std::string& name : inputs) {
    if (found.by_symbol.count(name)) continue;
    // a history that is not searched
    const data::DerivedQuantity* history = data::find_derived(name);
    found.by_symbol[name] = history ? blocks.mean(data::derive(*history, training, predicted))
                                    : blocks.mean(training.values(name));
  }
  return found;
}

std::vector<Cause> all_causes(const Candidates& candidates) {
  std::vector<Cause> all;
  const auto& columns = candidates.columns;
  for (std::size_t c = 0; c < columns.size(); ++c)
    all.push_back({{c}});
  const bool every_pair = pairs_every_column(candidates);
  for (std::size_t a = 0; a < columns.size(); ++a)
    for (std::size_t b = a + 1; b < columns.size(); ++b)
      if ((every_pair || columns[a].in_law || columns[b].in_law) &&
          may_act_together(columns[a], columns[b]))
        all.push_back({!columns[b].levels.empty() && columns[a].levels.empty()
                           ? std::vector{b, a}
                           : std::vector{a, b}});
  return all;
}

bool names_state(const std::string& name) {
  const data::Quantity* known = data::find_quantity(name);
  return known && known->state && name != "s_mm";
}

bool is_state(const CandidateColumn& column) {
  return (column.in_law || names_state(column.name)) && column.name != "s_mm" &&
         column.name != "time_s";
}

MatrixXd state_means(const Candidates& candidates, const stats::Blocks& blocks) {
  MatrixXd all(blocks.experiments(), 0);
  for (const CandidateColumn& column : candidates.columns) {
    if (!is_state(column) || column.name == "sigma_f_MPa") continue; // which follows from others
    VectorXd x = blocks.experiment_means(column.values).col(0);
    if (stats::standardise(x)) stats::append_columns(all, x);
  }
  return all;
}

bool one_factor_at_a_time(const MatrixXd& states) {
  if (states.cols() < 2 || states.rows() < tuning::fewest_tests_for_one_factor) return false;
  Eigen::VectorXi count = Eigen::VectorXi::Zero(states.rows());
  for (Index s = 0; s < states.cols(); ++s) {
    VectorXd sorted = states.col(s);
    std::ranges::sort(sorted);
    const double range = sorted(sorted.size() - 1) - sorted(0), middle = sorted(sorted.size() / 2);
    count += ((states.col(s).array() - middle).abs() > tuning::changed_share_of_range * range)
                 .cast<int>()
                 .matrix();
  }
  const auto several = static_cast<double>((count.array() > 1).count());
  return several <= tuning::share_of_tests_changing_several * static_cast<double>(states.rows());
}

std::optional<Cause> cause_in(const Candidates& to, const Cause& cause, const Candidates& from) {
  Cause found = cause;
  for (std::size_t& column : found.columns) {
    const auto at = std::ranges::find_if(to.columns, [&](const CandidateColumn& one) {
      return one.name == from.columns[column].name;
    });
    if (at == to.columns.end()) return std::nullopt;
    column = at - to.columns.begin();
  }
  return found;
}

bool are_crossed(const Candidates& candidates, const Cause& texts,
                 std::span<const std::size_t> first) {
  const std::vector<const CandidateColumn*> of = candidates.of(texts);
  if (!of[0]->between || !of[1]->between) return false;
  std::map<std::pair<double, double>, std::size_t> tests; // by levels
  for (const std::size_t block : first.first(first.size() - 1))
    ++tests[{of[0]->values(static_cast<Index>(block)), of[1]->values(static_cast<Index>(block))}];
  return tests.size() == of[0]->levels.size() * of[1]->levels.size() &&
         std::ranges::all_of(
             tests, [](const auto& pair) { return pair.second >= tuning::fewest_tests_of_pair; });
}

std::string cause_name(const Cause& cause, const Candidates& candidates) {
  std::vector<std::string> names;
  for (const CandidateColumn* column : candidates.of(cause))
    names.push_back(column->name);
  return join(names, " x ");
}

int complexity(const Cause& cause, const Candidates& candidates) {
  int steps = 2 * static_cast<int>(cause.columns.size() - 1);
  for (const CandidateColumn* column : candidates.of(cause))
    if (column->derived)
      steps += steps_from_what_is_recorded(*column);
    else if (column->name == "time_s") // something else changes with it
      ++steps;
  return steps;
}

bool constant_in_experiments(const Cause& cause, const Candidates& candidates) {
  return std::ranges::none_of(candidates.of(cause), &CandidateColumn::within);
}

} // namespace frictab::trace
