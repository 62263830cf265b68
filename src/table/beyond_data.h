// Nodes of a table at states where the law has no data and therefore extrapolates.
#pragma once

#include <cstddef>
#include <string>

#include "table/table.h"

namespace frictab::table {

// Counts the nodes outside TableAxis::data; 0 where that range is not known.
std::size_t nodes_beyond_data(const TableAxis& axis);
double share_beyond_data(const TableAxis& axis); // share of the axis' nodes, 0 .. 1

// "8 of 17 nodes (47 %) beyond the data: from 10.3 up to 20": the count, and the interval from the
// end of the data to the end of the axis. Empty where all nodes are within the data.
std::string beyond_data_text(const TableAxis& axis);

} // namespace frictab::table
