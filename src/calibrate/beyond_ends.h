// Rows outside the range to which a law clamps its inputs: the range of its nodes for a table, of
// its data for a polynomial.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/input_columns.h"
#include "models/law.h"

namespace frictab::calibrate {

// Counts for one law, over one or several datasets. A block of condensed rows counts as the rows it
// represents.
struct RowsBeyond {
  std::map<std::string, std::pair<std::size_t, std::size_t>> sides; // below, above, by input
  std::size_t any = 0, rows = 0;

  // Adds the rows of a dataset. `names` are those of the columns.
  void add(const models::Law& law, const std::vector<std::string>& names,
           const InputColumns& columns, const data::Dataset& data);
  void add(const RowsBeyond& more);
  // Formats the counts: "12 of 4,000 training rows lie beyond the ends at which the law is held:
  // v_rel_mm_s above 200 (12)". Empty if no row lies outside, or the law does not clamp. `data`:
  // name of the rows.
  std::vector<std::string> told(const models::Law& law, const std::string& data) const;
};

} // namespace frictab::calibrate
