// Concatenates the rows of datasets and groups.
#include "data/hdf5_columns.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/no_value.h"

namespace frictab::data {

Hdf5Columns::Hdf5Columns(const std::string& path, const std::string& named,
                         const DataOptions& options, FaultList& faults)
    : in_(path, named), plan_(plan_hdf5(in_, named, options, faults)), faults_(faults) {
  table_.file = named;
  table_.form = "HDF5";
  table_.notes = plan_.notes; // returned with the first piece
  if (plan_.per_test) column("experiment", "", 0);
}

std::size_t Hdf5Columns::rows() const {
  std::size_t all = 0;
  for (const Hdf5Rows& rows : plan_.groups)
    all += rows.count;
  return all;
}

io::CsvTable Hdf5Columns::next(std::uint64_t bytes) {
  wanted_.clear();
  if (plan_.per_test)
    read_groups(bytes);
  else
    read_rows(bytes);
  rows_before_ += table_.rows();
  io::CsvTable piece = std::move(table_);
  table_ = {};
  table_.file = piece.file;
  table_.form = piece.form;
  for (const io::CsvColumn& one : piece.columns)
    table_.columns.push_back({one.name, one.unit, {}, {}});
  return piece;
}

std::uint64_t Hdf5Columns::bytes_of_a_row(const Hdf5Rows& rows) const {
  constexpr std::uint64_t of_a_number = 8, of_a_text = 64; // estimated, with overhead
  std::uint64_t bytes = 1;
  for (const std::string& name : rows.columns)
    bytes += in_.is_text(hdf5_path(rows.group, name)) ? of_a_text : of_a_number;
  return bytes;
}

// Requests `count` rows of the columns of a group.
void Hdf5Columns::want(const Hdf5Rows& rows, std::size_t first, std::size_t count) {
  for (const std::string& name : rows.columns)
    wanted_.push_back({hdf5_path(rows.group, name), first, count});
}

void Hdf5Columns::read_rows(std::uint64_t bytes) {
  const Hdf5Rows& root = plan_.groups.front();
  const std::uint64_t at_once = std::max<std::uint64_t>(1, bytes / bytes_of_a_row(root));
  const std::size_t count = std::min<std::uint64_t>(at_once, root.count - next_);
  want(root, next_, count);
  next_ += count;
  std::vector<io::Hdf5Values> values = in_.slices(wanted_);
  add(root, 0, count, values);
}

void Hdf5Columns::read_groups(std::uint64_t bytes) {
  const std::size_t first_group = next_;
  std::uint64_t taken = 0;
  for (; next_ < plan_.groups.size(); ++next_) {
    const Hdf5Rows& test = plan_.groups[next_];
    const std::uint64_t more = bytes_of_a_row(test) * test.count;
    if (taken > 0 && taken + more > bytes) break; // groups without rows do not make a piece
    taken += more;
    want(test, 0, test.count);
  }
  std::vector<io::Hdf5Values> values = in_.slices(wanted_);
  std::span<io::Hdf5Values> left = values;
  for (std::size_t g = first_group; g < next_; ++g) {
    const std::size_t columns = plan_.groups[g].columns.size();
    add_group(plan_.groups[g], left.first(columns));
    left = left.subspan(columns);
  }
}

// Adds a group, which is a test: its single values are repeated in all of its rows.
void Hdf5Columns::add_group(const Hdf5Rows& test, std::span<io::Hdf5Values> values) {
  const std::size_t first = table_.rows();
  add(test, first, test.count, values);
  repeat({"experiment", "", test.group}, first, test.count);
  for (const io::CsvColumn& one : table_.columns)
    if (one.numbers.size() != table_.rows())
      throw InputError({table_.file, 0, 0},
                       fmt::format("group '{}' has no {}, which others have", test.group, one.name),
                       "every test needs the same datasets and attributes");
}

// Appends rows of a group to this piece, after its first `first` rows.
void Hdf5Columns::add(const Hdf5Rows& rows, std::size_t first, std::size_t count,
                      std::span<io::Hdf5Values> values) {
  auto next = values.begin();
  for (const std::string& name : rows.columns) {
    const std::string path = hdf5_path(rows.group, name);
    io::Hdf5Values& found = *next++;
    io::CsvColumn& to = column(name, in_.text_attribute(path, "units").value_or(""), first);
    if (first == 0) // avoids a copy of a large column
      to.numbers = std::move(found.numbers);
    else
      to.numbers.insert(to.numbers.end(), found.numbers.begin(), found.numbers.end());
    to.numbers.resize(first + count, no_value); // for text columns
    for (std::size_t i = 0; i < found.texts.size(); ++i)
      to.texts.push_back({first + i, found.texts[i], 0});
    found = {};
  }
  for (const Hdf5Single& single : rows.singles)
    repeat(single, first, count);
  for (std::size_t i = 0; i < count; ++i)
    table_.line.push_back(rows_before_ + first + i + 1);
}

void Hdf5Columns::repeat(const Hdf5Single& single, std::size_t first, std::size_t count) {
  io::CsvColumn& to = column(single.name, single.unit, first);
  const auto* text = std::get_if<std::string>(&single.value);
  to.numbers.resize(first + count, text ? no_value : std::get<double>(single.value));
  for (std::size_t i = 0; text && i < count; ++i)
    to.texts.push_back({first + i, *text, 0});
}

// The column of this name; one that appears later gets empty cells for the earlier rows.
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
