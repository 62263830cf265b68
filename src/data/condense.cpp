// Cuts experiments into blocks, and reads their rows again.
#include "data/condense.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"
#include "core/no_value.h"
#include "core/text.h"
#include "data/append.h"
#include "data/derived.h"
#include "data/recordings.h"
#include "data/signs.h"

namespace frictab::data {

RatioSum ratio_sum(std::span<const double> above, std::span<const double> below) {
  RatioSum ratio;
  for (std::size_t i = 0; i < above.size(); ++i)
    if (below[i] > 0) {
      ratio.sum += above[i] / below[i];
      ++ratio.rows;
    }
  return ratio;
}

namespace {

using Values = std::span<const double>;

// Rows at which a new block has to begin.
class Borders {
public:
  explicit Borders(const Dataset& data) : pressure_(data.values("sigma_n_MPa")) {
    for (const Column& column : data.columns)
      if (!column.levels.empty() || column.name == direction_column)
        texts_.push_back(column.values);
  }
  bool at(std::size_t i) const {
    if ((pressure_[i] > 0) != (pressure_[i - 1] > 0)) return true;
    return std::any_of(texts_.begin(), texts_.end(),
                       [&](Values text) { return text[i] != text[i - 1]; });
  }

private:
  Values pressure_;
  std::vector<Values> texts_;
};

// Offsets from an experiment's first row at which its short first blocks end: 1, 2, ... 16, 18, ...
// 32, 36, .... A block covers at most an eighth of the rows before it, until that reaches the usual
// block size.
std::set<std::size_t> cuts_of_start(std::size_t usual_rows) {
  constexpr std::size_t of_an_octave = 8;
  std::set<std::size_t> cuts;
  for (std::size_t step = 1, at = 1; step < usual_rows; step *= 2)
    for (; at < 2 * of_an_octave * step; at += step)
      cuts.insert(at);
  return cuts;
}

// First row of each block of [begin, end).
std::vector<std::size_t> cuts_of(const Borders& borders, std::size_t begin, std::size_t end,
                                 std::size_t blocks) {
  const std::size_t rows = end - begin, count = std::min(rows, blocks);
  const std::set<std::size_t> start = cuts_of_start(rows / count);
  std::vector<std::size_t> cuts;
  std::size_t next = 0; // index of the next block of equal size
  for (std::size_t i = begin; i < end; ++i) {
    const bool due = i == begin + next * rows / count;
    if (due && next + 1 < count) ++next;
    if (i == begin || due || borders.at(i) || start.count(i - begin) > 0) cuts.push_back(i);
  }
  return cuts;
}

// Mean of the cells that have a value.
double mean_of_cells(Values values) {
  double sum = 0, count = 0;
  for (const double x : values)
    if (!std::isnan(x)) {
      sum += x;
      ++count;
    }
  return count > 0 ? sum / count : no_value;
}

double squares_about(Values values, double mean) {
  double sum = 0;
  for (const double x : values)
    sum += (x - mean) * (x - mean);
  return sum;
}

std::pair<double, double> ends_of(Values values) {
  std::pair<double, double> span{no_value, no_value};
  for (const double x : values) {
    if (std::isnan(x)) continue;
    if (!(span.first <= x)) span.first = x;
    if (!(span.second >= x)) span.second = x;
  }
  return span;
}

// Condenses all experiments of a dataset.
class Condenser {
public:
  Condenser(const Dataset& rows, std::size_t blocks) : rows_(rows) {
    const Borders borders(rows);
    for (std::size_t e = 0; e < rows.experiments.size(); ++e) {
      const auto cuts = cuts_of(borders, rows.first_row[e], rows.first_row[e + 1], blocks);
      first_.insert(first_.end(), cuts.begin(), cuts.end());
      first_block_.push_back(first_.size());
    }
    first_.push_back(rows.rows());
  }

  Dataset held(const std::shared_ptr<const RowSource>& source) {
    out_.experiments = rows_.experiments;
    out_.filed = rows_.filed;
    out_.first_row = first_block_;
    out_.sources = rows_.sources;
    out_.files = rows_.files;
    out_.file_of = rows_.file_of;
    out_.assumed = rows_.assumed;
    absorb(out_, rows_);
    out_.aside.reset(); // stroke plots of blocks omit these rows
    out_.clocks = rows_.clocks;
    out_.condensed.emplace();
    add_experiments(source);
    add_weights();
    for (const Column& column : rows_.columns) {
      out_.columns.push_back(
          {column.name, column.unit, means(column), column.levels, column.role, column.why});
      if (column.levels.empty()) add_spans(column);
    }
    for (const DerivedQuantity& quantity : derived_quantities())
      add_history(quantity);
    fingerprint(out_);
    return std::move(out_);
  }

private:
  Values block(Values values, std::size_t b) const {
    return values.subspan(first_[b], first_[b + 1] - first_[b]);
  }
  Values experiment(Values values, std::size_t e) const {
    return values.subspan(rows_.first_row[e], rows_.first_row[e + 1] - rows_.first_row[e]);
  }
  std::size_t blocks() const { return first_.size() - 1; }

  // Text columns need no mean, because a block contains a single level.
  std::vector<double> means(const Column& column) const {
    std::vector<double> out;
    for (std::size_t b = 0; b < blocks(); ++b)
      out.push_back(column.levels.empty() ? mean_of_cells(block(column.values, b))
                                          : column.values[first_[b]]);
    return out;
  }

