// What the parts of Fortran sources in fixed form are filled with.
#pragma once

#include <string>
#include <vector>

#include "codegen/variables.h"
#include "core/template.h"
#include "expr/expr.h"
#include "table/table.h"

namespace frictab::codegen::fortran {

// Comment lines, set in by `indent`; what does not fit goes on, set in by two more.
Lines comments(const std::vector<std::string>& texts, std::size_t indent = 0);

// Interfaces of the system's lock, <stem>lock(lock) and <stem>free(lock): subroutines on Windows,
// else functions.
std::string locks(const std::string& stem, bool windows);

// What may stand between apostrophes in a line of Fortran: 30 characters of a name.
std::string in_apostrophes(std::string_view name);

// The first line of a remark: what follows is in the head of the file.
std::string clip(const std::string& text);

// "double precision mu, k, ..."
Lines declarations(const std::vector<std::string>& names);

// Where a state stands in x: x(1), ...
std::string place_of(const table::Table& table, const std::string& state);

// The constants that a formula uses, as named constants.
Lines constant_lines(const table::Table& table, const Variables& variables);

// The states that a formula uses, by their names: declared in `names`, "sigma_n_MPa = x(1)".
std::vector<std::string> states_from_x(const table::Table& table, const Variables& variables,
                                       const expr::Expr& formula, std::vector<std::string>& names);

// Where a result is not in its variable: the line that puts it there.
std::vector<std::string> moved(const std::string& result, const std::string& variable);

// Statements in fixed form.
Lines fixed_lines(const std::vector<std::string>& statements);

// ftmin, ftmax, ftwhle, where these statements call them.
std::vector<std::string> helpers_of(const std::string& statements);

// How program units stand: on their own, each declaring those it calls, with its numbers inside;
// or in a module, pure, with the numbers in the module (Core::data).
enum class Units { external, module };

// Adds what the templates need to write units either way.
void add_units(TemplateValues& values, Units units);

// A unit, the helpers (of helpers_of) that it calls, and its numbers where these stand apart.
struct Piece {
  std::string text;
  std::vector<std::string> helpers;
  std::string data;
};

// The law's own formula, ftpiec; with `gradient` also ftpieg, which gives its derivatives as well.
Piece piece(const table::Table& table, bool gradient, Units units);

// "x(index) relation limit" for each side of that kind.
Lines sides(const table::Table& table, table::Outside kind);

// A template's text, to be inserted into another one: without the line break at its end.
std::string without_last_break(std::string text);

} // namespace frictab::codegen::fortran
