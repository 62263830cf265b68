// Four tests, from one that needs many rows to ones that need a dozen.
#include "data/disguise.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <Eigen/Core>
#include <fmt/format.h>

#include "core/no_value.h"
#include "core/parallel.h"
#include "data/middle.h"
#include "data/options.h"
#include "data/quantity.h"

namespace frictab::data {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Limits set with a prototype of the same rules: it reported a disguise in 0 of 120 synthetic
// campaigns without one, and found 166 of 185 disguises. The rates of this code are in
// tests/unit/roles_test.cpp.
constexpr double sure_share = 0.05, ask_share = 0.2; // of y's mean square
constexpr double own_scatter = 0.5;                  // limit from row to row
constexpr std::size_t few_levels = 8;                // of a number that tests share
constexpr double shared_values = 0.3; // share of tests whose value other tests have as well
// Most that a reading and a factor may leave, relative to what the factor leaves alone.
constexpr double of_factor = 0.5;
constexpr double sure_direct = 0.02; // relative to the best formula of states only
constexpr double sure_rank = 0.999, state_rank = 0.99;
constexpr double sure_linear = 0.95, ask_linear = 0.85; // R squared from row to row
constexpr std::array<Index, 3> least_of_level = {40, 60, 10};
constexpr Index least_direct = 12, least_rank = 20, least_linear = 200;
constexpr Index rows_of_test = 250, steps_of_campaign = 60000, rows_to_rank = 20000;
constexpr Index piece_count = 20, rows_for_blocks = 40, to_screen = 2000;
constexpr std::size_t most_in_pairs = 40;
// Limits for a large campaign: uses every other row or fewer, and if that is not enough, some of
// the tests.
constexpr Index values_to_hold = 2'000'000, least_rows = 20000, least_rows_of_test = 200,
                most_rows_of_test = 20000;
// Smallest value whose logarithm is taken, as a fraction of the median.
constexpr double floor_share = 0.05, floor_share_tau = 0.1;
constexpr double kept_share = 0.97, infinite = std::numeric_limits<double>::infinity();

VectorXd logarithm(const VectorXd& x, double share) {
  std::vector<double> sizes;
  for (const double value : x)
    if (std::abs(value) > 0) sizes.push_back(std::abs(value)); // excludes NaN as well
  const double floor = share * upper_median(std::move(sizes));
  return x.unaryExpr([floor](double value) {
    return std::abs(value) > floor ? std::log(std::abs(value)) : no_value;
  });
}

// Mean of the smallest squares; leaves out the largest share.
double trimmed_mean_square(VectorXd x, double share = kept_share) {
  const Index keep = std::max<Index>(1, static_cast<Index>(share * static_cast<double>(x.size())));
  x = x.cwiseAbs2();
  std::nth_element(x.data(), x.data() + keep - 1, x.data() + x.size());
  return x.head(keep).mean();
}

double share_left(const VectorXd& of, const VectorXd& without) {
  const double all = trimmed_mean_square(of);
  return all > 0 ? trimmed_mean_square(of - without) / all : infinite;
}

double spread_of(const VectorXd& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

double squared_correlation(const VectorXd& a, const VectorXd& b) {
  const VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  const double size = x.squaredNorm() * y.squaredNorm(), xy = x.dot(y);
  return size > 0 ? xy * xy / size : 0;
}

// Ranks; equal values get their mean rank.
VectorXd ranks(const VectorXd& x) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return x[a] < x[b]; });
  VectorXd out(x.size());
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && x[order[end]] == x[order[i]])
      ++end;
    for (std::size_t j = i; j < end; ++j)
      out[order[j]] = 0.5 * static_cast<double>(i + end - 1);
  }
  return out;
}

// Step of the last digit in which a column is written.
double resolution(const VectorXd& x) {
  std::vector<double> sorted(x.data(), x.data() + std::min<Index>(x.size(), rows_to_rank));
  std::erase_if(sorted, [](double value) { return !std::isfinite(value); });
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty()) return 0;
  const double nothing = 1e-12 * std::max(std::abs(sorted.front()), std::abs(sorted.back()));
  double least = infinite;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (const double step = sorted[i] - sorted[i - 1]; step > nothing)
      least = std::min(least, step);
  return std::isfinite(least) ? least : 0;
}

