// A file's columns before they get canonical names: the common form of CSV, workbooks and HDF5.
#pragma once

#include <string>
#include <string_view>

#include "core/error.h"
#include "data/options.h"
#include "io/csv.h"

namespace frictab::data {

// Place of a raw table's row for messages: file:line, or only the file with the row number in
// `what`.
Place row_place(const io::CsvTable& table, std::size_t row, std::size_t column = 0);

// Reads LabVIEW, TDMS and MATLAB files (data/rig_files.h), CSV, a sheet of a workbook (the first
// name of DataOptions::sheets, else the first sheet), or HDF5 if the file has its signature, with
// one dataset per column, or one group of such datasets per experiment, whose attributes are
// columns as well (then `line` counts rows from 1 and header_line is 0).
io::CsvTable read_raw(const std::string& path, const std::string& named, const DataOptions& options,
                      FaultList& faults);

// Whole lines from the start of a text, about 64 KiB.
std::string_view head_of(std::string_view text);

// Format in which read_raw parses text. `path`: a workbook has its own format.
io::CsvFormat csv_format(const std::string& path, const DataOptions& options);

} // namespace frictab::data
