// Samples a calibrated law onto a grid that is made to a tolerance.
#pragma once

#include <optional>

#include "data/dataset.h"
#include "models/assembled_law.h"
#include "table/options.h"
#include "table/table.h"

namespace frictab::table {

// The range of one state over which a table holds and is verified.
struct StateRange {
  std::string name;
  double low = 0;
  double high = 0;
  std::string why; // "job file", "Table 1 and training data", "training data", ...
  std::optional<std::pair<double, double>> data = {}; // what the training data reach, where known
  // What holds below, where the job does not say it, and why not what usually does.
  std::optional<Outside> below = {};
  std::string why_held = {};
};

// Ranges of all inputs of the model, canonical order: the job's; else, where options.range is
// table1, Table 1 joined with the training data where they cover at least half of it; else the
// training data's own (a single value is widened by 1 %). Flow stress: half the smallest to twice
// the largest. Where the law is known too badly a tenth below the end at which it would go on
// (calibrate/stress_error.h), it is held there. Throws InputError for a job range in which the
// quantity has no meaning.
std::vector<StateRange> state_ranges(const models::AssembledLaw& law, const data::Dataset& training,
                                     const TableOptions& options);

// The table of one model: axes only where its smooth piece depends on them, nodes per axis so that
// the drift over the ranges stays below options.tolerance_MPa (or the job's own nodes). Throws
// InputError where the grid does not fit into memory.
Table build_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                  const TableOptions& options);

// Ranges that a table carries in its attributes; for a foreign table its axes' own and, for other
// inputs, those of `data` where it has the column. Throws InputError where there is neither.
std::vector<StateRange> table_ranges(const Table& table, const data::Dataset* data,
                                     const std::string& file);

} // namespace frictab::table
