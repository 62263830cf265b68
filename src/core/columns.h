// Columns of numbers, as functions over rows take them.
#pragma once

#include <vector>

namespace frictab {

// Where each column begins; valid as long as the columns are.
inline std::vector<const double*> pointers(const std::vector<std::vector<double>>& columns) {
  std::vector<const double*> out;
  for (const auto& column : columns)
    out.push_back(column.data());
  return out;
}

} // namespace frictab
