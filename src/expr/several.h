// Several formulas taken together: what they have in common is stored, and computed, once.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "expr/expr.h"

namespace frictab::expr {

// The same formulas with equal subformulas, of one or of different ones, stored once.
std::vector<Expr> shared(const std::vector<Expr>& formulas);

// As to_statements of one formula. The lines are in the order of the formulas: the first
// first_lines[i] of them compute the formulas 0 .. i.
struct SeveralStatements {
  std::vector<std::string> lines;
  std::vector<std::string> temporaries;
  std::vector<std::string> results;     // one per formula
  std::vector<std::size_t> first_lines; // one per formula
};
SeveralStatements to_statements(const std::vector<Expr>& formulas, Language language,
                                const std::map<std::string, std::string>& rename = {},
                                std::string_view prefix = "t");

} // namespace frictab::expr
