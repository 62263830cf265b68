// Rows left out at the user's request, counted.
#pragma once

#include <span>

#include "data/options.h"
#include "data/part.h"
#include "data/phases.h"

namespace frictab::data {

// Leaves out rows by data.drop.
void drop_rows(Part& part, const Reading& options);
// Adds a fault for each text of data.drop that no row of the campaign had.
void check_texts_to_drop(std::span<const Dataset* const> parts, const DataOptions& options,
                         FaultList& faults);

// Adds a fault for each column of data.fill_down that the campaign does not have.
void check_filled_columns(std::span<const Dataset* const> parts, const DataOptions& options,
                          FaultList& faults);

// Leaves out rows with an empty cell if the job asks for it; the first one alone those that the
// file itself holds, before anything is computed from neighbouring rows.
void drop_empty_rows(Part& part, const Reading& options);
void drop_missing(Part& part, const Reading& options);

// Leaves out rows that are not sliding and keeps them in data.aside; counts all rows in
// data.phases. A test without a sliding row is left out (data.at_rest).
void leave_out_phases(Part& part, const std::vector<Phase>& phases, const Reading& options);

// Leaves out rows that no rig can measure (plausibility.h), recorded in data.apart.
void leave_out_impossible(Part& part, const Reading& options);

// True if the whole campaign shows that rows should not have been left out, or offsets not
// subtracted; `options` are then set for a second reading. Spikes in more than a few rows are
// ordinary scatter; if nothing slides, the speed is not usable.
bool look_again(const Dataset& data, Reading& options);

// Adds a note on the whole campaign that its summary repeats.
void tell(Dataset& data, std::string intervention);
void report_rows_left_out(Dataset& data);

} // namespace frictab::data