// Step in which values are written, over their median: 0.115, 0.12 and 0.13 have steps of 0.005.
double written_step(const std::vector<double>& values) {
  double decimal = 1;
  const auto is_whole = [&](double value) {
    return std::abs(value / decimal - std::round(value / decimal)) < 1e-6;
  };
  while (decimal > 1e-9 && !std::all_of(values.begin(), values.end(), is_whole))
    decimal /= 10;
  long long step = 0;
  for (const double value : values) {
    if (!(std::abs(value / decimal) < 1e15)) return 0; // more digits than a double has
    step = std::gcd(step, std::llround(value / decimal));
  }
  return static_cast<double>(step) * decimal / std::max(std::abs(upper_median(values)), 1e-300);
}

// Mean of the numbers in a text: "0.10-0.12" is 0.11.
double number_in(const std::string& text) {
  double sum = 0, count = 0;
  for (const char *at = text.data(), *end = at + text.size(); at < end;) {
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc()) {
      ++at;
      continue;
    }
    sum += std::abs(value);
    ++count;
    at = read.ptr;
  }
  return count > 0 ? sum / count : no_value;
}

bool is_known(double value) {
  return std::isfinite(value);
}

// The tests of all parts in sequence, and the three levels on which a column is examined: row
// steps, pieces of tests, means of tests.
class Cut {
public:
  explicit Cut(std::span<const Dataset* const> parts) : parts_(parts) {
    const auto columns = static_cast<Index>(parts.front()->columns.size());
    const Index budget = std::max(values_to_hold / columns, least_rows);
    Index tests = 0, rows = 0;
    for (const Dataset* part : parts)
      tests += static_cast<Index>(part->experiments.size());
    rows_of_test_ = std::clamp(budget / tests, least_rows_of_test, most_rows_of_test);
    for (const Dataset* part : parts)
      for (std::size_t e = 0; e < part->experiments.size(); ++e)
        rows += std::min(static_cast<Index>(part->first_row[e + 1] - part->first_row[e]),
                         rows_of_test_);
    const Index every = 1 + (rows - 1) / budget;
    Index number = 0;
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t e = 0; e < parts[p]->experiments.size(); ++e)
        if (number++ % every == 0) take(p, parts[p]->first_row[e], parts[p]->first_row[e + 1]);
    add_steps();
  }

  Index rows() const { return rows_; }
  Index tests() const { return static_cast<Index>(tests_.size()); }

  // NaN if a part has no such column, or for text without a number.
  VectorXd values(const std::string& name) const {
    VectorXd out = VectorXd::Constant(rows_, no_value);
    for (const Test& test : tests_) {
      const Column* column = parts_[test.part]->find(name);
      if (!column) continue;
      std::vector<double> numbers;
      for (const std::string& level : column->levels)
        numbers.push_back(number_in(level));
      for (Index i = 0; i < test.rows; ++i) {
        const double value =
            column->values[test.first_in_part + static_cast<std::size_t>(i) * test.every];
        out[test.first + i] = numbers.empty() || !std::isfinite(value)
                                  ? value
                                  : numbers[static_cast<std::size_t>(value)];
      }
    }
    return out;
  }

  VectorXd steps(const VectorXd& x) const {
    VectorXd out(static_cast<Index>(steps_.size()));
    for (Index i = 0; i < out.size(); ++i)
      out[i] = x[steps_[static_cast<std::size_t>(i)] + 1] - x[steps_[static_cast<std::size_t>(i)]];
    return out;
  }

  std::array<VectorXd, 3> levels(const VectorXd& x) const {
    return {steps(x), steps_of_blocks(x), means_of_tests(x)};
  }

  VectorXd means_of_tests(const VectorXd& x) const {
    VectorXd out(tests());
    for (Index t = 0; t < tests(); ++t)
      out[t] = mean(x, at(t).first, at(t).rows, 0.3);
    return out;
  }

  VectorXd spreads_in_tests(const VectorXd& x) const {
    VectorXd out(tests());
    for (Index t = 0; t < tests(); ++t) {
      double low = infinite,
             high = -infinite; // of known values; without any, high < low
      for (const double value : x.segment(at(t).first, at(t).rows)) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
      out[t] = std::max(high - low, 0.0);
    }
    return out;
  }

  // Steps of x over those of y within tests; NaN if y is constant.
  VectorXd rate(const VectorXd& x, const VectorXd& y) const {
    VectorXd out = VectorXd::Constant(rows_, no_value);
    for (const Test& test : tests_)
      for (Index i = test.first + 1; i < test.first + test.rows; ++i)
        if (y[i] > y[i - 1]) out[i] = (x[i] - x[i - 1]) / (y[i] - y[i - 1]);
    return out;
  }

