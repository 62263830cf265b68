// Access to and splitting of a campaign; an experiment is never split.
#include "data/dataset.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "core/error.h"
#include "core/text.h"
#include "data/quantity.h"
#include "data/recordings.h"

namespace frictab::data {

const Column* Dataset::find(std::string_view name) const {
  for (const Column& column : columns)
    if (column.name == name) return &column;
  return nullptr;
}

std::span<const double> Dataset::values(std::string_view name) const {
  const Column* column = find(name);
  if (!column) throw std::logic_error("no column " + std::string(name));
  return column->values;
}

std::size_t Dataset::source_rows() const {
  std::size_t all = 0;
  for (std::size_t e = 0; e < experiments.size(); ++e)
    all += source_rows(e);
  return all;
}

std::size_t Dataset::source_rows(std::size_t experiment) const {
  return condensed ? condensed->experiments[experiment].rows
                   : first_row[experiment + 1] - first_row[experiment];
}

std::optional<std::string> Dataset::level_of_test(const Column& column,
                                                  std::size_t experiment) const {
  const std::size_t first = first_row[experiment];
  const double value = column.values[first];
  for (std::size_t i = first; i < first_row[experiment + 1]; ++i)
    if (column.values[i] != value) return std::nullopt; // also for NaN
  return column.levels.empty() ? fmt::format("{:.6g}", value)
                               : column.levels[static_cast<std::size_t>(value)];
}

std::span<const double> Dataset::row_weights() const {
  return condensed ? std::span<const double>(condensed->rows) : std::span<const double>();
}

namespace {

void append_rows(std::vector<double>& to, const std::vector<double>& from, std::size_t first,
                 std::size_t end) {
  to.insert(to.end(), from.begin() + static_cast<long>(first),
            from.begin() + static_cast<long>(end));
}

void append_experiment(Condensed& to, const Dataset& data, std::size_t e) {
  const Condensed& from = *data.condensed;
  const std::size_t first = data.first_row[e], end = data.first_row[e + 1];
  append_rows(to.rows, from.rows, first, end);
  append_rows(to.within_MPa2, from.within_MPa2, first, end);
  for (std::size_t h = 0; h < from.histories.size(); ++h)
    append_rows(to.histories[h].values, from.histories[h].values, first, end);
  to.experiments.push_back(from.experiments[e]);
}

} // namespace

bool FileRead::is_like(const FileRead& other) const {
  return form == other.form && header_line == other.header_line && units_line == other.units_line &&
         not_read == other.not_read;
}

Dataset Dataset::subset(std::span<const std::size_t> keep) const {
  Dataset part;
  part.sources = sources;
  part.files = files;
  part.dropped = dropped;
  part.notes = notes;
  part.phases = phases;
  part.aside = aside;
  part.interventions = interventions;
  for (const Column& column : columns)
    part.columns.push_back({column.name, column.unit, {}, column.levels, column.role, column.why});
  if (condensed) {
    part.condensed.emplace();
    for (const Column& history : condensed->histories)
      part.condensed->histories.push_back({history.name, history.unit, {}, {}});
  }
  for (const std::size_t e : keep) {
    part.experiments.push_back(experiments[e]);
    if (!recording.empty()) part.recording.push_back(recording[e]);
    if (!file_of.empty()) part.file_of.push_back(file_of[e]);
    std::copy_if(clocks.begin(), clocks.end(), std::back_inserter(part.clocks),
                 [&](const ClockOffset& clock) { return clock.experiment == experiments[e]; });
    if (condensed) append_experiment(*part.condensed, *this, e);
    const auto first = static_cast<long>(first_row[e]), end = static_cast<long>(first_row[e + 1]);
    part.first_row.push_back(part.first_row.back() + first_row[e + 1] - first_row[e]);
    if (!oracle_MPa.empty())
      part.oracle_MPa.insert(part.oracle_MPa.end(), oracle_MPa.begin() + first,
                             oracle_MPa.begin() + end);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto& from = columns[c].values;
      part.columns[c].values.insert(part.columns[c].values.end(), from.begin() + first,
                                    from.begin() + end);
    }
  }
  fingerprint(part);
  return part;
}

