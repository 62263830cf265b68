// The numbers of a table as generated code contains them, and their count.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "table/table.h"

namespace frictab::codegen {

// True if the code needs the spline kernel: for a cubic table with axes.
bool is_cubic(const table::Table& table);

// Returns the numbers that the routine looks up, per node: values, or spline coefficients followed
// by the 2 zeros that the kernel reads past their end.
std::vector<double> baked_values(const table::Table& table);

// Describes them: "ln mu, last axis fastest"; `coefficients`: words before those of a spline.
std::string baked_values_text(const table::Table& table, const std::string& coefficients);

// Count of the numbers in the source of a table, or of its direct form.
std::size_t baked_numbers(const table::Table& table);

} // namespace frictab::codegen
