// Samples a calibrated law onto a grid that is made to a tolerance.
#pragma once

#include <optional>

#include "data/dataset.h"
#include "models/assembled_law.h"
#include "table/options.h"
#include "table/table.h"

namespace frictab::table {

// The range of one state that a table covers and for which it is verified.
struct StateRange {
  std::string name;
  double low = 0;
  double high = 0;
  std::string why; // "job file", "Table 1 and training data", "training data", ...
  std::optional<std::pair<double, double>> data = {}; // range of the training data, if known
  // The answer below `low` where the job does not give one, and the reason why it is not the usual
  // one (usual_below in table/outside.h).
  std::optional<Outside> below = {};
  std::string why_held = {};
};

// Ranges of all inputs of the model, in canonical order. A range from the job comes first.
// Otherwise it is the range of the training data (a single value is widened by 1 %); with
// options.range = "table1" it is joined with Table 1 where the data cover at least half of that.
// Flow stress: half the smallest to twice the largest value. Where the law usually continues below
// the range, but its standard error at a tenth of the low end is too large
// (calibrate/stress_error.h), the state is clamped there. Throws InputError for a job range in
// which the quantity has no meaning.
std::vector<StateRange> state_ranges(const models::AssembledLaw& law, const data::Dataset& training,
                                     const TableOptions& options);

// Builds the table of one model. It has an axis only for inputs of the smooth piece. Throws
// InputError where the grid does not fit into memory.
//
// How the grid is found: interpolation errors of the axes add up, so that the tolerance is shared
// out. If errors fall with a power of the spacing, equal targets need the fewest nodes; so every
// axis first gets the same target for its error in tau_R, which is measured in the middle of its
// cells along lines through the box of states (table/grid.h). Along each axis nodes are made dense
// where the error is large, and the fewest cells that meet the target are taken. Then the whole
// table is sampled and its largest drift from the law is searched for, at cell centres, at Halton
// points and by local ascent. The ratio of drift to tolerance corrects the target for the next
// round, and the worst states become further lines along which the axes are measured. The search
// ends after 12 rounds, when the drift is between 85 % and 100 % of the limit (0.96 of the
// tolerance, because the search may miss the very worst state), when the grid no longer changes, or
// when the target is bracketed to 5 %. Last, each axis gives up cells for as long as the drift
// stays within the limit. If a last search among ten times as many states finds more than the
// tolerance, all is done again to a smaller limit. Node counts that the job gives are left as they
// are. With table.nodes or table.max_bytes the same search finds the grid of smallest drift within
// the budget.
Table build_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                  const TableOptions& options);

// Makes a table again on the nodes of `grid`: the choice of nodes, its description in the record,
// and an interpolation that the options leave open are those of `grid`; all else comes from the
// law, the ranges and the options.
Table table_on_nodes(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                     const TableOptions& options, const Table& grid);

// Ranges that a table carries in its attributes. For a foreign table: those of its axes and, for
// other inputs, those of `data` if it has the column. Throws InputError where neither is available.
std::vector<StateRange> table_ranges(const Table& table, const data::Dataset* data,
                                     const std::string& file);

} // namespace frictab::table
