// Tables larger than memory: sampled in chunks straight to disk, resumed after a kill.
//
// Beside NAME.h5 stand, until the table is complete, the work file .NAME.h5.partial (values from
// its first MiB on) and the list of finished chunks .NAME.h5.chunks (number and XXH3 hash, one line
// each, below a line that names law, parameters and grid by their hash). Several processes may
// sample shards of it, on one machine or on many that share the directory: each writes its chunks
// into the same work file, where no two overlap, and lists them in .NAME.h5.chunks.3-of-8, so that
// nothing is locked and a kill loses no more than the chunks that were not finished. Who completes
// the table reads all lists, checks every hash and samples what is missing.
#pragma once

#include <filesystem>

#include "core/shard.h"
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
  std::size_t kept = 0; // of them from shards, or from an interrupted run of the same job
};

// Samples the table that is to become `file`. Chunks that shards or an interrupted run of the same
// law, parameters, grid and version of frictab have finished, and whose bytes still have their
// hash, are kept. The values have the same bytes on any number of threads and however often
// interrupted. Throws InputError where the disk has no room (before anything is written), where
// another process writes the same table, or where the law is not finite at a node.
StreamedTable stream_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                           const TableOptions& options, const std::filesystem::path& file);

struct SampledShard {
  std::size_t chunks = 0, nodes = 0; // of the shard
  std::size_t kept = 0;              // of its chunks: they were there
};

// Samples every n-th chunk into the work file of `file`; stream_table() takes them up. Throws
// InputError as it does, and where another process samples the table for another job.
SampledShard sample_shard(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                          const TableOptions& options, const std::filesystem::path& file,
                          const Shard& shard);

// Makes a complete table file of the work file and the attributes that `table` has by now, and
// gives its path, to be renamed to `file`.
std::filesystem::path finish_stream(const Table& table, const io::Hdf5Storage& storage,
                                    const std::filesystem::path& file);

// The names, without directory, of all work files that a table file may have, and of the lists of
// shards that are there.
std::vector<std::string> work_files(const std::filesystem::path& file);

} // namespace frictab::table
