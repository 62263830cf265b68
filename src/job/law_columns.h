// The columns of a file with a tabulated law, not yet a grid: axes and one of mu or tau_R_MPa.
#pragma once

#include <optional>
#include <vector>

#include "core/error.h"
#include "io/csv.h"
#include "models/law_table.h"

namespace frictab::job {

struct LawColumns {
  models::LawTable table;                     // quantity, and axes without nodes
  std::vector<std::vector<double>> positions; // by axis and row, in canonical units
  std::vector<double> value;                  // by row, MPa or 1
};

// Reads the columns and converts their units from the header. Returns nothing, and adds a fault
// with its place for each, where a column is missing, duplicated or not a possible axis, a unit
// does not convert, or a cell is not a number, too large, or below the least value of its quantity.
std::optional<LawColumns> read_law_columns(const io::CsvTable& raw, FaultList& faults);

} // namespace frictab::job
