// Brings two clocks of one test together.
#include "data/join.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "data/quantity.h"

namespace frictab::data {

namespace {

// Position in an ascending clock: the row at or before `at`, and the share of the step to the next
// one; none beyond the ends. For ascending times the search continues from the last row.
class Position {
public:
  explicit Position(std::span<const double> clock) : clock_(clock) {}

  bool find(double at) {
    if (clock_.empty() || !(at >= clock_.front()) || !(at <= clock_.back())) return false;
    if (clock_[row] > at) row = 0;
    while (row + 1 < clock_.size() && clock_[row + 1] <= at)
      ++row;
    const bool last = row + 1 == clock_.size();
    share = last ? 0 : (at - clock_[row]) / (clock_[row + 1] - clock_[row]);
    return true;
  }
  double value(std::span<const double> y) const {
    return share == 0 ? y[row] : y[row] + share * (y[row + 1] - y[row]);
  }

  std::size_t row = 0;
  double share = 0;

private:
  std::span<const double> clock_;
};

// ---- the offset ----

class Agreement {
public:
  Agreement(const std::vector<double>& t_first, const std::vector<double>& x,
            const std::vector<double>& t_second, const std::vector<double>& y)
      : t1_(t_first), x_(x), t2_(t_second), y_(y) {
    const double shorter = std::min(t1_.back() - t1_.front(), t2_.back() - t2_.front());
    least_span_ = 0.5 * shorter;
    lowest = t1_.front() - t2_.back() + least_span_;
    highest = t1_.back() - t2_.front() - least_span_;
  }

  // Correlation without the rows of one piece of 8 (`without` = 8: all rows); 0 if too little is
  // shared. `rows`: receives the number of rows used.
  double correlation(double offset, std::size_t without = pieces, std::size_t stride = 1,
                     double* rows = nullptr) const {
    Position at(t2_);
    double n = 0, mx = 0, my = 0, sxx = 0, sxy = 0, syy = 0; // running means and products
    double begin = no_value, end = no_value;
    for (std::size_t i = 0; i < t1_.size(); i += stride) {
      if (!at.find(t1_[i] - offset)) continue;
      if (std::isnan(begin)) begin = t1_[i];
      end = t1_[i];
      if (i * pieces / t1_.size() == without) continue;
      const double y = at.value(y_), dx = x_[i] - mx, dy = y - my;
      if (!std::isfinite(dx) || !std::isfinite(dy)) continue; // an empty cell, reported elsewhere
      n += 1;
      mx += dx / n;
      my += dy / n;
      sxx += dx * (x_[i] - mx);
      syy += dy * (y - my);
      sxy += dx * (y - my);
    }
    const bool enough = n >= 4 && end - begin >= 0.99 * least_span_ && sxx > 0 && syy > 0;
    if (rows) *rows = n;
    return enough ? sxy / std::sqrt(sxx * syy) : 0;
  }

  // Likelihood ratio of a straight line between the two series: at equal correlation, more shared
  // rows give stronger evidence.
  double evidence(double offset, std::size_t stride) const {
    double rows = 0;
    const double r = correlation(offset, pieces, stride, &rows);
    return r > 0 ? -0.5 * rows * std::log1p(-std::min(r * r, 1 - 1e-12)) : 0;
  }

  // Golden-section search between two offsets.
  double best_between(double low, double high, std::size_t without = pieces) const {
    const double golden = 0.5 * (std::sqrt(5.0) - 1);
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = correlation(a, without), at_b = correlation(b, without);
    for (int i = 0; i < 40; ++i)
      if (at_a > at_b) {
        high = b;
        b = a;
        at_b = at_a;
        a = high - golden * (high - low);
        at_a = correlation(a, without);
      } else {
        low = a;
        a = b;
        at_a = at_b;
        b = low + golden * (high - low);
        at_b = correlation(b, without);
      }
    return 0.5 * (low + high);
  }

