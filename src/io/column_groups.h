// Contents of a file whose columns are in groups (HDF5, MATLAB, TDMS), in one form.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace frictab::io {

using NumberOrText = std::variant<double, std::string>;

// A named array of a group: a column, a single value, or neither.
struct GroupMember {
  std::string name, unit;
  std::vector<std::size_t> shape; // empty: a single value
  bool is_text = false;
  // Type of its values if they are neither numbers nor texts: "records of r, i"; else empty.
  std::string other_type;
  std::string fault;                  // reason why its values cannot be read; else empty
  std::optional<NumberOrText> single; // the value, if there is only one
  // All values, where the whole file is in memory.
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

// A value of the group itself.
struct GroupValue {
  std::string name;
  NumberOrText value;
};

// Contents that are neither columns nor single values.
struct GroupOther {
  std::string name;
  std::string what; // "an attribute of 2 values"
};

struct ColumnGroup {
  std::string name;                 // empty: the root group
  std::vector<GroupMember> members; // sorted by name, each name once
  std::vector<GroupValue> values;
  std::vector<GroupOther> others;
};

struct ColumnGroups {
  std::string format = "HDF5"; // in messages
  std::string form;            // advice for a file without columns: their form in this format
  ColumnGroup root;
  std::vector<ColumnGroup> groups; // sorted by name
  std::vector<std::string> notes;  // decisions of the reader
  // The only group with columns is the file rather than a test.
  bool one_group_is_file = false;
};

// A column of numbers or texts in memory, n x 1; a single value if n = 1.
GroupMember number_member(std::string name, std::string unit, std::vector<double> numbers);
GroupMember text_member(std::string name, std::vector<std::string> texts);
// Sorts groups and members by name.
void sort_by_name(ColumnGroups& all);

} // namespace frictab::io
