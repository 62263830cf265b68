// The columns of a file with a law that is a table: axes and one of mu or tau_R_MPa, not yet a
// grid.
#pragma once

#include <optional>
#include <vector>

#include "core/error.h"
#include "io/csv.h"
#include "models/law_table.h"

namespace frictab::job {

struct LawColumns {
  models::LawTable table;                     // its quantity, its axes without nodes
  std::vector<std::vector<double>> positions; // by axis and row, in canonical units
  std::vector<double> value;                  // by row, MPa or 1
};

// Units of the header are converted. Nothing, and a fault with its place for each, where a column
// is missing, stands twice or is no axis, a unit does not convert, or a cell is no number, too
// large, or below what its quantity can be.
std::optional<LawColumns> read_law_columns(const io::CsvTable& raw, FaultList& faults);

} // namespace frictab::job