private:
  struct Test {
    Index first, rows;
    std::size_t part, first_in_part, every;
  };

  void take(std::size_t part, std::size_t begin, std::size_t end) {
    const std::size_t every = 1 + (end - begin - 1) / static_cast<std::size_t>(rows_of_test_);
    const auto rows = static_cast<Index>((end - begin + every - 1) / every);
    tests_.push_back({rows_, rows, part, begin, every});
    rows_ += rows;
  }

  const Test& at(Index t) const { return tests_[static_cast<std::size_t>(t)]; }

  static double mean(const VectorXd& x, Index first, Index rows, double known) {
    double sum = 0, count = 0;
    for (const double value : x.segment(first, rows))
      if (is_known(value)) {
        sum += value;
        ++count;
      }
    return count > known * static_cast<double>(rows) ? sum / count : no_value;
  }

  // Adds row steps from the middle of each test; for many tests, from every other one or fewer.
  void add_steps() {
    Index all = 0;
    for (const Test& test : tests_)
      all += std::min(test.rows, rows_of_test);
    const std::size_t every = static_cast<std::size_t>(1 + all / steps_of_campaign);
    for (std::size_t t = 0; t < tests_.size(); t += every) {
      if (tests_[t].rows < 3) continue;
      const Index rows = std::min(tests_[t].rows, rows_of_test);
      const Index first = tests_[t].first + (tests_[t].rows - rows) / 2;
      for (Index i = 0; i + 1 < rows; ++i)
        steps_.push_back(first + i);
    }
  }

  VectorXd steps_of_blocks(const VectorXd& x) const {
    std::vector<double> out;
    for (const Test& test : tests_) {
      if (test.rows < rows_for_blocks) continue;
      double before = no_value;
      for (Index b = 0; b < piece_count; ++b) {
        const Index begin = b * test.rows / piece_count, end = (b + 1) * test.rows / piece_count;
        const double now = mean(x, test.first + begin, end - begin, 0.5);
        if (b > 0) out.push_back(now - before);
        before = now;
      }
    }
    return Eigen::Map<const VectorXd>(out.data(), static_cast<Index>(out.size()));
  }

  std::span<const Dataset* const> parts_;
  std::vector<Test> tests_;
  std::vector<Index> steps_; // row before each step
  Index rows_ = 0, rows_of_test_ = most_rows_of_test;
};

// Residuals of a regression on the states, over the places where everything is known.
class Rest {
public:
  // `constant`: fits an intercept, for values; not for differences.
  Rest(std::vector<Index> at, const std::vector<const VectorXd*>& states, bool constant)
      : at_(std::move(at)) {
    std::vector<VectorXd> columns;
    if (constant) columns.push_back(VectorXd::Ones(count()));
    for (const VectorXd* state : states) {
      const VectorXd x = (*state)(at_);
      const double spread = spread_of(x);
      if (spread > 1e-9 * (1 + std::abs(x.mean())))
        columns.push_back((x.array() - (constant ? x.mean() : 0)) / spread);
    }
    for (const VectorXd& column : columns)
      add(column);
  }

  VectorXd of(const VectorXd& x) const {
    const VectorXd y = x(at_);
    if (basis_.cols() == 0) return y;
    return y - basis_ * (basis_.transpose() * y);
  }
  Index count() const { return static_cast<Index>(at_.size()); }
  Index states() const { return basis_.cols(); }

private:
  // Adds a column unless it is a combination of the present ones.
  void add(const VectorXd& column) {
    VectorXd x = column;
    for (int twice = 0; twice < 2; ++twice)
      x -= basis_ * (basis_.transpose() * x);
    if (!(x.norm() > 1e-8 * column.norm())) return;
    basis_.conservativeResize(count(), basis_.cols() + 1);
    basis_.col(basis_.cols() - 1) = x.normalized();
  }

  std::vector<Index> at_;
  MatrixXd basis_ = MatrixXd(count(), 0);
};

