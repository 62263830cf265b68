// The numbers of a table as they stand in generated code, and how many these are.
#pragma once

#include <cstddef>
#include <vector>

#include "table/table.h"

namespace frictab::codegen {

// Whether the code needs the spline kernel: a cubic table with axes.
bool is_cubic(const table::Table& table);

// What the routine looks up, per node: values, or coefficients of the spline with the 2 zeros that
// its kernel reads behind them.
std::vector<double> baked_values(const table::Table& table);

// Numbers that the source of a table, or of its direct form, holds.
std::size_t baked_numbers(const table::Table& table);

} // namespace frictab::codegen
