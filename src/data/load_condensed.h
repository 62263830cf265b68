// Campaigns larger than memory: read one experiment at a time and stored as blocks.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// Defaults of data.condense = "auto". Up to many_rows in total, which take 5 GB, nothing is
// condensed. Above, each experiment gets fine_blocks, over which no law of a stroke bends; this
// number is halved until all experiments together have at most most_blocks, but not below
// coarse_blocks. Numbers of blocks are multiples of 11, so that they end at the bins of the neural
// network.
inline constexpr std::size_t many_rows = 10'000'000, most_blocks = 500'000;
inline constexpr std::size_t fine_blocks = 3520, coarse_blocks = 55;

// Largest number of blocks per experiment for these files; 0: rows stay in memory. The number of
// rows of a large file is estimated from its first lines, or known from its shape.
std::size_t blocks_to_condense(const DataOptions& options);

// Works like load_dataset, except that rows become blocks experiment by experiment
// (data/condense.h); fewer than `blocks` if options.condense is "auto" and there are many
// experiments. Implausible rows are counted part by part. Notes that differ only in numbers are
// reported once, with the sums of these numbers. Parts of a file consist of whole experiments
// (data/raw_parts.h).
Dataset load_condensed(const std::vector<std::string>& files, const ReadRequest& options,
                       std::size_t blocks);

} // namespace frictab::data
