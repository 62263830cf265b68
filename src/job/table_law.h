// A law of a job whose values come from a file (models/law_table.h).
#pragma once

#include <optional>

#include "core/error.h"
#include "models/law_table.h"
#include "models/law_text.h"

namespace frictab::job {

// Reads the file `path` (messages use that name): CSV, a workbook or HDF5 with a column per axis
// and one of mu or tau_R_MPa, a row per node in any order; or an HDF5 table in frictab's own
// layout. Adds every fault with its place, and then returns nothing. `place`: of the file's name in
// the job.
std::optional<models::LawTable> read_law_table(const models::LawText& text, const std::string& path,
                                               const Place& place, FaultList& faults);

} // namespace frictab::job
