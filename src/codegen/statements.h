// Formulas as straight-line C, Fortran and Lua that a person can read. A subformula that is needed
// twice or has a name gets its own line; the rest is written inline.
//
// The order of operations is the formula's own, so that all languages give the same bits. C
// evaluates a*b*c and a + b + c from the left; a Fortran compiler may not, so Fortran gets
// parentheses around every product within a product and every sum within a sum.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::codegen {

// Names in a program unit, each used once: Fortran does not distinguish capital from small letters.
class Names {
public:
  explicit Names(std::set<std::string> taken = {}); // in small letters
  // Turns `wish` into an identifier of at most 28 letters, with a number at the end if the name is
  // taken.
  std::string give(const std::string& wish);

private:
  std::set<std::string> taken_;
};

// Name of a subformula (codegen/step_names.h).
struct StepName {
  std::string name;
  bool own_line = false; // true: gets a line even if it is needed only once
};
using StepNames = std::map<const expr::Expr::Node*, StepName>;

// Lua reads C's expressions, with the helpers of its template.
enum class Language { c, fortran };

// How formulas are written. C calls exp, log, pow, ... and the helpers ft_min, ft_max, ft_where_le;
// Fortran the intrinsics and ftmin, ftmax, ftwhle (from the templates; NaN as in expr/expr.h).
struct Spelling {
  Language language = Language::c;
  std::map<std::string, std::string> symbols = {}; // names of symbols in the unit
  std::set<std::string> numbers = {};              // symbols that are named constants
  StepNames steps = {};
  // Prefix "t." of every name that is assigned, or empty.
  std::string owner = {};
};

// A formula, and the name of its result.
struct Wanted {
  expr::Expr formula;
  std::string name;
};

// Code that computes several formulas: the first first_lines[i] lines compute the formulas 0 .. i.
struct Statements {
  std::vector<std::string> lines;   // "tau = mu*sigma_n_MPa" without declarations or terminators
  std::vector<std::string> names;   // assigned by the lines, in their order
  std::vector<std::string> results; // one per formula: a name, a symbol or a literal
  std::vector<std::size_t> first_lines;
};

// Writes formulas that are stored once (expr::shared), whose nodes `spelling.steps` names. Steps
// without a name are t1, t2, ...; names other than those of the results come from `names`.
Statements to_statements(const std::vector<Wanted>& wanted, const Spelling& spelling, Names& names);

} // namespace frictab::codegen
