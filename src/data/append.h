// Files of a list as one campaign.
#pragma once

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::data {

// Appends `more`, of `file`, to `all`: same columns, text levels joined, experiments told apart.
void append(Dataset& all, Dataset&& more, const std::string& file, FaultList& faults);

} // namespace frictab::data
