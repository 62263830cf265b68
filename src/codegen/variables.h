// The variables of one generated function: states, named constants, what is tabulated, and the
// steps of its formulas, each under a name that nothing else in the function has.
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
  // Of the table's states, and of the constants in `formula`. `given` are states that have names
  // already. `taken`: names beside those that templates and languages use.
  Variables(const table::Table& table, const expr::Expr& formula, Language language,
            const std::map<std::string, std::string>& given = {},
            const std::set<std::string>& taken = {});

  // How a state, a constant of the formula or "value" is called.
  const std::string& name(const std::string& symbol) const { return spelling_.symbols.at(symbol); }
  // The constants of the formula, sorted.
  const std::set<std::string>& constants() const { return spelling_.numbers; }
  // Another name for a symbol, as it stands.
  void set(const std::string& symbol, const std::string& name) { spelling_.symbols[symbol] = name; }
  // A further name.
  std::string give(const std::string& wish) { return names_.give(wish); }
  // "dmu_dsigma_n", a further name.
  std::string slope(const std::string& of, const std::string& by);
  // States of the table that a formula uses, in their order.
  std::vector<std::string> states_of(const expr::Expr& formula) const;

  // The first formula is the function's own, as it is in the table (or a part of it); others are
  // its derivatives. `owner` as in Spelling.
  Statements statements(std::vector<Wanted> wanted, std::string_view owner = "");

private:
  const table::Table& table_;
  Spelling spelling_;
  Names names_;
};

// Those of the loops over a network's layer, in the function that has them.
std::set<std::string> names_of_a_layer(std::size_t features);

} // namespace frictab::codegen
