// Rows that the user wants left out, counted.
#pragma once

#include "data/options.h"
#include "data/part.h"
#include "data/phases.h"

namespace frictab::data {

// By data.drop.
void drop_rows(Part& part, const DataOptions& options);

// Rows with an empty cell, where the job leaves them out.
void drop_missing(Part& part, const DataOptions& options);

// Rows that are not sliding, kept in data.aside; all are counted in data.phases. A test of which
// none slides goes (data.at_rest).
void leave_out_phases(Part& part, const std::vector<Phase>& phases, const DataOptions& options);

// Rows that no rig can measure (plausibility.h), in data.apart.
void leave_out_impossible(Part& part, const DataOptions& options);

// Whether a campaign as a whole says that rows were left out which should not have been, or offsets
// taken off: `options` are then those with which it is to be read once more. Spikes in more than
// few rows are the scatter of its rows; where nothing slides, the speed says nothing.
bool look_again(const Dataset& data, DataOptions& options);

// A note of a whole campaign that its summary says as well.
void tell(Dataset& data, std::string intervention);
void tell_left_out(Dataset& data);

} // namespace frictab::data