struct Recorded {
  std::string name;
  std::string column; // source column: if this is a rate, the sum it was taken from
  VectorXd values;
  std::array<VectorXd, 3> logarithms;
  bool inside = false;
  bool is_reading = true; // else a factor only
  double step = 0;        // of values that tests share, over their median
};

struct Best {
  double share = infinite;
  std::string how;
};

class Finder {
public:
  Finder(std::span<const Dataset* const> parts, const std::set<std::string>& known,
         const std::set<std::string>& of_states)
      : cut_(parts), tau_(cut_.values("tau_R_MPa").cwiseAbs()) {
    read_states(*parts.front());
    log_tau_ = logarithm(tau_, floor_share_tau);
    tau_levels_ = cut_.levels(log_tau_);
    const double usual = upper_median({tau_.data(), tau_.data() + tau_.size()});
    step_MPa_ = resolution(tau_);
    digit_ = std::max(step_MPa_ / (3.5 * usual), 1e-9);
    tau_steps_ = cut_.steps(tau_);
    for (const VectorXd& x : state_values_)
      state_steps_.push_back(cut_.steps(x));
    make_formulas();
    make_targets();
    for (std::size_t level = 0; level < 3; ++level)
      screened_[level] = thinned(whole_[level] = places(level));
    for (const Column& column : parts.front()->columns)
      if (!find_quantity(column.name) && !known.count(column.name) && column.name != origin_column)
        read(column, of_states.count(column.name) == 0);
  }

  std::map<std::string, Disguise> run() {
    std::vector<Best> best(recorded_.size());
    parallel_for(recorded_.size(), [&](std::size_t c) { best[c] = alone(c); });
    std::vector<Best> paired = best;
    if (recorded_.size() <= most_in_pairs)
      parallel_for(recorded_.size(), [&](std::size_t c) { paired[c] = with_another(c, best); });
    std::map<std::string, Disguise> found;
    std::vector<std::optional<Disguise>> verdicts(recorded_.size());
    parallel_for(recorded_.size(), [&](std::size_t c) {
      if (recorded_[c].is_reading) verdicts[c] = verdict(c, paired[c]);
    });
    for (std::size_t c = 0; c < recorded_.size(); ++c)
      if (verdicts[c] && !found[recorded_[c].column].sure)
        found[recorded_[c].column] = *verdicts[c];
    return found;
  }

private:
  void read_states(const Dataset& data) {
    for (const Quantity& quantity : quantities()) {
      const std::string& name = quantity.name;
      const bool state = quantity.state || name == "F_N_N" || name == "T_tool_C";
      if (!data.has(name) || !state || name == "s_mm" || name == "sigma_f_MPa") continue;
      const VectorXd values = cut_.values(name);
      const bool linear = name == "T_contact_C" || name == "T_tool_C";
      states_.push_back(
          cut_.levels(linear ? VectorXd(values / 100) : logarithm(values, floor_share)));
      state_values_.push_back(values);
      if (name == "sigma_n_MPa") pressure_ = values;
      if (name == "sigma_n_MPa" || name == "F_N_N" || name == "v_rel_mm_s")
        add_power(name, logarithm(values, floor_share));
    }
    if (data.has("sigma_f_MPa")) flow_stress_ = cut_.values("sigma_f_MPa");
    for (const char* name : {"time_s", "s_mm"})
      if (data.has(name)) clocks_.emplace_back(name, cut_.values(name));
  }

  // Adds a factor of formulas, unless it is a constant multiple of another one.
  void add_power(const std::string& name, VectorXd logarithms) {
    const auto varies = [](const VectorXd& x) {
      const VectorXd known = x.array().isFinite().select(x, 0);
      return x.allFinite() ? spread_of(known) > 1e-6 : true;
    };
    if (!varies(logarithms)) return;
    for (const auto& [other, of_other] : powers_)
      if (!varies(logarithms - of_other)) return;
    powers_.emplace_back(name, std::move(logarithms));
  }

