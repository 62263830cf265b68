// The law itself beside its table: what is asked beyond a side with Outside::law, and the direct
// form that an exporter may be handed instead of the table.
#pragma once

#include "calibrate/calibration.h"
#include "table/table.h"

namespace frictab {

// Gives a table of this model its extension and the constants that it needs.
void add_extension(Table& table, const Model& model);

// The same axes, ranges, sides and attributes without any value: tau_R by the law's own formula.
Table direct_form(const Model& model, const Table& table);

} // namespace frictab
