// Files that are too large to be held, in parts of whole experiments.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "data/options.h"
#include "data/raw.h"

namespace frictab::data {

// Calls take() with raw tables of the file in turn, a few at a time, each of whole experiments in
// the order of the file. A part grows until its last experiment is in it. CSV and HDF5 are read in
// pieces; workbooks, UTF-16, skip_footer, data.join, data.wide and experiments that are intervals
// are read as a whole. `faults`: as read_raw; take() is not called behind some.
// Throws InputError at the line where an experiment comes again behind another one: rows are not
// gathered from all over a file that is not held.
using TakeParts = std::function<void(std::vector<io::CsvTable>&& parts)>;
void read_raw_parts(const std::string& path, const std::string& named, const DataOptions& options,
                    FaultList& faults, const TakeParts& take);

} // namespace frictab::data
