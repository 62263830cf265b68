// From rows in any order to a full grid: the nodes of the axes, and a value at each.
#pragma once

#include "job/law_columns.h"

namespace frictab::job {

// `raw` is where the columns were read. Nothing, and a fault with its place for each, where the
// rows are no full grid of at most models::most_law_nodes nodes: an axis of one value or with nodes
// as good as one, a node that is missing or stands twice.
std::optional<models::LawTable> full_grid(LawColumns columns, const io::CsvTable& raw,
                                          FaultList& faults);

} // namespace frictab::job
