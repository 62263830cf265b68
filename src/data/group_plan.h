// Decides which parts of a file of groups are rows, and which are not read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/options.h"
#include "io/column_groups.h"
#include "io/csv.h"

namespace frictab::data {

// A value shared by all rows of a group: one of the group, or a member of one value.
struct SingleValue {
  std::string name, unit;
  io::NumberOrText value;
};

// Rows of one group, or of the root group.
struct GroupRows {
  io::ColumnGroup* group = nullptr;
  std::size_t count = 0;
  std::vector<io::GroupMember*> columns; // those of `count` values, sorted by name
  std::vector<SingleValue> singles;
};

struct GroupPlan {
  bool per_test = false; // true: each group is a test; false: all columns are in the root group
  std::vector<GroupRows> groups;  // sorted by name; only the root unless per_test
  std::vector<std::string> notes; // parts that are not read
  // Values of the whole file that are not columns, as lines above the rows of a text
  // (data/above.h).
  std::vector<io::CsvAbove> above;
};

// Path of a member, from a group or the root group: "".
std::string member_path(const std::string& group, const std::string& name);

// Groups are tests if the root has no columns, or only unrequested ones while groups have requested
// ones. Of the root's single values only requested ones are read. With `one_group_is_file`, the
// only group with (requested) columns becomes the root, and so do all groups if the job requests
// GROUP.NAME. Throws InputError if both readings are possible, or if no rows are found. `faults`:
// columns of different lengths, and requested names that are not columns. The plan refers to `all`,
// which must stay unchanged.
GroupPlan plan_groups(io::ColumnGroups& all, const std::string& named, const DataOptions& options,
                      FaultList& faults);

} // namespace frictab::data
