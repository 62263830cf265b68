// Columns of numbers in the form that row functions take.
#pragma once

#include <vector>

namespace frictab {

// Returns a pointer to the start of each column, valid as long as the columns live.
inline std::vector<const double*> pointers(const std::vector<std::vector<double>>& columns) {
  std::vector<const double*> out;
  for (const auto& column : columns)
    out.push_back(column.data());
  return out;
}

} // namespace frictab
