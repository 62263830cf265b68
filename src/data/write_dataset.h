// Writes a campaign as CSV or HDF5 columns.
#pragma once

#include <filesystem>
#include <string>

#include "data/dataset.h"

namespace frictab::data {

// One header line, one line per row: `experiment` first, then the columns in their order. Numbers
// in the shortest text that reads back to the same bits; text is quoted if necessary.
std::string csv_text(const Dataset& data);

// One 1-D dataset per column under its name (with attribute `units` if it has one), text columns
// and `experiment` as UTF-8 text; root attribute `source` = "frictab". Throws std::runtime_error if
// the disk fails.
void write_hdf5_columns(const Dataset& data, const std::filesystem::path& file);

} // namespace frictab::data
