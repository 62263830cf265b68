// A law of a job that is a table in a file (models/law_table.h).
#pragma once

#include <optional>

#include "core/error.h"
#include "models/law_table.h"
#include "models/law_text.h"

namespace frictab::job {

// Reads `path`, which messages call so: CSV, a workbook or HDF5 with a column per axis and one of
// mu or tau_R_MPa, a row per node in any order; or an HDF5 table of frictab's own layout. Every
// fault is added with its place, and then there is no table. `place` is where the job names it.
std::optional<models::LawTable> read_law_table(const models::LawText& text, const std::string& path,
                                               const Place& place, FaultList& faults);

} // namespace frictab::job
