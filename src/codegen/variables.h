// The variables of one generated function: states, named constants, the tabulated value, and the
// steps of its formulas, each with a name that is unique in the function.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/statements.h"
#include "table/table.h"

namespace frictab::codegen {

class Variables {
public:
  // Names the table's states and the constants in `formula`. `given` are states that already have
  // names. `taken`: further names in use, in addition to those of templates and languages.
  Variables(const table::Table& table, const expr::Expr& formula, Language language,
            const std::map<std::string, std::string>& given = {},
            const std::set<std::string>& taken = {});

  // Returns the name of a state, a constant of the formula or "value".
  const std::string& name(const std::string& symbol) const { return spelling_.symbols.at(symbol); }
  // Constants of the formula, sorted.
  const std::set<std::string>& constants() const { return spelling_.numbers; }
  // Sets the name of a symbol, unchanged.
  void set(const std::string& symbol, const std::string& name) { spelling_.symbols[symbol] = name; }
  // Returns a further unique name.
  std::string give(const std::string& wish) { return names_.give(wish); }
  // Returns a further unique name such as "dmu_dsigma_n".
  std::string slope(const std::string& of, const std::string& by);
  // Returns the states of the table that a formula uses, in their order.
  std::vector<std::string> states_of(const expr::Expr& formula) const;

  // Writes statements for formulas. The first is the function's own, as in the table (or a part of
  // it); the others are its derivatives. `owner` as in Spelling.
  Statements statements(std::vector<Wanted> wanted, std::string_view owner = "");

private:
  const table::Table& table_;
  Spelling spelling_;
  Names names_;
};

// True if a state changes the value inside the table's formula: an axis, or a state of the law's
// own formula.
bool acts_through_value(const table::Table& table, const std::string& state);

// Returns the table's formula as `tau`, its derivative by the value (0 if no state changes that),
// and those by these states at a fixed value.
std::vector<Wanted> tangent_formulas(const table::Table& table, const std::string& tau,
                                     const std::vector<std::string>& states, Variables& variables);

} // namespace frictab::codegen
