// Nodes of a table at states where its law has seen no data: there the law extrapolates.
#pragma once

#include <cstddef>
#include <string>

#include "table/table.h"

namespace frictab::table {

// Nodes below the least or above the largest value of TableAxis::data; 0 where that is not known.
std::size_t nodes_beyond_data(const TableAxis& axis);
double share_beyond_data(const TableAxis& axis); // of its nodes, 0 .. 1

// "8 of 17 nodes (47 %) beyond the data: from 10.3 up to 20": how many, and from where the data end
// to where the axis does. Empty where no node is.
std::string beyond_data_text(const TableAxis& axis);

} // namespace frictab::table
