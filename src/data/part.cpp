// Gathers the rows of one file by experiment, and removes rows.
#include "data/part.h"

#include <algorithm>
#include <map>

#include "core/text.h"

namespace frictab::data {

Column* Part::find(std::string_view name) {
  for (Column& column : data.columns)
    if (column.name == name) return &column;
  return nullptr;
}

std::vector<std::string> Part::raw_names() const {
  std::vector<std::string> names;
  for (const io::CsvColumn& column : raw.columns)
    if (!column.name.empty()) names.push_back(column.name);
  return names;
}

void gather_experiments(Part& part, MappedFile&& mapped, const std::string& label) {
  Dataset& data = part.data;
  const std::size_t rows = part.raw.rows();
  std::map<std::string, std::size_t> index;
  std::vector<std::vector<std::size_t>> members;
  const auto name_of = [&](std::size_t i) -> const std::string& {
    return mapped.experiment.empty() ? label : mapped.experiment[i];
  };
  std::size_t current = 0; // index of the last experiment: its rows are mostly consecutive
  for (std::size_t i = 0; i < rows; ++i) {
    const std::string& name = name_of(i);
    if (i > 0 && name == name_of(i - 1)) {
      members[current].push_back(i);
      continue;
    }
    const auto [found, is_new] = index.emplace(name, members.size());
    if (is_new) {
      members.emplace_back();
      data.experiments.push_back(name);
      data.filed.push_back({label, mapped.intervals});
    }
    current = found->second;
    members[current].push_back(i);
  }
  for (const auto& rows_of_one : members) {
    part.row.insert(part.row.end(), rows_of_one.begin(), rows_of_one.end());
    data.first_row.push_back(part.row.size());
  }
  const bool in_order = std::is_sorted(part.row.begin(), part.row.end());
  if (in_order) data.columns = std::move(mapped.columns);
  for (Column& column : mapped.columns) {
    Column sorted{column.name, column.unit, std::vector<double>(rows), column.levels};
    for (std::size_t i = 0; i < rows; ++i)
      sorted.values[i] = column.values[part.row[i]];
    column = {};
    data.columns.push_back(std::move(sorted));
  }
  part.raw_rows = rows;
  data.files = {{part.raw.file, part.raw.form, part.raw.header_line, part.raw.units_line, rows,
                 std::move(mapped.not_read)}};
  data.notes = std::move(mapped.notes);
  data.assumed = std::move(mapped.assumed);
  part.cell_faults = std::move(mapped.cell_faults);
  part.counted_notes = std::move(mapped.counted_notes);
}

namespace {

// "E1, E2 (and 7 more tests)"
std::string some_of(std::vector<std::string> names) {
  constexpr std::size_t most = 12;
  const std::size_t more = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - more);
  return join(names, ", ") + and_more(more, "test");
}

} // namespace

void keep_rows(Part& part, const std::vector<char>& keep, const char* if_none) {
  Dataset& data = part.data;
  std::vector<std::size_t> first{0};
  std::vector<std::string> names, gone;
  std::vector<Dataset::Filed> filed;
  std::vector<std::size_t> kept;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      if (keep[i]) kept.push_back(i);
    if (kept.size() == first.back()) { // the experiment has no row left
      gone.push_back(data.experiments[e]);
      continue;
    }
    names.push_back(data.experiments[e]);
    filed.push_back(data.filed[e]);
    first.push_back(kept.size());
  }
  if (kept.size() == part.row.size()) return;
  if (kept.empty() && if_none && part.whole_file && part.faults.empty())
    part.faults.add({part.raw.file, 0, 0}, if_none);
  if (if_none && !gone.empty()) data.notes.push_back("no row is left of " + some_of(gone));
  for (Column& column : data.columns) {
    for (std::size_t i = 0; i < kept.size(); ++i)
      column.values[i] = column.values[kept[i]];
    column.values.resize(kept.size());
  }
  for (std::size_t i = 0; i < kept.size(); ++i)
    part.row[i] = part.row[kept[i]];
  part.row.resize(kept.size());
  data.experiments = std::move(names);
  data.filed = std::move(filed);
  data.first_row = std::move(first);
}

void add_counted(Part& part, std::string before, std::string after, std::size_t rows) {
  part.counted_notes.push_back(
      {part.data.notes.size(), std::move(before), std::move(after), true, rows, part.raw_rows});
  part.data.notes.push_back(part.counted_notes.back().text());
}

void CountedNotes::take(Part& part) {
  std::vector<std::string>& notes = part.data.notes;
  for (auto note = part.counted_notes.rbegin(); note != part.counted_notes.rend(); ++note)
    notes.erase(notes.begin() + static_cast<std::ptrdiff_t>(note->note));
  CountedNotes own;
  own.notes_ = std::move(part.counted_notes);
  own.raw_rows_ = part.raw_rows;
  add(own);
}

void CountedNotes::add(const CountedNotes& more) {
  for (const MappedFile::CountedNote& note : more.notes_) {
    const auto same = std::find_if(notes_.begin(), notes_.end(), [&](const auto& other) {
      return other.before == note.before && other.after == note.after;
    });
    if (same == notes_.end())
      notes_.push_back(note);
    else
      same->rows += note.rows;
  }
  raw_rows_ += more.raw_rows_;
}

std::vector<std::string> CountedNotes::texts() const {
  std::vector<std::string> texts;
  for (MappedFile::CountedNote note : notes_) {
    note.of = raw_rows_;
    texts.push_back(note.text());
  }
  return texts;
}

} // namespace frictab::data
