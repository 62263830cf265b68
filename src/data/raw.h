// A file's columns before they have canonical names: the common ground of CSV, workbooks and HDF5.
#pragma once

#include "core/error.h"
#include "data/options.h"
#include "io/csv.h"

namespace frictab::data {

// Where a row of a raw table stands, for messages: file:line, or file with the row number in
// `what`.
Place row_place(const io::CsvTable& table, std::size_t row, std::size_t column = 0);

// The text of a file that is no HDF5; of a workbook (.xlsx) that of a sheet (empty: the first one)
// as CSV with commas and points.
std::string raw_text(const std::string& path, const std::string& named, const std::string& sheet);
bool is_workbook(const std::string& path);

// CSV; a sheet of a workbook (.xlsx); or HDF5 where the file starts like it, with one dataset per
// column, or one group of such datasets per experiment, whose attributes are columns as well (then
// `line` counts rows from 1 and header_line is 0).
io::CsvTable read_raw(const std::string& path, const std::string& named, const DataOptions& options,
                      FaultList& faults);

// How read_raw reads text. `path`: a workbook has a format of its own.
io::CsvFormat csv_format(const std::string& path, const DataOptions& options);

} // namespace frictab::data
