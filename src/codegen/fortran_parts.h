// Parts of Fortran sources in fixed form.
#pragma once

#include <string>
#include <vector>

#include "codegen/variables.h"
#include "core/template.h"
#include "expr/expr.h"
#include "table/table.h"

namespace frictab::codegen::fortran {

// Returns comment lines, indented by `indent`; longer texts continue indented by two more.
Lines comments(const std::vector<std::string>& texts, std::size_t indent = 0);

// Interfaces of the system's lock, <stem>lock(lock) and <stem>free(lock): subroutines on Windows,
// otherwise functions.
std::string locks(const std::string& stem, bool windows);

// Shortens a name to the 30 characters that fit between apostrophes in a line of Fortran.
std::string in_apostrophes(std::string_view name);

// Cuts a remark to its first line; the rest is in the head of the file.
std::string clip(const std::string& text);

// Returns the place of a state in x: x(1), ...
std::string place_of(const table::Table& table, const std::string& state);

// Adds the values around the statements of a formula in a unit whose result is `result`: lists
// states (assignments, "sigma_n_MPa = x(1)", followed by `clamps`), variables (declarations of all
// names but the result), constants and helpers, those of ftmin, ftmax, ftwhle that the statements
// call. Returns these.
std::vector<std::string> add_declarations(TemplateValues& values, const table::Table& table,
                                          const Variables& variables, const expr::Expr& formula,
                                          const Statements& code, const std::string& result,
                                          const std::vector<std::string>& clamps = {});

// Returns the assignment of a result to its variable; empty if it is already there.
std::vector<std::string> moved(const std::string& result, const std::string& variable);

// Formats statements in fixed form.
Lines fixed_lines(const std::vector<std::string>& statements);

// Form of program units: external, each with declarations of those it calls and its numbers inside;
// or in a module, pure, with the numbers in the module (Core::data).
enum class Units { external, module };

// Adds the values with which templates write units in either form.
void add_units(TemplateValues& values, Units units);

// A unit, the helpers (of helpers_of) that it calls, and its numbers if these are outside it.
struct Piece {
  std::string text;
  std::vector<std::string> helpers;
  std::string data;
};

// Returns the law's own formula, ftpiec; with `gradient` also ftpieg, which returns its derivatives
// as well.
Piece piece(const table::Table& table, bool gradient, Units units);

// Returns "x(index) relation limit" for each side with this answer.
Lines sides(const table::Table& table, table::Outside answer);

} // namespace frictab::codegen::fortran
