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

  // Adds the rows of a dataset.
  void add(const models::Law& law, const InputColumns& columns, const data::Dataset& data);
  void add(const RowsBeyond& more);
  // Adds a remark such as "12 of 4,000 training rows lie beyond the ends at which the law is held:
  // v_rel_mm_s above 200 (12)"; none if no row lies outside, or the law does not clamp. `rows_of`:
  // name of the rows.
  void add_remark(std::vector<std::string>& remarks, const models::Law& law,
                  const char* rows_of) const;
};

} // namespace frictab::calibrate
