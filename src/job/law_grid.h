// Conversion of rows in any order to a full grid: the nodes of the axes, and a value at each.
#pragma once

#include "job/law_columns.h"

namespace frictab::job {

// `raw`: the table from which the columns were read. Returns nothing, and adds a fault with its
// place for each, where the rows are not a full grid of at most models::most_law_nodes nodes: an
// axis with a single value or with nodes that nearly coincide, a node that is missing or
// duplicated.
std::optional<models::LawTable> full_grid(LawColumns columns, const io::CsvTable& raw,
                                          FaultList& faults);

} // namespace frictab::job
