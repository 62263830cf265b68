// Rows that the user wants left out, counted.
#pragma once

#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// By data.drop.
void drop_rows(Part& part, const DataOptions& options);

// Rows with an empty cell, where the job leaves them out.
void drop_missing(Part& part, const DataOptions& options);

} // namespace frictab::data
