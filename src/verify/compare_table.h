// Compares a table's file, attribute by attribute, with the table that it should hold.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "models/assembled_law.h"
#include "table/table.h"
#include "verify/finding.h"

namespace frictab::verify {

// Returns every dataset and attribute of the file that differs from what write_table writes for
// `wanted`: numbers by more than 1e-9 of themselves, texts at all. What the writer does not know is
// a note. Model and mend are left empty. Throws InputError if the file cannot be read.
std::vector<Finding> compare_table(const std::filesystem::path& file, const table::Table& wanted);

// True for the attributes that say how far the table drifts.
bool is_drift_figure(const Finding& finding);

// Returns the table that the file should hold as far as a model file alone determines it: the law's
// values at the table's nodes, its formulas, constants, units and texts. What depends on the job
// and on the data of the tests (nodes, ends and what holds beyond them, the tolerance) is taken
// from `table`, which was read from `file`.
table::Table table_of_model(const models::AssembledLaw& law, const calibrate::ModelFit& fit,
                            const table::Table& table, const std::filesystem::path& file);

} // namespace frictab::verify
