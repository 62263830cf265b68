// HDF5 files of measured rows: one dataset per column in the root group, or one group of such
// datasets per experiment, whose attributes are columns as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/csv.h"
#include "io/hdf5.h"

namespace frictab::data {

// Reads them in pieces. In its tables `line` counts rows from 1 and header_line is 0.
class Hdf5Columns {
public:
  // Throws InputError where the file is no HDF5 file or holds no column.
  Hdf5Columns(const std::string& path, const std::string& named, FaultList& faults);

  // The next rows, of no more than about so many bytes, but one row or group at least; none at the
  // end of the file. `faults` of the constructor: columns that do not fit each other.
  io::CsvTable next(std::uint64_t bytes);

private:
  // Of a group, or of the root group: "".
  std::vector<std::string> with_one_axis(const std::string& group) const;
  std::vector<std::string> columns_of(const std::string& group) const;
  std::size_t rows_of(const std::string& group) const;
  std::uint64_t bytes_of_a_row(const std::string& group) const;
  void check_lengths(const std::string& group);
  void want(const std::string& group, std::size_t first, std::size_t count);

  void read_rows(std::uint64_t bytes);
  void read_groups(std::uint64_t bytes);
  void add_group(const std::string& group, std::span<io::Hdf5Values> values);
  void add(const std::string& group, std::size_t first, std::size_t rows,
           std::span<io::Hdf5Values> values);
  void repeat(const std::string& name, const std::string& text, std::size_t first,
              std::size_t rows);
  io::CsvColumn& column(const std::string& name, const std::string& unit, std::size_t first);

  io::Hdf5Reader in_;
  FaultList& faults_;
  std::vector<std::string> groups_;              // none: all columns are in the root group
  std::size_t next_ = 0;                         // row of the root group, or group
  std::size_t rows_before_ = 0;                  // in the pieces so far
  std::vector<io::Hdf5Slice> wanted_;            // of this piece
  io::CsvTable table_;                           // columns of all pieces, rows of this one
  std::map<std::string, std::size_t> number_of_; // of the columns, from 0
};

} // namespace frictab::data
