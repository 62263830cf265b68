// Puts rows of datasets and groups end to end.
#include "data/hdf5_columns.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/no_value.h"

namespace frictab::data {

namespace {

std::string path_of(const std::string& group, const std::string& dataset) {
  return group.empty() ? dataset : group + "/" + dataset;
}

} // namespace

Hdf5Columns::Hdf5Columns(const std::string& path, const std::string& named, FaultList& faults)
    : in_(path, named), faults_(faults) {
  table_.file = named;
  if (in_.datasets().empty()) groups_ = in_.groups();
  if (!groups_.empty()) column("experiment", "", 0);
  bool any = rows_of("") > 0;
  check_lengths("");
  for (const std::string& group : groups_) {
    any = any || rows_of(group) > 0;
    check_lengths(group);
  }
  if (!any)
    throw InputError({named, 0, 0}, "holds no data columns",
                     "a data file has one 1-D dataset per column, or such groups: one per test");
}

io::CsvTable Hdf5Columns::next(std::uint64_t bytes) {
  wanted_.clear();
  if (groups_.empty())
    read_rows(bytes);
  else
    read_groups(bytes);
  rows_before_ += table_.rows();
  io::CsvTable piece = std::move(table_);
  table_ = {};
  table_.file = piece.file;
  for (const io::CsvColumn& one : piece.columns)
    table_.columns.push_back({one.name, one.unit, {}, {}});
  return piece;
}

// Of another shape they are no data columns.
std::vector<std::string> Hdf5Columns::with_one_axis(const std::string& group) const {
  std::vector<std::string> names = in_.datasets(group.empty() ? "/" : group);
  std::erase_if(
      names, [&](const std::string& name) { return in_.shape(path_of(group, name)).size() != 1; });
  return names;
}

// Without those of another length, which are faults (check_lengths).
std::vector<std::string> Hdf5Columns::columns_of(const std::string& group) const {
  std::vector<std::string> names = with_one_axis(group);
  const std::size_t rows = rows_of(group);
  std::erase_if(
      names, [&](const std::string& name) { return in_.shape(path_of(group, name))[0] != rows; });
  return names;
}

std::size_t Hdf5Columns::rows_of(const std::string& group) const {
  const std::vector<std::string> names = with_one_axis(group);
  return names.empty() ? 0 : in_.shape(path_of(group, names.front()))[0];
}

void Hdf5Columns::check_lengths(const std::string& group) {
  const std::vector<std::string> names = with_one_axis(group);
  const std::size_t rows = rows_of(group);
  for (const std::string& name : names)
    if (const std::size_t own = in_.shape(path_of(group, name))[0]; own != rows)
      faults_.add({table_.file, 0, 0},
                  fmt::format("column '{}' has {} rows, '{}' has {}", path_of(group, name), own,
                              path_of(group, names.front()), rows));
}

std::uint64_t Hdf5Columns::bytes_of_a_row(const std::string& group) const {
  constexpr std::uint64_t of_a_number = 8, of_a_text = 64; // about, with its place
  std::uint64_t bytes = 1;
  for (const std::string& name : columns_of(group))
    bytes += in_.is_text(path_of(group, name)) ? of_a_text : of_a_number;
  return bytes;
}

// `count` rows of the columns of a group.
void Hdf5Columns::want(const std::string& group, std::size_t first, std::size_t count) {
  for (const std::string& name : columns_of(group))
    wanted_.push_back({path_of(group, name), first, count});
}

void Hdf5Columns::read_rows(std::uint64_t bytes) {
  const std::uint64_t at_once = std::max<std::uint64_t>(1, bytes / bytes_of_a_row(""));
  const std::size_t count = std::min<std::uint64_t>(at_once, rows_of("") - next_);
  want("", next_, count);
  next_ += count;
  std::vector<io::Hdf5Values> values = in_.slices(wanted_);
  add("", 0, count, values);
}

void Hdf5Columns::read_groups(std::uint64_t bytes) {
  const std::size_t first_group = next_;
  std::uint64_t taken = 0;
  for (; next_ < groups_.size(); ++next_) {
    const std::string& group = groups_[next_];
    const std::size_t rows = rows_of(group);
    const std::uint64_t more = bytes_of_a_row(group) * rows;
    if (taken > 0 && taken + more > bytes) break; // groups without rows are no piece
    taken += more;
    want(group, 0, rows);
  }
  std::vector<io::Hdf5Values> values = in_.slices(wanted_);
  std::span<io::Hdf5Values> left = values;
  for (std::size_t g = first_group; g < next_; ++g) {
    const std::size_t columns = columns_of(groups_[g]).size();
    add_group(groups_[g], left.first(columns));
    left = left.subspan(columns);
  }
}

// A group is a test: its attributes are the same in all of its rows.
void Hdf5Columns::add_group(const std::string& group, std::span<io::Hdf5Values> values) {
  const std::size_t first = table_.rows(), rows = rows_of(group);
  add(group, first, rows, values);
  repeat("experiment", group, first, rows);
  for (const std::string& name : in_.attributes(group))
    if (const auto number = in_.number_attribute(group, name))
      column(name, "", first).numbers.resize(first + rows, *number);
    else if (const auto text = in_.text_attribute(group, name))
      repeat(name, *text, first, rows);
  for (const io::CsvColumn& one : table_.columns)
    if (one.numbers.size() != table_.rows())
      throw InputError({table_.file, 0, 0},
                       fmt::format("group '{}' has no {}, which others have", group, one.name),
                       "every test needs the same datasets and attributes");
}

// Rows of the columns of a group, behind the first ones of this piece.
void Hdf5Columns::add(const std::string& group, std::size_t first, std::size_t rows,
                      std::span<io::Hdf5Values> values) {
  auto next = values.begin();
  for (const std::string& name : columns_of(group)) {
    const std::string path = path_of(group, name);
    io::Hdf5Values& found = *next++;
    io::CsvColumn& to = column(name, in_.text_attribute(path, "units").value_or(""), first);
    if (first == 0) // no copy of a large one
      to.numbers = std::move(found.numbers);
    else
      to.numbers.insert(to.numbers.end(), found.numbers.begin(), found.numbers.end());
    to.numbers.resize(first + rows, no_value); // where they are texts
    to.texts.reserve(to.texts.size() + found.texts.size());
    for (std::size_t i = 0; i < found.texts.size(); ++i)
      to.texts.push_back({first + i, std::move(found.texts[i]), 0});
    found = {};
  }
  for (std::size_t i = 0; i < rows; ++i)
    table_.line.push_back(rows_before_ + first + i + 1);
}

void Hdf5Columns::repeat(const std::string& name, const std::string& text, std::size_t first,
                         std::size_t rows) {
  io::CsvColumn& to = column(name, "", first);
  to.numbers.resize(first + rows, no_value);
  for (std::size_t i = 0; i < rows; ++i)
    to.texts.push_back({first + i, text, 0});
}

// The column of this name; one that comes in behind the first row lacks the rows before.
io::CsvColumn& Hdf5Columns::column(const std::string& name, const std::string& unit,
                                   std::size_t first) {
  const auto [known, is_new] = number_of_.emplace(name, table_.columns.size());
  if (!is_new) {
    io::CsvColumn& there = table_.columns[known->second];
    if (there.unit != unit || there.numbers.size() != first)
      faults_.add({table_.file, 0, 0},
                  fmt::format("column '{}' is there twice, or in two units", name));
    return there;
  }
  if (rows_before_ + first > 0)
    faults_.add({table_.file, 0, 0}, fmt::format("column '{}' is not in all groups", name),
                "every test needs the same datasets and attributes");
  return table_.columns.emplace_back(io::CsvColumn{name, unit, {}, {}});
}

} // namespace frictab::data
