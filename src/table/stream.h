// Tables larger than memory: sampled in chunks straight to disk, resumed after a kill.
//
// Beside NAME.h5 stand, until the table is complete, the work file .NAME.h5.partial (values from
// its first MiB on) and the list of finished chunks .NAME.h5.chunks (number and XXH3 hash, one line
// each, below a line that names law, parameters and grid by their hash).
#pragma once

#include <filesystem>

#include "table/build.h"
#include "table/options.h"

namespace frictab::table {

// A linear table whose nodes the job fixes on every axis and whose values take more than
// options.memory_limit_MiB, and more than 1 MiB, is streamed. Throws InputError where it is cubic:
// the coefficients of a spline follow from all values at once.
bool is_streamed(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                 const TableOptions& options);

struct StreamedTable {
  Table table; // its values are in the work file
  std::size_t chunks = 0;
  std::size_t kept = 0; // of them from an interrupted run of the same job
};

// Samples the table that is to become `file`. Chunks that an interrupted run of the same law,
// parameters, grid and version of frictab has finished, and whose bytes still have their hash, are
// kept. The values have the same bytes on any number of threads and however often interrupted.
// Throws InputError where the disk has no room (before anything is written), where another process
// writes the same table, or where the law is not finite at a node.
StreamedTable stream_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                           const TableOptions& options, const std::filesystem::path& file);

// Makes a complete table file of the work file and the attributes that `table` has by now, and
// gives its path, to be renamed to `file`.
std::filesystem::path finish_stream(const Table& table, const io::Hdf5Storage& storage,
                                    const std::filesystem::path& file);

// The names, without directory, of all work files of a table file of this name.
std::vector<std::string> work_files(const std::string& file_name);

} // namespace frictab::table
