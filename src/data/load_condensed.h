// Campaigns too large to be held: read one experiment at a time, and held as blocks.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// data.condense = "auto": nothing is condensed up to many_rows in all, which take 5 GB. Above, an
// experiment has fine_blocks, over which no law of a stroke bends; half as many as often as all
// experiments together would have more than most_blocks, but not below coarse_blocks. Numbers of
// blocks that are multiples of 11 cut where the bins of the neural network end.
inline constexpr std::size_t many_rows = 10'000'000, most_blocks = 500'000;
inline constexpr std::size_t fine_blocks = 3520, coarse_blocks = 55;

// Blocks per experiment of a campaign of these files, at most; 0: its rows are held. The rows of a
// large file are estimated from its first lines, or told by its shape.
std::size_t blocks_to_condense(const DataOptions& options);

// As load_dataset, but that rows become blocks experiment by experiment (data/condense.h); fewer
// than `blocks` where options.condense is "auto" and there are many experiments. What is
// implausible is counted part by part. Notes that differ in numbers alone are told once, with the
// sums of these. Parts of a file hold whole experiments (data/raw_parts.h).
Dataset load_condensed(const std::vector<std::string>& files, const DataOptions& options,
                       std::size_t blocks);

} // namespace frictab::data