  void read(const Column& column, bool may_be_called) {
    Recorded one{column.name, column.name, cut_.values(column.name), {}, false};
    const auto known = (one.values.array().isFinite()).count();
    if (static_cast<double>(known) < 0.5 * static_cast<double>(cut_.rows())) return;
    one.is_reading = is_reading(one) && may_be_called;
    // Text without numbers: level indices have no meaning.
    if (!one.is_reading && !column.levels.empty()) return;
    one.logarithms = cut_.levels(logarithm(one.values, floor_share));
    one.step = shared_step(one);
    one.is_reading = one.is_reading && std::isfinite(one.step);
    const VectorXd values = one.values;
    const bool called = one.is_reading;
    recorded_.push_back(std::move(one));
    if (called && is_sum(values))
      for (const auto& [clock, along] : clocks_) {
        Recorded rate{fmt::format("d {}/d {}", column.name, clock), column.name, {}, {}, true};
        rate.logarithms = cut_.levels(logarithm(cut_.rate(values, along), floor_share));
        recorded_.push_back(std::move(rate));
      }
  }

  // True if equal tests may differ in it: it varies within tests, or most tests have a value of
  // their own.
  bool is_reading(Recorded& one) const {
    const VectorXd means = cut_.means_of_tests(one.values);
    std::set<double> different;
    for (const double value : means)
      if (is_known(value)) different.insert(value);
    const auto count = static_cast<double>(different.size());
    const double tests = static_cast<double>(cut_.tests());
    if (cut_.rows() == cut_.tests()) return count >= std::min(0.3 * tests, 12.0) && count >= 4;
    const VectorXd spreads = cut_.spreads_in_tests(one.values);
    const double largest = one.values.cwiseAbs().maxCoeff<Eigen::PropagateNumbers>();
    one.inside = upper_median({spreads.data(), spreads.data() + spreads.size()}) > 1e-9 * largest;
    return one.inside || (count > 0.5 * tests && count >= 4);
  }

  // Step in which shared values of tests are written; infinite if the values are so few that they
  // were set; 0 if tests do not share values.
  double shared_step(const Recorded& one) const {
    if (one.inside) return 0;
    std::map<double, std::size_t> tests_of;
    for (const double value : cut_.means_of_tests(one.values))
      if (is_known(value)) ++tests_of[value];
    std::size_t tests = 0, shared = 0;
    std::vector<double> values;
    for (const auto& [value, count] : tests_of) {
      values.push_back(value);
      tests += count;
      if (count > 1) shared += count;
    }
    if (static_cast<double>(shared) < shared_values * static_cast<double>(tests)) return 0;
    return tests_of.size() < few_levels ? infinite : written_step(values);
  }

  // True if tests with the same value differ in friction by more than the value's digits can hide:
  // then it is a dose that drives friction, not a reading. (Rounding causes less than a third of a
  // step.)
  static bool is_set_again(const Recorded& one, std::size_t level, const VectorXd& apart) {
    return level == 2 && one.step > 0 && spread_of(apart) > one.step;
  }

  // True if the values only grow or only fall within tests: a sum, a work.
  bool is_sum(const VectorXd& values) const {
    const VectorXd steps = cut_.steps(values);
    if (steps.size() < 100) return false;
    const auto share = [&](auto sign) {
      return static_cast<double>(sign.count()) / static_cast<double>(steps.size());
    };
    const bool one_way = std::max(share(steps.array() >= 0), share(steps.array() <= 0)) > 0.98;
    return one_way && spread_of(steps) > 1e-3 * std::abs(steps.mean());
  }

  // Places at which a level has y and the states.
  std::vector<Index> places(std::size_t level) const {
    std::vector<Index> at;
    const VectorXd& y = tau_levels_[level];
    const std::vector<const VectorXd*> states = states_of(level);
    for (Index i = 0; i < y.size(); ++i)
      if (is_known(y[i]) && std::all_of(states.begin(), states.end(),
                                        [i](const VectorXd* s) { return is_known((*s)[i]); }))
        at.push_back(i);
    return at;
  }

  static bool mostly_known(const VectorXd& x) {
    return static_cast<double>(x.array().isFinite().count()) > 0.7 * static_cast<double>(x.size());
  }

  std::vector<const VectorXd*> states_of(std::size_t level) const {
    std::vector<const VectorXd*> out;
    for (const auto& state : states_)
      if (mostly_known(state[level])) out.push_back(&state[level]);
    return out;
  }

