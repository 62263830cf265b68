// Reads tribometer files (CSV as rigs write them, HDF5 columns) into a Dataset.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// Reads and joins `files` (names, globs and folders, relative to options.base) with the mapping of
// the job. Afterwards there is tau_R_MPa (measured, or eq. 1: F_R/F_N*sigma_N) and s_mm where v and
// t allow it. Where no column says more, every file is one experiment of its name. Throws
// InputError listing the faults of every file: each with file:line:col, the first 20 in full.
Dataset load_dataset(const std::vector<std::string>& files, const DataOptions& options);

} // namespace frictab::data
