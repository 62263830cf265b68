// Combines the files of a list into one campaign.
#pragma once

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::data {

// Appends `more`, read from `file`, to `all`: the columns must be the same, text levels are merged,
// and experiments with equal names get different ones.
void append(Dataset& all, Dataset&& more, const std::string& file, FaultList& faults);

// Adds the counts and notes of `more` to `all`, without its rows: rows left out, phases, signs.
void absorb(Dataset& all, const Dataset& more);

// Adds up the rows left out by the same rule.
void add_dropped(Dataset& all, const std::vector<Dataset::Dropped>& more);

// Combines two campaigns, with the columns that both have. An experiment of `second` that has the
// name of one in `first` is a different test: "A (2)".
Dataset together(const Dataset& first, const Dataset& second);

} // namespace frictab::data
