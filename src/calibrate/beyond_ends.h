// Rows beyond the ends at which a law is held: those of its nodes where it is a table, of its data
// where it is a polynomial.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/input_columns.h"
#include "models/law.h"

namespace frictab::calibrate {

// Of a law, counted over one or several datasets. A block of condensed rows counts as its rows.
struct RowsBeyond {
  std::map<std::string, std::pair<std::size_t, std::size_t>> sides; // below, above, by input
  std::size_t any = 0, rows = 0;

  // `names` are those of the columns.
  void add(const models::Law& law, const std::vector<std::string>& names,
           const InputColumns& columns, const data::Dataset& data);
  void add(const RowsBeyond& more);
  // "12 of 4,000 training rows lie beyond the ends at which the law is held: v_rel_mm_s above 200
  // (12)"; none where no row does, and of laws that are held nowhere. `data`: what the rows are
  // called.
  std::vector<std::string> told(const models::Law& law, const std::string& data) const;
};

} // namespace frictab::calibrate
