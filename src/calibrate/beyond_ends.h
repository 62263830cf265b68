// Rows beyond the ends at which a law is held: those of its nodes where it is a table, of its data
// where it is a polynomial.
#pragma once

#include <string>
#include <vector>

#include "calibrate/input_columns.h"
#include "models/law.h"

namespace frictab::calibrate {

// "12 of 4,000 training rows lie beyond the ends at which the law is held: v_rel_mm_s above 200
// (12)"; none where no row does, and of laws that are held nowhere. `names`
// are those of the columns, `data` what the rows are called.
std::vector<std::string> rows_beyond_ends(const models::Law& law,
                                          const std::vector<std::string>& names,
                                          const InputColumns& columns, std::size_t rows,
                                          const std::string& data);

} // namespace frictab::calibrate
