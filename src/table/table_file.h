// Tables as netCDF-4-compatible HDF5, in the layout of the outside contract.
#pragma once

#include <filesystem>

#include "io/hdf5.h"
#include "table/table.h"

namespace frictab::table {

// Model name of a table whose file has none, as in file names and comments.
inline constexpr const char* foreign_model = "foreign";

// Root attributes of the table's file, without its schema: the record and the model.
TableAttributes root_attributes(const Table& table);

// Writes one dimension scale per axis and one dataset `value`; xarray and h5py open it.
void write_table(const Table& table, const std::filesystem::path& file,
                 const io::Hdf5Storage& storage = {});

// Reads a table as write_table writes it, or one made elsewhere in that layout. Throws InputError
// with every fault: missing attributes, axes not ascending, shapes that do not fit, a combine
// formula that does not parse or names unknown constants, values that are not finite or do not fit
// into memory.
Table read_table(const std::filesystem::path& file);
// Builds the same from contents that a child process has read; messages call the file `named`.
Table read_table(const io::Hdf5Contents& contents, const std::string& named);

// The table without values, and its storage layout.
struct TableDescription {
  Table table; // without values
  io::Hdf5Layout layout;
  std::uint64_t file_bytes = 0;
};
TableDescription read_description(const std::filesystem::path& file);

} // namespace frictab::table
