// Decides which parts of an HDF5 file are rows, and which are not read.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "data/options.h"
#include "io/hdf5.h"

namespace frictab::data {

// A value shared by all rows of a group: an attribute, or a dataset of one value.
struct Hdf5Single {
  std::string name, unit;
  std::variant<double, std::string> value;
};

// Rows of one group, or of the root group: "".
struct Hdf5Rows {
  std::string group;
  std::size_t count = 0;
  std::vector<std::string> columns; // datasets of `count` values, sorted by name
  std::vector<Hdf5Single> singles;
};

struct Hdf5Plan {
  bool per_test = false; // true: each group is a test; false: all columns are in the root group
  std::vector<Hdf5Rows> groups;   // sorted by name; only the root unless per_test
  std::vector<std::string> notes; // parts that are not read
};

// Path of a dataset for the reader, from a group or the root group: "".
std::string hdf5_path(const std::string& group, const std::string& name);

// Groups are tests if the root has no columns, or only unrequested ones while groups have requested
// ones. Of the root's single values only requested ones are read. Throws InputError if both
// readings are possible, or if no rows are found. `faults`: columns of different lengths, and
// requested names that are not columns.
Hdf5Plan plan_hdf5(const io::Hdf5Reader& in, const std::string& named, const DataOptions& options,
                   FaultList& faults);

} // namespace frictab::data
