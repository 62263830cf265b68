// What comments, recipes and the report say about a table: ranges, what holds beyond them, how far
// it is off its law, where its data come from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/entry_arguments.h"
#include "table/table.h"

namespace frictab::codegen {

// "500 .. 2750 MPa" in the solver's unit, with a remark where the state is no axis.
std::string range_text(const InputArgument& input, const table::Table& table);

// What the sides of the axes do where one does not clamp: "psi below 1: clamp, above 20: law".
// Empty where all clamp.
std::vector<std::string> outside_lines(const table::Table& table);

// What the formula of `combine` takes beyond the range as well: "stress and flow stress", and other
// states that stand in it.
std::string unchanged_states(const table::Table& table);

// "worst drift ..., measured in verification" or "not known"; from the table's attributes.
std::string drift_text(const table::Table& table);
std::string origin_text(const table::Table& table);

// "keeps 57.1 MPa below 500 MPa of contact normal stress ...": where tau_R does not fall with a
// pressure below the table's range, as at the edge of a contact, and its other states are typical;
// else empty.
std::string edge_text(const table::Table& table);

// Text from outside (names, attributes) that stays inside a comment of C or Fortran.
std::string comment_text(std::string_view text);

} // namespace frictab::codegen