  // True if a level has enough places, and residuals of y larger than its last digit.
  bool says_something(std::size_t level, const Rest& rest, const VectorXd& y) const {
    const auto all = static_cast<double>(whole_[level].size());
    const bool many = rest.count() >= least_of_level[level] &&
                      rest.count() >= 3 * rest.states() + 6 &&
                      static_cast<double>(rest.count()) >= 0.5 * all;
    if (!many) return false;
    const double rows = static_cast<double>(cut_.rows()) / static_cast<double>(cut_.tests());
    const double digit = level == 2 ? digit_ / std::sqrt(std::max(rows / 2, 1.0)) : digit_;
    return spread_of(y) >= 3 * digit;
  }

  static double of_freedom(const Rest& rest) {
    const auto n = static_cast<double>(rest.count());
    return n / std::max(1.0, n - static_cast<double>(rest.states()));
  }

  Best alone(std::size_t c) const {
    const Recorded& one = recorded_[c];
    Best best;
    if (!one.is_reading) return best;
    double finest = infinite; // share on the finest level that says_something()
    for (std::size_t level = 0; level < 3; ++level) {
      std::vector<Index> at = known_of(whole_[level], level, one, one);
      if (static_cast<Index>(at.size()) < least_of_level[level]) continue;
      const Rest rest(std::move(at), states_of(level), level == 2);
      const VectorXd y = rest.of(tau_levels_[level]), z = rest.of(one.logarithms[level]);
      if (!says_something(level, rest, y)) continue;
      for (const double sign : {1.0, -1.0}) {
        const double share = share_left(y, sign * z) * of_freedom(rest);
        if (share < best.share && !is_set_again(one, level, y - sign * z))
          best = {share, text_of(one.name, sign, "", 0, share)};
      }
      if (!std::isfinite(finest)) finest = best.share;
    }
    // A column with its own scatter from row to row is not a copy, even if its means over tests are
    // close.
    if (one.inside && finest > own_scatter) best.share = std::max(best.share, sure_share);
    return best;
  }

  static std::string text_of(const std::string& name, double sign, const std::string& factor,
                             double sign_of_factor, double share) {
    return fmt::format("tau_R_MPa goes as {}{}{}{} in addition to the states ({:.2g} % or less of "
                       "what they leave is "
                       "left)",
                       sign > 0 ? "" : "1/", name,
                       factor.empty()       ? ""
                       : sign_of_factor > 0 ? "*"
                                            : "/",
                       factor, std::max(100 * share, 0.01));
  }

  // True if c is the reading and w only a factor of it (a radius, an area).
  bool is_the_reading(std::size_t c, std::size_t w, const std::vector<Best>& best) const {
    const Recorded &one = recorded_[c], &other = recorded_[w];
    if (!other.is_reading) return true;
    if (one.inside != other.inside) return one.inside;
    return best[c].share <= best[w].share;
  }

  Best with_another(std::size_t c, const std::vector<Best>& alone) const {
    Best best = alone[c];
    if (best.share < sure_share) return best;
    // Below ask_share it may be a copy with scatter, which no factor improves.
    if (best.share < ask_share || !recorded_[c].is_reading) return best;
    for (std::size_t w = 0; w < recorded_.size(); ++w) {
      if (w == c || alone[w].share < ask_share || !is_the_reading(c, w, alone)) continue;
      for (std::size_t level = 0; level < 3; ++level)
        look_at_pair(c, w, level, best);
    }
    return best;
  }

  void look_at_pair(std::size_t c, std::size_t w, std::size_t level, Best& best) const {
    const Recorded &one = recorded_[c], &other = recorded_[w];
    const auto share = [&](const Rest& rest, double e, double f) {
      const VectorXd z = e * one.logarithms[level] + f * other.logarithms[level];
      return share_left(rest.of(tau_levels_[level]), rest.of(z)) * of_freedom(rest);
    };
    std::vector<Index> some = known_of(screened_[level], level, one, other);
    if (static_cast<Index>(some.size()) < least_of_level[level]) return;
    const Rest few(std::move(some), states_of(level), level == 2);
    for (const double e : {1.0, -1.0})
      for (const double f : {1.0, -1.0}) {
        if (share(few, e, f) > 2 * sure_share) continue;
        const Rest all(known_of(whole_[level], level, one, other), states_of(level), level == 2);
        if (!says_something(level, all, all.of(tau_levels_[level]))) return;
        const double left = share(all, e, f);
        const VectorXd apart = all.of(tau_levels_[level]) -
                               all.of(e * one.logarithms[level] + f * other.logarithms[level]);
        if (left > of_factor * share(all, 0, f) || // the factor alone explains it: a cause
            is_set_again(one, level, apart))
          continue;
        if (left < std::min(best.share, sure_share))
          best = {left, text_of(one.name, e, other.name, f, left)};
      }
  }