  void add_experiments(const std::shared_ptr<const RowSource>& source) {
    const Values tau = rows_.values("tau_R_MPa");
    for (std::size_t e = 0; e < rows_.experiments.size(); ++e) {
      RowsOfExperiment one;
      one.source = source;
      one.name = rows_.experiments[e];
      one.rows = rows_.first_row[e + 1] - rows_.first_row[e];
      const auto over = [&](const char* name) {
        return ratio_sum(experiment(tau, e), experiment(rows_.values(name), e));
      };
      one.over_pressure = over("sigma_n_MPa");
      if (rows_.has("sigma_f_MPa")) one.over_flow = over("sigma_f_MPa");
      out_.condensed->experiments.push_back(std::move(one));
    }
  }

  void add_weights() {
    const Values tau = rows_.values("tau_R_MPa");
    for (std::size_t b = 0; b < blocks(); ++b) {
      const Values own = block(tau, b);
      out_.condensed->rows.push_back(static_cast<double>(own.size()));
      out_.condensed->within_MPa2.push_back(squares_about(own, mean_of_cells(own)));
    }
  }

  void add_spans(const Column& column) {
    for (std::size_t e = 0; e < rows_.experiments.size(); ++e)
      out_.condensed->experiments[e].spans[column.name] = ends_of(experiment(column.values, e));
  }

  // Histories of a law's own stress are derived later, with the law.
  void add_history(const DerivedQuantity& quantity) {
    for (const std::string& need : quantity.needs)
      if (!rows_.has(need)) return;
    const Column history{quantity.name, quantity.unit, derive(quantity, rows_, {}), {}};
    out_.condensed->histories.push_back({history.name, history.unit, means(history), {}});
    add_spans(history);
  }

  const Dataset& rows_;
  std::vector<std::size_t> first_;          // row of each block, and the end
  std::vector<std::size_t> first_block_{0}; // of each experiment, and the end
  Dataset out_;
};

} // namespace

Dataset condense(const Dataset& rows, std::size_t blocks,
                 const std::shared_ptr<const RowSource>& source) {
  return Condenser(rows, std::max<std::size_t>(blocks, 1)).held(source);
}

namespace {

void check_same(const Dataset& data, std::size_t experiment, std::size_t rows) {
  if (rows == data.source_rows(experiment)) return;
  throw InputError({join(data.sources, ", "), 0, 0},
                   fmt::format("experiment '{}' had {} rows when it was condensed, and has {} now",
                               data.experiments[experiment],
                               thousands(data.source_rows(experiment)), thousands(rows)),
                   "the files were changed while they were read: run again when they are complete");
}

// Adds the columns that need all tests together (data/recordings.h).
Dataset with_recording(const Dataset& one, const Dataset& data, std::size_t experiment) {
  Dataset more = one;
  for (const char* name : {interval_column, recording_column})
    if (const Column* column = data.find(name); column && !one.has(name)) {
      more.columns.push_back(*column);
      more.columns.back().values.assign(one.rows(), column->values[data.first_row[experiment]]);
    }
  return more;
}

} // namespace

void read_again(std::span<const Dataset* const> all, const TakeRows& take) {
  using Place = std::pair<std::size_t, std::size_t>; // dataset, experiment
  std::map<const RowSource*, std::multimap<std::string, Place>> asked;
  std::vector<const RowSource*> order; // order of first use, independent of addresses
  for (std::size_t d = 0; d < all.size(); ++d) {
    if (!all[d]->condensed) throw std::logic_error("rows that are held are not read again");
    for (std::size_t e = 0; e < all[d]->experiments.size(); ++e) {
      const RowsOfExperiment& one = all[d]->condensed->experiments[e];
      if (asked.find(one.source.get()) == asked.end()) order.push_back(one.source.get());
      asked[one.source.get()].emplace(one.name, Place{d, e});
    }
  }
  std::vector<std::vector<char>> seen;
  for (const Dataset* data : all)
    seen.emplace_back(data->experiments.size(), 0);
  for (const RowSource* source : order) {
    const auto& places = asked.at(source);
    source->read([&](const Dataset& one) {
      const auto [begin, end] = places.equal_range(one.experiments.front());
      for (auto place = begin; place != end; ++place) {
        const auto [d, e] = place->second;
        check_same(*all[d], e, one.rows());
        if (all[d]->recording.empty())
          take(d, e, one);
        else
          take(d, e, with_recording(one, *all[d], e));
        seen[d][e] = 1;
      }
    });
  }
  for (std::size_t d = 0; d < all.size(); ++d)
    for (std::size_t e = 0; e < seen[d].size(); ++e)
      if (!seen[d][e]) check_same(*all[d], e, 0);
}

std::pair<double, double> source_range(const Dataset& data, const std::string& name,
                                       std::span<const double> held) {
  if (!data.condensed) return ends_of(held);
  std::vector<double> ends;
  for (const RowsOfExperiment& one : data.condensed->experiments)
    if (const auto known = one.spans.find(name); known != one.spans.end())
      ends.insert(ends.end(), {known->second.first, known->second.second});
  return ends.empty() ? ends_of(held) : ends_of(ends);
}

} // namespace frictab::data
