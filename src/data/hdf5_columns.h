// HDF5 files of measured rows: one dataset per column in the root group, or one group of such
// datasets per experiment, whose attributes and single values are columns as well
// (data/hdf5_plan.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/hdf5_plan.h"
#include "data/options.h"
#include "io/csv.h"
#include "io/hdf5.h"

namespace frictab::data {

// Reads the columns in pieces. In its tables `line` counts rows from 1 and header_line is 0.
class Hdf5Columns {
public:
  // Throws InputError if the file is not an HDF5 file, and as plan_hdf5 does. `faults`: columns
  // that do not fit each other, or that are requested and cannot be read.
  Hdf5Columns(const std::string& path, const std::string& named, const DataOptions& options,
              FaultList& faults);

  std::size_t rows() const; // of the file
  // The next rows, about `bytes` in size at most, but at least one row or group; none at the end of
  // the file. The first piece carries the notes. Adds tests that do not fit each other to the
  // `faults` of the constructor.
  io::CsvTable next(std::uint64_t bytes);

private:
  std::uint64_t bytes_of_a_row(const Hdf5Rows& rows) const;
  void want(const Hdf5Rows& rows, std::size_t first, std::size_t count);
  void read_rows(std::uint64_t bytes);
  void read_groups(std::uint64_t bytes);
  void add_group(const Hdf5Rows& test, std::span<io::Hdf5Values> values);
  void add(const Hdf5Rows& rows, std::size_t first, std::size_t count,
           std::span<io::Hdf5Values> values);
  void repeat(const Hdf5Single& single, std::size_t first, std::size_t count);
  io::CsvColumn& column(const std::string& name, const std::string& unit, std::size_t first);

  io::Hdf5Reader in_;
  Hdf5Plan plan_;
  FaultList& faults_;
  std::size_t next_ = 0;                         // next row of the root group, or next group
  std::size_t rows_before_ = 0;                  // rows in the pieces so far
  std::vector<io::Hdf5Slice> wanted_;            // slices of this piece
  io::CsvTable table_;                           // columns of all pieces, rows of this one
  std::map<std::string, std::size_t> number_of_; // index of each column, from 0
};

} // namespace frictab::data
