// Compares the results of earlier runs with what this job makes: models with the calibration,
// tables with their laws, generated files with their tables. verify, a gate, proves by it that what
// is handed on is what was made.
#pragma once

#include "run/run.h"

namespace frictab::run {

// Throws InputError that names all results which a verification needs and which are missing: models
// of the calibration, tables of table.model, files of recipes.
void check_all_there(const Run& run);

// Compare results that were loaded, not made by this command.
std::vector<verify::Finding> compare_models(const Run& run);
// `drift`: the table's record as it was verified now.
std::vector<verify::Finding> compare_table(const Run& run, const models::AssembledLaw& law,
                                           const table::Table& table,
                                           const verify::DriftRecord& drift);
// `differs`: the table itself differs from what it was made from.
std::vector<verify::Finding> compare_sources(const Run& run, const models::AssembledLaw& law,
                                             const table::Table& table, bool differs);

} // namespace frictab::run