  static std::vector<Index> known_of(const std::vector<Index>& at, std::size_t level,
                                     const Recorded& a, const Recorded& b) {
    std::vector<Index> known;
    for (const Index i : at)
      if (is_known(a.logarithms[level][i]) && is_known(b.logarithms[level][i])) known.push_back(i);
    return known;
  }

  static std::vector<Index> thinned(const std::vector<Index>& at) {
    const std::size_t every = 1 + at.size() / static_cast<std::size_t>(to_screen);
    std::vector<Index> few;
    for (std::size_t i = 0; i < at.size(); i += every)
      few.push_back(at[i]);
    return few;
  }

  std::optional<Disguise> verdict(std::size_t c, const Best& best) const {
    const Recorded& one = recorded_[c];
    if (one.values.size() > 0) {
      if (const Best formula = direct(one); formula.share < sure_direct)
        return Disguise{true, formula.how};
      if (best.share >= sure_share)
        if (const std::string how = function_of(one); !how.empty()) return Disguise{true, how};
    }
    if (best.share < sure_share) return Disguise{true, best.how};
    const Best copy = one.values.size() > 0 ? linear(one) : Best{};
    if (copy.share < 1 - sure_linear) return Disguise{true, copy.how};
    if (best.share < ask_share) return Disguise{false, best.how};
    if (copy.share < 1 - ask_linear) return Disguise{false, copy.how};
    return std::nullopt;
  }

  // Mean square about the median; infinite for too few values.
  static double about_middle(const VectorXd& x) {
    std::vector<double> known;
    for (const double value : x)
      if (is_known(value)) known.push_back(value);
    if (static_cast<Index>(known.size()) < least_direct) return infinite;
    const double centre = upper_median(known);
    return trimmed_mean_square(
        Eigen::Map<const VectorXd>(known.data(), static_cast<Index>(known.size())).array() -
        centre);
  }

  // Formulas are tau times powers -1, 0 or 1 of pressure, load and speed; of_states_ is the least
  // mean square of their logarithms about the median.
  void make_formulas() {
    formulas_ = {{log_tau_, ""}};
    for (const auto& [name, x] : powers_)
      for (std::size_t i = 0, count = formulas_.size(); i < count; ++i) {
        const auto [y, text] = formulas_[i];
        formulas_.emplace_back(y - x, text + " * " + name);
        formulas_.emplace_back(y + x, text + "/" + name);
      }
    for (const auto& [y, text] : formulas_)
      of_states_ = std::min(of_states_, about_middle(y));
  }

  // Compares without a fit, so a dozen rows are enough.
  Best direct(const Recorded& one) const {
    const VectorXd z = logarithm(one.values, floor_share);
    Best best;
    if (!(of_states_ >= 1e-7) || !std::isfinite(of_states_)) return best; // no residual to explain
    for (const auto& [y, text] : formulas_)
      for (const double sign : {1.0, -1.0}) {
        const VectorXd rest = y - sign * z;
        if (static_cast<double>(rest.array().isFinite().count()) <
            0.7 * static_cast<double>(rest.size()))
          continue;
        if (const double share = about_middle(rest) / of_states_; share < best.share)
          best = {share, fmt::format("tau_R_MPa = constant {} {}{}", sign > 0 ? "*" : "/", one.name,
                                     text)};
      }
    return best;
  }

  VectorXd compared_ranks(const VectorXd& x) const {
    const VectorXd some = x(compared_);
    return some.allFinite() ? ranks(some) : VectorXd();
  }

  static bool goes_with(const VectorXd& a, const VectorXd& b, double limit) {
    return a.size() > 0 && squared_correlation(a, b) > limit * limit;
  }

