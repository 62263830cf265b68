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

// One dimension scale per axis, one dataset `value`; xarray and h5py open it. Values that are
// stored elsewhere are copied piece by piece.
void write_table(const Table& table, const std::filesystem::path& file,
                 const io::Hdf5Storage& storage = {});

// Everything but the values, into a file that has `value` as its first dataset.
void write_description(io::Hdf5Writer& out, const Table& table);

// Bytes of values from which on a linear table stays in its file.
inline constexpr std::size_t most_bytes_in_memory = std::size_t{256} << 20;

// Reads what write_table writes, or a table made elsewhere in that layout. Throws InputError with
// every fault: missing attributes, axes not ascending, shapes that do not fit, a combine formula
// that does not parse or names unknown constants, values that are not finite. The values of a
// linear table of more than `in_memory` bytes are left in the file (Table::stored); those in chunks
// are unpacked into a nameless file beside it, which takes as much disk while the table lives.
Table read_table(const std::filesystem::path& file, std::size_t in_memory = most_bytes_in_memory);
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
