// A calibrated law as tables take it: the tests it was fitted to, its error on unseen tests, and
// the drift that a table of it may have.
#pragma once

#include <string>

#include "run/run.h"
#include "table/options.h"
#include "table/tolerance.h"
#include "verify/verify.h"

namespace frictab::run {

// The law of a table of this run, with the table's quantile. Throws InputError where the
// calibration does not have it.
models::AssembledLaw law_of(const Run& run, const table::Table& table);

// The tests that the delivered law was fitted to: its tables reach what they reach.
const data::Dataset& fitted_tests(const Run& run, const models::Model& model);

// The drift that the job allows its tables (verify.max_drift_MPa, else what they are made to).
table::Tolerance drift_allowed(const Run& run, const models::Model& model);

// [table] of the job, with the tolerance for this law.
table::TableOptions table_options(const Run& run, const models::Model& model);

// `name` is how messages call the table.
verify::VerifyInput verify_input(const Run& run, const models::AssembledLaw& law,
                                 const table::Table& table, const std::string& name);

// Solvers' own tables are made from the law itself: made from a table they would add its drift to
// their own. They keep its tolerance.
table::Table direct_form(const models::AssembledLaw& law, const table::Table& table);

} // namespace frictab::run