  // Targets are tau, mu and the friction factor, unless they are monotone functions of a state.
  void make_targets() {
    for (Index i = 0; i < cut_.rows(); i += 1 + cut_.rows() / rows_to_rank)
      compared_.push_back(i);
    const auto add = [&](const char* what, const VectorXd& values) {
      const VectorXd target = compared_ranks(values);
      if (target.size() == 0) return;
      const bool is_of_state =
          std::any_of(state_values_.begin(), state_values_.end(), [&](const VectorXd& x) {
            return goes_with(compared_ranks(x.cwiseAbs()), target, state_rank);
          });
      if (!is_of_state) targets_.emplace_back(what, target);
    };
    add("tau_R_MPa", tau_);
    if (pressure_.size() > 0)
      add("tau_R_MPa/sigma_n_MPa", tau_.cwiseQuotient(pressure_.cwiseAbs()));
    if (flow_stress_.size() > 0)
      add("tau_R_MPa/sigma_f_MPa", tau_.cwiseQuotient(flow_stress_.cwiseAbs()));
  }

  std::string function_of(const Recorded& one) const {
    if (one.values.size() < least_rank || !one.values.allFinite()) return "";
    const VectorXd own = compared_ranks(one.values), size = compared_ranks(one.values.cwiseAbs());
    for (const auto& [what, target] : targets_)
      if (goes_with(own, target, sure_rank) || goes_with(size, target, sure_rank))
        return fmt::format("{} is a function of {} alone", what, one.name);
    return "";
  }

  // Finds a copy with another zero by its scatter from row to row.
  Best linear(const Recorded& one) const {
    Best best;
    const auto look_at = [&](const VectorXd& x, const char* what) {
      const VectorXd z = cut_.steps(x);
      std::vector<Index> at;
      for (Index i = 0; i < z.size(); ++i)
        if (is_known(z[i]) && is_known(tau_steps_[i]) &&
            std::all_of(state_steps_.begin(), state_steps_.end(),
                        [i](const VectorXd& s) { return is_known(s[i]); }))
          at.push_back(i);
      if (static_cast<Index>(at.size()) < least_linear) return;
      std::vector<const VectorXd*> states;
      for (const VectorXd& s : state_steps_)
        states.push_back(&s);
      const Rest rest(std::move(at), states, false);
      VectorXd of_y = rest.of(tau_steps_), of_z = rest.of(z);
      if (spread_of(of_y) < 3 * step_MPa_) return;
      trim(of_y, of_z);
      const double left = 1 - squared_correlation(of_y, of_z);
      if (left < best.share)
        best = {left, fmt::format("tau_R_MPa follows {}{} from row to row (R2 = {:.3f})", one.name,
                                  what, 1 - left)};
    };
    look_at(one.values, "");
    look_at(one.values.cwiseAbs(), "");
    if (pressure_.size() > 0) look_at(one.values.cwiseProduct(pressure_), " * sigma_n_MPa");
    return best;
  }

  // Removes the places with the largest y.
  static void trim(VectorXd& y, VectorXd& z) {
    std::vector<double> sizes(static_cast<std::size_t>(y.size()));
    for (std::size_t i = 0; i < sizes.size(); ++i)
      sizes[i] = std::abs(y[static_cast<Index>(i)]);
    const auto at = sizes.begin() + static_cast<long>(0.98 * static_cast<double>(sizes.size()));
    std::nth_element(sizes.begin(), at, sizes.end());
    std::vector<Index> keep;
    for (Index i = 0; i < y.size(); ++i)
      if (std::abs(y[i]) <= *at) keep.push_back(i);
    y = VectorXd(y(keep));
    z = VectorXd(z(keep));
  }

  Cut cut_;
  VectorXd tau_, log_tau_, pressure_, flow_stress_;
  std::array<VectorXd, 3> tau_levels_;
  double step_MPa_ = 0, digit_ = 0; // of the last digit; the same for the logarithm
  std::vector<std::array<VectorXd, 3>> states_;
  std::vector<VectorXd> state_values_, state_steps_;
  VectorXd tau_steps_;
  std::vector<std::pair<VectorXd, std::string>> formulas_; // logarithms
  double of_states_ = infinite;
  std::vector<Index> compared_; // rows used to compare ranks
  std::vector<std::pair<const char*, VectorXd>> targets_;
  std::vector<std::pair<std::string, VectorXd>> powers_, clocks_;
  std::array<std::vector<Index>, 3> whole_, screened_;
  std::vector<Recorded> recorded_;
};

} // namespace

std::map<std::string, Disguise> find_disguises(std::span<const Dataset* const> parts,
                                               const std::set<std::string>& known,
                                               const std::set<std::string>& of_states) {
  return Finder(parts, known, of_states).run();
}

} // namespace frictab::data
