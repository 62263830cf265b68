// Which parts of an HDF5 file are rows, and which are not read.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "core/error.h"
#include "data/options.h"
#include "io/hdf5.h"

namespace frictab::data {

// The same in all rows of a group: an attribute, or a dataset of one value.
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
  bool per_test = false;          // each group is a test; else all columns are in the root group
  std::vector<Hdf5Rows> groups;   // sorted by name; of the root alone where not per_test
  std::vector<std::string> notes; // what is not read
};

// As the reader knows a dataset of a group, or of the root group: "".
std::string hdf5_path(const std::string& group, const std::string& name);

// Groups are tests where the root holds no columns, or none that anybody asks for while groups hold
// some. Of the root's single values those are read that somebody asks for. Throws InputError where
// both could be the campaign, or where there are no rows. `faults`: columns of another length, and
// what is asked for and is no column.
Hdf5Plan plan_hdf5(const io::Hdf5Reader& in, const std::string& named, const DataOptions& options,
                   FaultList& faults);

} // namespace frictab::data
