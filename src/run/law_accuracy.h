// Inputs of a law's tables: the tests it was fitted to, its error on unseen tests, and the drift
// that its tables may have.
#pragma once

#include <string>

#include "run/run.h"
#include "table/options.h"
#include "table/tolerance.h"
#include "verify/verify.h"

namespace frictab::run {

// Returns the model of a table of this run, at the table's quantile. Throws InputError if the
// calibration does not have it.
models::Model model_of(const Run& run, const table::Table& table);
// The same with its formulas written out.
models::AssembledLaw law_of(const Run& run, const table::Table& table);

// The tests that the delivered law was fitted to; its tables take their ranges from them.
const data::Dataset& fitted_tests(const Run& run, const models::Model& model);

// The drift that the job allows its tables (verify.max_drift_MPa, otherwise the tolerance they are
// built to).
table::Tolerance drift_allowed(const Run& run, const models::Model& model);

// [table] of the job, with the tolerance for this law.
table::TableOptions table_options(const Run& run, const models::Model& model);

// `name`: the table's name in messages.
verify::VerifyInput verify_input(const Run& run, const models::AssembledLaw& law,
                                 const table::Table& table, const std::string& name);

// The law in the form from which solvers' own tables are made: sampling a table instead would add
// that table's drift to theirs. Keeps the table's tolerance.
table::Table direct_with_tolerance(const models::AssembledLaw& law, const table::Table& table);

} // namespace frictab::run
