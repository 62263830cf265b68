// Files larger than memory, in parts of whole experiments.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "data/options.h"
#include "data/raw.h"

namespace frictab::data {

// Calls take() with raw tables of the file in order, a few at a time, each of whole experiments. A
// part grows until its last experiment is complete. CSV and HDF5 are read in pieces; workbooks,
// files of measuring programs, UTF-16, skip_footer, data.join, data.wide and experiments that are
// intervals are read as a whole. `faults`: as read_raw; after a fault take() is not called again.
// Throws InputError at the line where an experiment appears again after another one: rows are not
// gathered from all over a file that is not in memory.
using TakeParts = std::function<void(std::vector<io::CsvTable>&& parts)>;
void read_raw_parts(const std::string& path, const std::string& named, const Reading& options,
                    FaultList& faults, const TakeParts& take);

} // namespace frictab::data