  static constexpr std::size_t pieces = 8;
  double lowest, highest; // offsets with a sufficient overlap

private:
  const std::vector<double>&t1_, &x_, &t2_, &y_;
  double least_span_;
};

// Standard error from leaving out pieces of the common span; valid however the noise is correlated.
double jackknife(const Agreement& agreement, double low, double high, double offset) {
  double sum = 0, squares = 0;
  constexpr double n = Agreement::pieces;
  for (std::size_t piece = 0; piece < Agreement::pieces; ++piece) {
    const double moved = agreement.best_between(low, high, piece) - offset;
    sum += moved;
    squares += moved * moved;
  }
  return std::sqrt(std::max(0.0, (n - 1) / n * (squares - sum * sum / n)));
}

// Shift of the offset without every other row of the second set: the possible error of straight
// lines between its rows.
double thinning_error(const std::vector<double>& t_first, const std::vector<double>& x,
                      const std::vector<double>& t_second, const std::vector<double>& y, double low,
                      double high, double offset) {
  double most = 0;
  for (const std::size_t begin : {0, 1}) {
    std::vector<double> t, thin;
    for (std::size_t i = begin; i < t_second.size(); i += 2) {
      t.push_back(t_second[i]);
      thin.push_back(y[i]);
    }
    if (t.size() < 4) continue;
    const Agreement agreement(t_first, x, t, thin);
    most = std::max(most, std::abs(agreement.best_between(low, high) - offset));
  }
  return most;
}

// ---- the join ----

struct Clocks {
  std::span<const double> first, second; // of one test
};

std::span<const double> rows_of(const Dataset& data, std::size_t e, const Column& column) {
  return {column.values.data() + data.first_row[e], data.first_row[e + 1] - data.first_row[e]};
}

// The column used to find an offset: a force or a path that both have.
const char* common_column(const Part& part, const Dataset& second, const std::string& by) {
  for (const char* name : {"F_N_N", "s_mm"})
    if (name != by && part.data.has(name) && second.has(name)) return name;
  return nullptr;
}

class Join {
public:
  Join(Part& part, const Dataset& second, const JoinOptions& options)
      : part_(part), second_(second), options_(options), rows_(part.data.rows()) {
    for (const Column& column : second.columns) {
      if (column.name == options.by) continue;
      if (part.data.has(column.name)) {
        in_both_.push_back(column.name);
        continue;
      }
      added_.push_back(
          {column.name, column.unit, std::vector<double>(rows_, no_value), column.levels});
      from_.push_back(&column);
    }
  }

  void join() {
    if (!has_clocks()) return;
    keep_.assign(rows_, 0);
    for (std::size_t e = 0; e < part_.data.experiments.size(); ++e)
      join_test(e);
    if (!part_.faults.empty()) return;
    tell();
    for (Column& column : added_)
      part_.data.columns.push_back(std::move(column));
    const auto out = static_cast<std::size_t>(std::count(keep_.begin(), keep_.end(), 0));
    if (out > 0) part_.data.dropped.push_back({"no partner in data.join", out});
    keep_rows(part_, keep_, nullptr); // no fault: other files may have partners
  }

private:
  bool has_clocks() {
    const std::string hint = "map it in [data.columns] and in [data.join.columns]";
    if (!part_.data.has(options_.by))
      part_.faults.add(part_.header(),
                       fmt::format("there is no column {} (data.join.by)", options_.by), hint);
    else if (!second_.has(options_.by))
      part_.faults.add(options_.place,
                       fmt::format("the files of data.join have no column {}", options_.by), hint);
    else if (!options_.offset.value && !common_column(part_, second_, options_.by))
      part_.faults.add(options_.place,
                       "data.join.offset cannot be found: F_N_N and s_mm are not in both",
                       "give the number that is added to the clock of data.join, 0 for none");
    else
      return true;
    return false;
  }

  void join_test(std::size_t e) {
    const auto& names = second_.experiments;
    const std::string& name = part_.data.experiments[e];
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      alone_.push_back(name);
      return;
    }
    const auto partner = static_cast<std::size_t>(found - names.begin());
    const Clocks clocks{rows_of(part_.data, e, *part_.data.find(options_.by)),
                        rows_of(second_, partner, *second_.find(options_.by))};
    if (!ascends(clocks.first, name, part_.raw.file) || !ascends(clocks.second, name, "data.join"))
      return;
    const double offset =
        options_.offset.value ? *options_.offset.value : found_offset(e, partner, clocks);
    const std::size_t first = part_.data.first_row[e];
    Position at(clocks.second);
    for (std::size_t i = 0; i < clocks.first.size(); ++i) {
      if (!at.find(clocks.first[i] - offset)) continue;
      keep_[first + i] = 1;
      for (std::size_t c = 0; c < added_.size(); ++c) {
        const auto values = rows_of(second_, partner, *from_[c]);
        // A text is valid until the next row.
        added_[c].values[first + i] = from_[c]->levels.empty() ? at.value(values) : values[at.row];
      }
    }
  }

