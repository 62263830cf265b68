// Conditions that a rig writes above the rows of a file ("Normal load: 5 N") as columns.
#pragma once

#include "core/error.h"
#include "data/options.h"
#include "io/csv.h"

namespace frictab::data {

// Number and unit of a value above the rows ("5 [N]", "20 mm/s", "0,1"); a text if it is not a
// number alone or with a known unit.
struct ValueAbove {
  bool is_number = false;
  double number = 0;
  std::string unit; // empty: none is given
};
ValueAbove read_value_above(const std::string& text, char decimal);

// Adds those that the job maps, uses in formulas or lists in data.above, and states and F_N_N by
// their canonical names, as columns with one value in every row; columns of the file come first.
// Adds a fault for each name in data.above that the file does not have.
void add_values_above(io::CsvTable& raw, const Reading& options, FaultList& faults);

} // namespace frictab::data
