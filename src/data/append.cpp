// Appends the columns of one dataset to those of another.
#include "data/append.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "core/no_value.h"
#include "data/plausibility.h"
#include "data/recordings.h"
#include "data/signs.h"

namespace frictab::data {

namespace {

void append_values(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

bool is_text(const Column& column) {
  return !column.levels.empty();
}

// Appends the condensed data of `from`; keeps the histories that both have.
void append_condensed(Condensed& to, const Condensed& from) {
  append_values(to.rows, from.rows);
  append_values(to.within_MPa2, from.within_MPa2);
  std::erase_if(to.histories, [&](Column& history) {
    const auto same = std::find_if(from.histories.begin(), from.histories.end(),
                                   [&](const Column& other) { return other.name == history.name; });
    if (same == from.histories.end()) return true;
    append_values(history.values, same->values);
    return false;
  });
  to.experiments.insert(to.experiments.end(), from.experiments.begin(), from.experiments.end());
}

} // namespace

void add_dropped(Dataset& all, const std::vector<Dataset::Dropped>& more) {
  for (const Dataset::Dropped& dropped : more) {
    const auto same = std::find_if(all.dropped.begin(), all.dropped.end(),
                                   [&](const auto& there) { return there.rule == dropped.rule; });
    if (same == all.dropped.end())
      all.dropped.push_back(dropped);
    else
      same->rows += dropped.rows;
  }
}

namespace {

void add_aside(Dataset& all, const Dataset& more) {
  if (!more.aside) return;
  if (!all.aside) {
    all.aside = more.aside;
    return;
  }
  const auto joined = all.aside.use_count() == 1 // a campaign may have many files
                          ? std::const_pointer_cast<Dataset>(all.aside)
                          : std::make_shared<Dataset>(*all.aside);
  const std::size_t before = joined->rows();
  for (Column& column : joined->columns)
    if (const Column* same = more.aside->find(column.name))
      append_values(column.values, same->values);
    else
      column.values.resize(column.values.size() + more.aside->rows(), no_value);
  for (std::size_t e = 1; e < more.aside->first_row.size(); ++e)
    joined->first_row.push_back(before + more.aside->first_row[e]);
  joined->experiments.insert(joined->experiments.end(), more.aside->experiments.begin(),
                             more.aside->experiments.end());
  all.aside = joined;
}

void add_apart(std::vector<RowsApart>& all, const std::vector<RowsApart>& more) {
  for (const RowsApart& one : more) {
    const auto same = std::find_if(
        all.begin(), all.end(), [&](const RowsApart& other) { return other.check == one.check; });
    if (same == all.end()) {
      all.push_back(one);
      continue;
    }
    same->rows += one.rows;
    for (const std::string& named : one.first)
      if (same->first.size() < RowsApart::named) same->first.push_back(named);
  }
}

} // namespace

namespace {

// Parts of one file come one after the other.
void add_files(std::vector<FileRead>& all, const std::vector<FileRead>& more) {
  for (const FileRead& one : more)
    if (!all.empty() && all.back().file == one.file)
      all.back().rows += one.rows;
    else
      all.push_back(one);
}

} // namespace

void absorb(Dataset& all, const Dataset& more) {
  add_files(all.files, more.files);
  add_dropped(all, more.dropped);
  for (std::size_t p = 0; p < phase_count; ++p)
    all.phases[p] += more.phases[p];
  add_aside(all, more);
  add_apart(all.apart, more.apart);
  all.signs.insert(all.signs.end(), more.signs.begin(), more.signs.end());
  all.at_rest.insert(all.at_rest.end(), more.at_rest.begin(), more.at_rest.end());
  merge_implausible(more.counted, all.counted);
  for (const std::string& note : more.notes)
    if (std::find(all.notes.begin(), all.notes.end(), note) == all.notes.end())
      all.notes.push_back(note);
}

constexpr const char* only_same_columns =
    "all files of a list need the same columns: one that a file lacks may stand in `constants` or "
    "`labels` of its [[data.files]]; data.bystanders says which are read in addition to the "
    "quantities";

void append(Dataset& all, Dataset&& more, const std::string& file, FaultList& faults) {
  for (const std::string& name : more.experiments)
    if (std::find(all.experiments.begin(), all.experiments.end(), name) != all.experiments.end())
      faults.add({file, 0, 0}, fmt::format("experiment '{}' is in another file as well", name),
                 "give experiments different names, or join the files");
  std::array both{&all, &more};
  if (all.has(direction_column) != more.has(direction_column)) add_direction(both);
  std::unordered_map<std::string_view, Column*> others; // a file may have many columns
  for (Column& column : more.columns)
    others.emplace(column.name, &column);
  std::set<std::string_view> known;
  for (const Column& column : all.columns)
    known.insert(column.name);
  for (const Column& column : more.columns)
    if (known.count(column.name) == 0)
      faults.add({file, 0, 0}, fmt::format("column {} is not in {}", column.name, all.sources[0]),
                 only_same_columns);
  for (Column& column : all.columns) {
    const auto found = others.find(column.name);
    if (found == others.end()) {
      faults.add({file, 0, 0},
                 fmt::format("there is no column {}, which {} has", column.name, all.sources[0]),
                 only_same_columns);
      continue;
    }
    Column* const other = found->second;
    if (is_text(*other) && is_empty(column)) make_empty_text(column);
    if (is_text(column) && is_empty(*other)) make_empty_text(*other);
    if (is_text(column) != is_text(*other)) {
      faults.add({file, 0, 0},
                 fmt::format("column {} is text in one file and numbers in another", column.name),
                 "of [[data.files]], `constants` are numbers, `labels` texts, and groups of "
                 "from_name numbers where all of them are");
      continue;
    }
    std::vector<std::string> levels = column.levels;
    levels.insert(levels.end(), other->levels.begin(), other->levels.end());
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    const auto recode = [&](const Column& from, double code) {
      if (levels.empty()) return code;
      const std::string& level = from.levels[static_cast<std::size_t>(code)];
      return static_cast<double>(std::lower_bound(levels.begin(), levels.end(), level) -
                                 levels.begin());
    };
    // Skipped if equal: a campaign of many parts would otherwise scan all rows for each part.
    if (levels != column.levels)
      for (double& value : column.values)
        value = recode(column, value);
    for (const double value : other->values)
      column.values.push_back(recode(*other, value));
    column.levels = std::move(levels);
  }
  if (all.condensed && more.condensed) append_condensed(*all.condensed, *more.condensed);
  const std::size_t offset = all.first_row.back();
  all.experiments.insert(all.experiments.end(), more.experiments.begin(), more.experiments.end());
  all.filed.insert(all.filed.end(), more.filed.begin(), more.filed.end());
  for (std::size_t e = 1; e < more.first_row.size(); ++e)
    all.first_row.push_back(offset + more.first_row[e]);
  all.file_of.insert(all.file_of.end(), more.file_of.begin(), more.file_of.end());
  for (AssumedUnit& unit : more.assumed)
    if (std::find(all.assumed.begin(), all.assumed.end(), unit) == all.assumed.end())
      all.assumed.push_back(std::move(unit));
  all.clocks.insert(all.clocks.end(), more.clocks.begin(), more.clocks.end());
  absorb(all, more);
}

namespace {

// Keeps the columns that `other` has by name and of the same kind, text or numbers.
void keep_columns_of(const Dataset& other, Dataset& data) {
  std::erase_if(data.columns, [&](const Column& column) {
    const Column* same = other.find(column.name);
    return !same || same->levels.empty() != column.levels.empty();
  });
}

void call_apart(const std::vector<std::string>& taken, std::vector<std::string>& names) {
  const auto is_taken = [&](const std::string& name) {
    return std::find(taken.begin(), taken.end(), name) != taken.end() ||
           std::count(names.begin(), names.end(), name) > 1;
  };
  for (std::string& name : names) {
    const std::string own = name;
    for (int n = 2; is_taken(name); ++n)
      name = fmt::format("{} ({})", own, n);
  }
}

} // namespace

Dataset together(const Dataset& first, const Dataset& second) {
  Dataset all = first, more = second;
  keep_columns_of(second, all);
  keep_columns_of(first, more);
  call_apart(first.experiments, more.experiments);
  FaultList faults; // stays empty: only shared columns are left
  append(all, std::move(more), "", faults);
  faults.throw_if_any();
  all.oracle_MPa.clear();
  group_recordings(all);
  fingerprint(all);
  return all;
}

} // namespace frictab::data
