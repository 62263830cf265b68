// Sentences about a table for comments, recipes and the report: ranges, behaviour beyond them,
// drift, origin of the data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/entry_arguments.h"
#include "table/table.h"

namespace frictab::codegen {

// Returns "500 .. 2750 MPa" in the solver's unit, with a remark if the state is not an axis.
std::string range_text(const InputArgument& input, const table::Table& table);

// Returns the behaviour beyond the sides of axes that do not only clamp: "psi below 1: clamp, above
// 20: law". Empty if all clamp.
std::vector<std::string> outside_lines(const table::Table& table);

// Lists the states that the formula of `combine` takes unclamped beyond the range as well: "stress
// and flow stress", and other states in it.
std::string unchanged_states(const table::Table& table);

// Returns what holds beyond the range as sentences; `error_action`: what an error does.
std::vector<std::string> outside_rule(const table::Table& table, const std::string& error_action);

// Returns "worst drift ..., measured in verification" or "not known"; from the table's attributes.
std::string drift_text(const table::Table& table);
std::string origin_text(const table::Table& table);

// Returns "keeps 57.1 MPa below 500 MPa of contact normal stress ..." if tau_R does not fall with a
// pressure below the table's range, as at the edge of a contact, at typical values of the other
// states; otherwise empty.
std::string edge_text(const table::Table& table);

// Makes text from outside (names, attributes) safe inside a comment of C or Fortran.
std::string comment_text(std::string_view text);

// Returns such texts as lines of at most `width` columns; `further` as in wrap_text.
std::vector<std::string> comment_lines(const std::vector<std::string>& texts, std::size_t width,
                                       std::string_view further = {});

} // namespace frictab::codegen
