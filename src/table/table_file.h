// Tables as netCDF-4-compatible HDF5, in the layout of the outside contract.
#pragma once

#include <filesystem>

#include "io/hdf5.h"
#include "table/table.h"

namespace frictab::table {

// The model of a table whose file names none, as in file names and comments.
inline constexpr const char* foreign_model = "foreign";

// Root attributes of the table's file, but for its schema: the record and the model.
TableAttributes root_attributes(const Table& table);

// One dimension scale per axis, one dataset `value`; xarray and h5py open it.
void write_table(const Table& table, const std::filesystem::path& file,
                 const io::Hdf5Storage& storage = {});

// Reads what write_table writes, or a table made elsewhere in that layout. Throws InputError with
// every fault: missing attributes, axes not ascending, shapes that do not fit, a combine formula
// that does not parse or names unknown constants, values that are not finite or do not fit into
// memory.
Table read_table(const std::filesystem::path& file);
// The same of what a child has read in the file; `named` is how messages call it.
Table read_table(const io::Hdf5Contents& contents, const std::string& named);

// The same without values, and how they lie in the file.
struct TableDescription {
  Table table; // no values
  io::Hdf5Layout layout;
  std::uint64_t file_bytes = 0;
};
TableDescription read_description(const std::filesystem::path& file);

} // namespace frictab::table
