// Formulas as straight-line C, Fortran and Lua that a person can read: what is needed twice or has
// a name stands on a line of its own, the rest is written out where it is needed.
//
// The order of operations is the formula's own, so that all languages give the same bits. C
// evaluates a*b*c and a + b + c from the left; a Fortran compiler may not without parentheses, so
// that there they stand around every product within a product and every sum within a sum.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::codegen {

// Names in a program unit, each given once: Fortran does not tell capital letters from small ones.
class Names {
public:
  explicit Names(std::set<std::string> taken = {}); // in small letters
  // The wish as an identifier of at most 28 letters; with a number behind it where it is taken.
  std::string give(const std::string& wish);

private:
  std::set<std::string> taken_;
};

// What a subformula is called (codegen/step_names.h).
struct StepName {
  std::string name;
  bool own_line = false; // although it is needed once only
};
using StepNames = std::map<const expr::Expr::Node*, StepName>;

enum class Language { c, fortran }; // Lua reads C's expressions, with the helpers of its template

// How formulas are written. C calls exp, log, pow, ... and the helpers ft_min, ft_max, ft_where_le;
// Fortran the intrinsics and ftmin, ftmax, ftwhle (of the templates; NaN as in expr/expr.h).
struct Spelling {
  Language language = Language::c;
  std::map<std::string, std::string> symbols = {}; // as they are called in the unit
  std::set<std::string> numbers = {};              // symbols that are named constants
  StepNames steps = {};
  std::string owner = {}; // stands before every name that is assigned: "t."
};

// A formula, and what its result is called.
struct Wanted {
  expr::Expr formula;
  std::string name;
};

// The first first_lines[i] lines compute the formulas 0 .. i.
struct Statements {
  std::vector<std::string> lines;   // "tau = mu*sigma_n_MPa" without declarations or terminators
  std::vector<std::string> names;   // that the lines assign, in their order
  std::vector<std::string> results; // one per formula: a name, a symbol or a literal
  std::vector<std::size_t> first_lines;
};

// Of formulas that are stored once (expr::shared), as `spelling.steps` knows their nodes. Steps
// without a name are t1, t2, ...; names other than those of the results come from `names`.
Statements to_statements(const std::vector<Wanted>& wanted, const Spelling& spelling, Names& names);

} // namespace frictab::codegen
