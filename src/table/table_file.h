// Tables as netCDF-4-compatible HDF5, in the layout of the outside contract.
#pragma once

#include <filesystem>

#include "table/table.h"

namespace frictab {

// One dimension scale per axis, one dataset `value`; xarray and h5py open it.
void write_table(const Table& table, const std::filesystem::path& file, int compress = 0);

// Reads what write_table writes, or a table made elsewhere in that layout. Throws InputError with
// every fault: missing attributes, axes not ascending, shapes that do not fit, a combine formula
// that does not parse or names unknown constants, values that are not finite.
Table read_table(const std::filesystem::path& file);

} // namespace frictab
