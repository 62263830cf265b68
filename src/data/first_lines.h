// The first lines of a data file, for users whose file was not understood.
#pragma once

#include <string>

#include "data/options.h"

namespace frictab::data {

// The first eight lines of a text file or a sheet, each with its number of cells, of numbers, and
// the names of columns that the job knows. Empty for other files, and for those that cannot be
// read. `named`: as FilePlan::name.
std::string first_lines(const std::string& named, const DataOptions& options);

} // namespace frictab::data
