// What the steps of a law's formula are called in generated code. By their structure, since a table
// read from disk knows its formula and no law: the logarithm of a state is ln_v_rel, a number times
// the flow stress is k, what tau_R is held under is limit, the factor of the first traced effect is
// e1_humidity_pct. Names change no operation and no order.
#pragma once

#include <string>
#include <vector>

#include "codegen/statements.h"
#include "table/table.h"

namespace frictab::codegen {

// The state without its unit: sigma_n of sigma_n_MPa.
std::string short_name(const std::string& state);

// Of tables of a coefficient mu, of others the law's stress before any limit: tau_law.
std::string value_name(const table::Table& table);

// By nodes of these formulas, which are stored once (expr::shared).
StepNames step_names(const std::vector<Wanted>& formulas, const table::Table& table);

} // namespace frictab::codegen