void fingerprint(Dataset& data) {
  XXH64_hash_t hash = 0;
  const auto add = [&](const void* bytes, std::size_t size) { hash = XXH64(bytes, size, hash); };
  const auto add_text = [&](const std::string& text) { add(text.c_str(), text.size() + 1); };
  for (const Column& column : data.columns) {
    add_text(column.name);
    add(column.values.data(), column.values.size() * sizeof(double));
    for (const std::string& level : column.levels)
      add_text(level);
  }
  for (const std::string& name : data.experiments)
    add_text(name);
  for (const std::size_t row : data.first_row)
    add(&row, sizeof row);
  if (data.condensed)
    for (const auto* values : {&data.condensed->rows, &data.condensed->within_MPa2})
      add(values->data(), values->size() * sizeof(double));
  data.hash = hash;
}

std::string fingerprint(const Dataset& training, const Dataset& validation) {
  return fmt::format("{:016x}", training.hash ^ (validation.hash * 0x9e3779b97f4a7c15ULL));
}

namespace {

constexpr XXH64_hash_t hold_out_stream = 0x686f6c646f7574; // "holdout"

// Position of each unit in a random order, seeded by the contents of its tests.
std::vector<std::size_t> drawn_by_content(const Dataset& data, const Units& units,
                                          std::uint64_t seed) {
  std::vector<std::vector<XXH64_hash_t>> tests(units.count);
  for (std::size_t e = 0; e < units.of.size(); ++e) {
    const std::size_t first = data.first_row[e], rows = data.first_row[e + 1] - first;
    XXH64_hash_t hash = XXH64(&rows, sizeof rows, seed);
    for (const Quantity& quantity : quantities()) // in canonical order instead of the file's
      if (const Column* column = data.find(quantity.name))
        hash = XXH64(column->values.data() + first, rows * sizeof(double), hash);
    tests[units.of[e]].push_back(hash);
  }
  std::vector<std::pair<XXH64_hash_t, std::size_t>> order;
  for (std::size_t u = 0; u < units.count; ++u) {
    std::sort(tests[u].begin(), tests[u].end());
    order.emplace_back(
        XXH64(tests[u].data(), tests[u].size() * sizeof(XXH64_hash_t), hold_out_stream), u);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> place(units.count);
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i].second] = i;
  return place;
}

// ", 3 of 12 recordings whole"
std::string in_words(const Units& units, std::size_t held) {
  if (units.count == units.of.size()) return "";
  return fmt::format(", {} of {} recordings whole", held, units.count);
}

} // namespace

Split hold_out(const Dataset& data, double share, std::uint64_t seed) {
  if (data.experiments.size() < 2)
    throw InputError({join(data.sources, ", "), 0, 0},
                     "there is only one experiment: none can be held out to validate",
                     "give data.validation, or an experiment column that distinguishes the tests; "
                     "without data.holdout laws are fitted to it and judged by nothing");
  const Units units = units_of(data);
  const auto wanted =
      static_cast<std::size_t>(std::llround(share * static_cast<double>(units.count)));
  const std::size_t held = std::clamp<std::size_t>(wanted, 1, units.count - 1);
  const std::vector<std::size_t> drawn = drawn_by_content(data, units, seed);
  std::vector<std::size_t> in, out;
  for (std::size_t e = 0; e < units.of.size(); ++e)
    (drawn[units.of[e]] < held ? out : in).push_back(e);
  Split split{data.subset(in), data.subset(out)};
  // Rows left out at reading are reported once, with the training part.
  split.validation.dropped.clear();
  split.validation.phases = {};
  split.validation.interventions.clear();
  split.training.notes.push_back(
      fmt::format("{} of {} experiments held out to validate{}, drawn by seed {}", out.size(),
                  units.of.size(), in_words(units, held), seed));
  return split;
}

bool is_empty(const Column& column) {
  return column.levels.empty() && std::all_of(column.values.begin(), column.values.end(),
                                              [](double value) { return std::isnan(value); });
}

void make_empty_text(Column& column) {
  column.levels = {""};
  std::fill(column.values.begin(), column.values.end(), 0.0);
}

} // namespace frictab::data
