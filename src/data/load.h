// Reads tribometer files (CSV as rigs write them, HDF5 columns) into a Dataset.
#pragma once

#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// Reads and joins `files` (names, globs and folders, relative to options.base) with the mapping of
// the job. The result has tau_R_MPa (measured, or eq. 1: F_R/F_N*sigma_N), and s_mm if v and t
// allow it. Without a column that names experiments, every file is one experiment with the file's
// name. Throws InputError that lists the faults of every file, each with file:line:col, the first
// 20 in full.
Dataset load_dataset(const std::vector<std::string>& files, const ReadRequest& options);

// Reads and joins files of a simulation: mapped, computed and checked like those of tests, but
// without what is inferred about tests (signs, phases, eq. 1, the sliding distance). Their
// canonical columns are options.quantities. Throws as load_dataset does.
Dataset load_rows(const std::vector<std::string>& files, const ReadRequest& options);

} // namespace frictab::data
