// Fortran in fixed form, as the compilers of all solvers read it: a statement is in columns 7 to 72
// and continues in at most 19 further lines, which have a mark in column 6.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace frictab::codegen {

// Returns a Fortran statement in fixed form: columns 7..72, continuation lines marked in column 6.
// Throws std::logic_error if it needs more than 19 of them.
std::string fixed_form(const std::string& statement);

// Returns DATA statements for name(1..n), each within 72 columns and 19 continuation lines.
std::string fixed_form_data(const std::string& name, std::span<const double> values);
std::string fixed_form_data(const std::string& name, const std::vector<int>& values);

} // namespace frictab::codegen
