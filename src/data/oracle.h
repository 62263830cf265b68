// Ground truth of synthetic data: noise-free stress from separate files.
#pragma once

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// Fills oracle_MPa of both parts from options.oracle (columns experiment, row from 1 in steps of 1,
// tau_oracle_MPa in MPa; HDF5, or CSV as `frictab twin --oracle` writes it). A part without any
// experiment in these files gets none. Throws InputError if the rows of an experiment do not match.
void read_oracle(const DataOptions& options, Dataset& training, Dataset& validation);

} // namespace frictab::data
