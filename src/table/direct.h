// The law itself beside its table: what is asked beyond a side with Outside::law, and the direct
// form that an exporter may be handed instead of the table.
#pragma once

#include "models/assembled_law.h"
#include "table/table.h"

namespace frictab::table {

// Gives a table the constants that this expression of its law needs.
void add_constants(Table& table, const models::AssembledLaw& law, const expr::Expr& expression);

// Gives a table of this law its extension and the constants that it needs.
void add_extension(Table& table, const models::AssembledLaw& law);

// The same axes, ranges, sides and attributes without any value: tau_R by the law's own formula.
Table direct_form(const models::AssembledLaw& law, const Table& table);

} // namespace frictab::table
