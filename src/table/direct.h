// The law's own formula stored with its table: evaluated beyond a side with Outside::law, and as
// the direct form that an exporter may get instead of the table.
#pragma once

#include "models/assembled_law.h"
#include "table/table.h"

namespace frictab::table {

// Adds the constants of the law that this expression needs to the table.
void add_constants(Table& table, const models::AssembledLaw& law, const expr::Expr& expression);

// Adds the law's extension and the constants that it needs to the table.
void add_extension(Table& table, const models::AssembledLaw& law);

// Returns a table with the same axes, ranges, sides and attributes and without values: tau_R by the
// law's own formula.
Table direct_form(const models::AssembledLaw& law, const Table& table);

} // namespace frictab::table
