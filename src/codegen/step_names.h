// Names of the steps of a law's formula in generated code. They follow from the formula's
// structure, because a table read from disk has a formula and no law: the logarithm of a state is
// ln_v_rel, a number times the flow stress is k, the upper bound of tau_R is limit, the factor of
// the first traced effect is e1_humidity_pct. Names change no operation and no order.
#pragma once

#include <string>
#include <vector>

#include "codegen/statements.h"
#include "table/table.h"

namespace frictab::codegen {

// Returns the state without its unit: sigma_n of sigma_n_MPa.
std::string short_name(const std::string& state);

// Name of the tabulated value: mu for tables of a coefficient, otherwise tau_law, the law's stress
// before any limit.
std::string value_name(const table::Table& table);

// Names nodes of these formulas, which are stored once (expr::shared).
StepNames step_names(const std::vector<Wanted>& formulas, const table::Table& table);

} // namespace frictab::codegen
