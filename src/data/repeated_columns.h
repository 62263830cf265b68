// Recorded columns that say nothing of their own: copies of others, and names that people give to
// combinations of settings. They would explain all that those do, and could not be set to anything
// new.
#pragma once

#include <span>

#include "data/dataset.h"

namespace frictab::data {

// Sets the role of such columns to ignore; all columns have their roles already.
void ignore_repeated_columns(std::span<Dataset* const> parts);

} // namespace frictab::data
