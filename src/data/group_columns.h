// Files of groups of columns as tables: one member per column in the root group, or one group of
// such members per experiment, whose single values are columns as well (data/group_plan.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/group_plan.h"
#include "data/options.h"
#include "io/column_groups.h"
#include "io/csv.h"
#include "io/hdf5.h"

namespace frictab::data {

// Reads the columns in pieces. In its tables `line` counts rows from 1 and header_line is 0.
class GroupColumns {
public:
  // Columns of an HDF5 file. Throws InputError if it is not one, and as plan_groups does. `faults`:
  // columns that do not fit each other, or that are requested and cannot be read.
  GroupColumns(const std::string& path, const std::string& named, const DataOptions& options,
               FaultList& faults);
  // Columns in memory.
  GroupColumns(io::ColumnGroups&& all, const std::string& named, const DataOptions& options,
               FaultList& faults);
  GroupColumns(const GroupColumns&) = delete; // the plan refers to the groups
  GroupColumns& operator=(const GroupColumns&) = delete;

  std::size_t rows() const; // of the file
  // The next rows, about `bytes` in size at most, but at least one row or group; none at the end of
  // the file. The first piece carries the notes. Adds tests that do not fit each other to the
  // `faults` of the constructor.
  io::CsvTable next(std::uint64_t bytes);

private:
  struct Wanted { // part of a column
    const GroupRows* rows;
    io::GroupMember* member;
    std::size_t first, count;
  };

  void start(const std::string& named);
  static std::uint64_t bytes_of_a_row(const GroupRows& rows);
  void want(const GroupRows& rows, std::size_t first, std::size_t count);
  std::vector<io::Hdf5Values> wanted_values() const;
  void read_rows(std::uint64_t bytes);
  void read_groups(std::uint64_t bytes);
  void add_group(const GroupRows& test, std::span<io::Hdf5Values> values);
  void add(const GroupRows& rows, std::size_t first, std::size_t count,
           std::span<io::Hdf5Values> values);
  void repeat(const SingleValue& single, std::size_t first, std::size_t count);
  io::CsvColumn& column(const std::string& name, const std::string& unit, std::size_t first);

  std::unique_ptr<io::Hdf5Reader> file_; // nullptr: the values are in memory
  io::ColumnGroups all_;
  GroupPlan plan_;
  FaultList& faults_;
  std::size_t next_ = 0;                         // next row of the root group, or next group
  std::size_t rows_before_ = 0;                  // rows in the pieces so far
  std::vector<Wanted> wanted_;                   // parts of this piece
  io::CsvTable table_;                           // columns of all pieces, rows of this one
  std::map<std::string, std::size_t> number_of_; // index of each column, from 0
};

} // namespace frictab::data
