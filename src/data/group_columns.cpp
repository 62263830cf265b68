// Concatenates the rows of datasets and groups.
#include "data/group_columns.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/no_value.h"

namespace frictab::data {

namespace {

io::GroupMember member_of(const io::Hdf5Reader& in, const std::string& group,
                          const std::string& name) {
  const std::string path = member_path(group, name);
  io::GroupMember member;
  member.name = name;
  member.unit = in.text_attribute(path, "units").value_or("");
  member.shape = in.shape(path);
  member.is_text = in.is_text(path);
  member.other_type = in.other_type(path);
  member.fault = in.fault(path);
  const bool one =
      member.shape.empty() || (member.shape.size() > 1 && io::length_of_column(member.shape) == 1);
  if (!one || !member.other_type.empty() || !member.fault.empty()) return member;
  if (member.is_text)
    member.single = in.texts(path).front();
  else
    member.single = in.values(path).front();
  return member;
}

io::ColumnGroup group_of(const io::Hdf5Reader& in, const std::string& name) {
  io::ColumnGroup group;
  group.name = name;
  const std::string object = name.empty() ? "/" : name;
  for (const std::string& dataset : in.datasets(object))
    group.members.push_back(member_of(in, name, dataset));
  for (const std::string& attribute : in.attributes(object))
    if (const auto number = in.number_attribute(object, attribute))
      group.values.push_back({attribute, *number});
    else if (const auto text = in.text_attribute(object, attribute))
      group.values.push_back({attribute, *text});
  group.others = in.others(object);
  return group;
}

io::ColumnGroups groups_of(const io::Hdf5Reader& in) {
  io::ColumnGroups all;
  all.form = "a data file has one dataset per column, or such groups: one per test";
  all.root = group_of(in, "");
  for (const std::string& name : in.groups())
    all.groups.push_back(group_of(in, name));
  return all;
}

} // namespace

GroupColumns::GroupColumns(const std::string& path, const std::string& named,
                           const DataOptions& options, FaultList& faults)
    : file_(std::make_unique<io::Hdf5Reader>(path, named)), all_(groups_of(*file_)),
      plan_(plan_groups(all_, named, options, faults)), faults_(faults) {
  start(named);
}

GroupColumns::GroupColumns(io::ColumnGroups&& all, const std::string& named,
                           const DataOptions& options, FaultList& faults)
    : all_(std::move(all)), plan_(plan_groups(all_, named, options, faults)), faults_(faults) {
  start(named);
}

void GroupColumns::start(const std::string& named) {
  table_.file = named;
  table_.notes = plan_.notes; // returned with the first piece
  if (plan_.per_test) column("experiment", "", 0);
}

std::size_t GroupColumns::rows() const {
  std::size_t all = 0;
  for (const GroupRows& rows : plan_.groups)
    all += rows.count;
  return all;
}

io::CsvTable GroupColumns::next(std::uint64_t bytes) {
  wanted_.clear();
  if (plan_.per_test)
    read_groups(bytes);
  else
    read_rows(bytes);
  rows_before_ += table_.rows();
  io::CsvTable piece = std::move(table_);
  table_ = {};
  if (file_) piece.form = "HDF5";
  piece.above = plan_.above;
  table_.file = piece.file;
  for (const io::CsvColumn& one : piece.columns)
    table_.columns.push_back({one.name, one.unit, {}, {}});
  return piece;
}

std::uint64_t GroupColumns::bytes_of_a_row(const GroupRows& rows) {
  constexpr std::uint64_t of_a_number = 8, of_a_text = 64; // estimated, with overhead
  std::uint64_t bytes = 1;
  for (const io::GroupMember* member : rows.columns)
    bytes += member->is_text ? of_a_text : of_a_number;
  return bytes;
}

// Requests `count` rows of the columns of a group.
void GroupColumns::want(const GroupRows& rows, std::size_t first, std::size_t count) {
  for (io::GroupMember* member : rows.columns)
    wanted_.push_back({&rows, member, first, count});
}

namespace {

// Takes a part of a column in memory; the whole column is moved.
template <class T>
std::vector<T> part_of(std::vector<T>& values, std::size_t first, std::size_t count) {
  if (first == 0 && count == values.size()) return std::move(values);
  if (values.empty()) return {}; // the column has values of the other type
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

} // namespace

std::vector<io::Hdf5Values> GroupColumns::wanted_values() const {
  if (file_) {
    std::vector<io::Hdf5Slice> slices;
    for (const Wanted& one : wanted_)
      slices.push_back(
          {member_path(one.rows->group->name, one.member->name), one.first, one.count});
    return file_->slices(slices);
  }
  std::vector<io::Hdf5Values> values;
  for (const Wanted& one : wanted_)
    values.push_back({part_of(one.member->numbers, one.first, one.count),
                      part_of(one.member->texts, one.first, one.count)});
  return values;
}

void GroupColumns::read_rows(std::uint64_t bytes) {
  const GroupRows& root = plan_.groups.front();
  const std::uint64_t at_once = std::max<std::uint64_t>(1, bytes / bytes_of_a_row(root));
  const std::size_t count = std::min<std::uint64_t>(at_once, root.count - next_);
  want(root, next_, count);
  next_ += count;
  std::vector<io::Hdf5Values> values = wanted_values();
  add(root, 0, count, values);
}

void GroupColumns::read_groups(std::uint64_t bytes) {
  const std::size_t first_group = next_;
  std::uint64_t taken = 0;
  for (; next_ < plan_.groups.size(); ++next_) {
    const GroupRows& test = plan_.groups[next_];
    const std::uint64_t more = bytes_of_a_row(test) * test.count;
    if (taken > 0 && taken + more > bytes) break; // groups without rows do not make a piece
    taken += more;
    want(test, 0, test.count);
  }
  std::vector<io::Hdf5Values> values = wanted_values();
  std::span<io::Hdf5Values> left = values;
  for (std::size_t g = first_group; g < next_; ++g) {
    const std::size_t columns = plan_.groups[g].columns.size();
    add_group(plan_.groups[g], left.first(columns));
    left = left.subspan(columns);
  }
}

// Adds a group, which is a test: its single values are repeated in all of its rows.
void GroupColumns::add_group(const GroupRows& test, std::span<io::Hdf5Values> values) {
  const std::size_t first = table_.rows();
  add(test, first, test.count, values);
  repeat({"experiment", "", test.group->name}, first, test.count);
  for (const io::CsvColumn& one : table_.columns)
    if (one.numbers.size() != table_.rows())
      throw InputError(
          {table_.file, 0, 0},
          fmt::format("group '{}' has no {}, which others have", test.group->name, one.name),
          "every test needs the same datasets and attributes");
}

// Appends rows of a group to this piece, after its first `first` rows.
void GroupColumns::add(const GroupRows& rows, std::size_t first, std::size_t count,
                       std::span<io::Hdf5Values> values) {
  auto next = values.begin();
  for (const io::GroupMember* member : rows.columns) {
    io::Hdf5Values& found = *next++;
    io::CsvColumn& to = column(member->name, member->unit, first);
    if (first == 0) // avoids a copy of a large column
      to.numbers = std::move(found.numbers);
    else
      to.numbers.insert(to.numbers.end(), found.numbers.begin(), found.numbers.end());
    to.numbers.resize(first + count, no_value); // for text columns
    for (std::size_t i = 0; i < found.texts.size(); ++i)
      to.texts.push_back({first + i, found.texts[i], 0});
    found = {};
  }
  for (const SingleValue& single : rows.singles)
    repeat(single, first, count);
  for (std::size_t i = 0; i < count; ++i)
    table_.line.push_back(rows_before_ + first + i + 1);
}

void GroupColumns::repeat(const SingleValue& single, std::size_t first, std::size_t count) {
  io::CsvColumn& to = column(single.name, single.unit, first);
  const auto* text = std::get_if<std::string>(&single.value);
  to.numbers.resize(first + count, text ? no_value : std::get<double>(single.value));
  for (std::size_t i = 0; text && i < count; ++i)
    to.texts.push_back({first + i, *text, 0});
}

// The column of this name; one that appears later gets empty cells for the earlier rows.
io::CsvColumn& GroupColumns::column(const std::string& name, const std::string& unit,
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
