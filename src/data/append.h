// Files of a list as one campaign.
#pragma once

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::data {

// Appends `more`, of `file`, to `all`: same columns, text levels joined, experiments told apart.
void append(Dataset& all, Dataset&& more, const std::string& file, FaultList& faults);

// What is counted and told of `more` beside its rows: rows left out, phases, signs.
void absorb(Dataset& all, const Dataset& more);

// Adds up the rows that the same rule left out.
void add_dropped(Dataset& all, const std::vector<Dataset::Dropped>& more);

// Both as one campaign, of the columns that both have. An experiment of `second` that is called
// like one of `first` is another one: "A (2)".
Dataset together(const Dataset& first, const Dataset& second);

} // namespace frictab::data