  bool ascends(std::span<const double> clock, const std::string& test, const std::string& where) {
    if (std::adjacent_find(clock.begin(), clock.end(),
                           [](double a, double b) { return !(a < b); }) == clock.end())
      return true;
    part_.faults.add(options_.place,
                     fmt::format("{} does not grow from row to row in test '{}' of {}", options_.by,
                                 test, where),
                     options_.by == "s_mm" ? "by = \"time_s\" does not need a path that grows"
                                           : "is this two experiments?");
    return false;
  }

  double found_offset(std::size_t e, std::size_t partner, const Clocks& clocks) {
    const std::string name = common_column(part_, second_, options_.by);
    const auto copy = [](std::span<const double> values) {
      return std::vector<double>(values.begin(), values.end());
    };
    ClockOffset found =
        find_offset(copy(clocks.first), copy(rows_of(part_.data, e, *part_.data.find(name))),
                    copy(clocks.second), copy(rows_of(second_, partner, *second_.find(name))));
    constexpr double least_correlation = 0.5;
    if (!(found.correlation >= least_correlation))
      part_.faults.add(options_.place,
                       fmt::format("data.join.offset cannot be found for test '{}': {} of both "
                                   "sets agrees nowhere (correlation {:.2f} at best)",
                                   part_.data.experiments[e], name, found.correlation),
                       "is it the same test? offset = NUMBER gives it, for all tests");
    found.experiment = part_.data.experiments[e];
    part_.data.clocks.push_back(found);
    return found.offset;
  }

  void tell() {
    std::vector<std::string> names;
    for (const Column& column : added_)
      names.push_back(column.name);
    part_.data.notes.push_back(fmt::format("joined by {}: {}", options_.by, join_names(names)));
    if (!in_both_.empty())
      part_.data.notes.push_back("of data.join not taken, the rows have their own: " +
                                 join_names(in_both_));
    if (!alone_.empty())
      part_.data.notes.push_back("without a partner in data.join: " + join_names(alone_));
  }

  static std::string join_names(const std::vector<std::string>& names) {
    return frictab::join(names, ", ");
  }

  Part& part_;
  const Dataset& second_;
  const JoinOptions& options_;
  std::size_t rows_;
  std::vector<Column> added_;
  std::vector<std::string> in_both_;
  std::vector<const Column*> from_; // source of each added column in the second set
  std::vector<char> keep_;
  std::vector<std::string> alone_;
};

} // namespace

ClockOffset find_offset(const std::vector<double>& t_first, const std::vector<double>& x,
                        const std::vector<double>& t_second, const std::vector<double>& y) {
  ClockOffset found;
  if (t_first.size() < 4 || t_second.size() < 4) return found;
  const Agreement agreement(t_first, x, t_second, y);
  // Coarse steps on at most 1,000 rows, then all rows around the best one.
  constexpr int steps = 2000;
  const std::size_t stride = t_first.size() / 1000 + 1;
  const double step = (agreement.highest - agreement.lowest) / steps;
  double most = 0;
  for (int i = 0; i <= steps; ++i) {
    const double offset = agreement.lowest + i * step,
                 evidence = agreement.evidence(offset, stride);
    if (evidence > most) found.offset = offset;
    most = std::max(most, evidence);
  }
  if (most == 0) return found;
  const double low = found.offset - 2 * step, high = found.offset + 2 * step;
  found.offset = agreement.best_between(low, high);
  found.correlation = agreement.correlation(found.offset);
  found.std_error = std::hypot(jackknife(agreement, low, high, found.offset),
                               thinning_error(t_first, x, t_second, y, low, high, found.offset));
  return found;
}

std::string clocks_text(const std::vector<ClockOffset>& clocks, const JoinOptions& options) {
  if (clocks.empty()) return "";
  const auto by = [](auto member) {
    return [member](const ClockOffset& a, const ClockOffset& b) { return a.*member < b.*member; };
  };
  const auto [low, high] =
      std::minmax_element(clocks.begin(), clocks.end(), by(&ClockOffset::offset));
  const auto worst = std::max_element(clocks.begin(), clocks.end(), by(&ClockOffset::std_error));
  const auto least = std::min_element(clocks.begin(), clocks.end(), by(&ClockOffset::correlation));
  const std::string unit = find_quantity(options.by)->unit;
  return fmt::format(
      "data.join: {} offsets found, {:.4g} to {:.4g} {}, the least certain +- {:.2g} "
      "{} (test {}); correlation {:.3f} at least (test {})",
      clocks.size(), low->offset, high->offset, unit, worst->std_error, unit, worst->experiment,
      least->correlation, least->experiment);
}

void join_clocks(Part& part, const Dataset& second, const JoinOptions& options) {
  Join(part, second, options).join();
}

} // namespace frictab::data
