// Lists the names that generated code already uses, and writes the statements of formulas.
#include "codegen/variables.h"

#include <algorithm>

#include "codegen/step_names.h"
#include "expr/derivative.h"
#include "expr/expr.h"
#include "table/states.h"

namespace frictab::codegen {

using table::Table;

namespace {

// Returns names in small letters. Names that start with ft never belong to variables (Names).
const std::set<std::string>& names_of_templates() {
  static const std::set<std::string> names = {
      // variables of the templates
      "x", "u", "du", "by", "by_u", "i", "j", "bits", "most", "beyond", "deriv", "dv", "tau",
      "tau_r", "dtau", "derivative", "value", "feature", "steps",
      // functions
      "abs", "acos", "exp", "huge", "ibclr", "int", "ipairs", "log", "max", "min", "mod", "pow",
      "sin", "sqrt", "tanh", "transfer",
      // words of the languages, and what a C header may define
      "and", "auto", "break", "call", "case", "char", "const", "continue", "data", "default", "do",
      "double", "else", "elseif", "end", "enum", "eof", "extern", "external", "false", "far",
      "float", "for", "format", "function", "goto", "if", "implicit", "infinity", "inline",
      "integer", "local", "logical", "long", "math", "nan", "near", "nil", "not", "null", "or",
      "parameter", "read", "real", "register", "repeat", "restrict", "return", "save", "short",
      "signed", "sizeof", "small", "static", "stop", "struct", "subroutine", "switch", "then",
      "true", "typedef", "union", "unsigned", "until", "void", "volatile", "while", "write"};
  return names;
}

std::set<std::string> both(std::set<std::string> a, const std::set<std::string>& b) {
  a.insert(b.begin(), b.end());
  return a;
}

} // namespace

Variables::Variables(const Table& table, const expr::Expr& formula, Language language,
                     const std::map<std::string, std::string>& given,
                     const std::set<std::string>& taken)
    : table_(table), names_(both(names_of_templates(), taken)) {
  spelling_.language = language;
  const std::set<std::string> used = expr::symbols(formula);
  for (const auto& [name, number] : table.constants) {
    if (!used.count(name)) continue;
    spelling_.symbols[name] = names_.give(name);
    spelling_.numbers.insert(name);
  }
  const std::string value = value_name(table); // coulomb has a parameter with that name
  spelling_.symbols["value"] = names_.give(value + (used.count(value) ? "_law" : ""));
  for (const std::string& state : table.inputs()) {
    const auto known = given.find(state);
    spelling_.symbols[state] = known == given.end() ? names_.give(state) : known->second;
  }
}

std::string Variables::slope(const std::string& of, const std::string& by) {
  return names_.give("d" + of + "_d" + (by == "value" ? name(by) : short_name(by)));
}

std::vector<std::string> Variables::states_of(const expr::Expr& formula) const {
  const std::set<std::string> used = expr::symbols(formula);
  std::vector<std::string> states;
  for (const std::string& state : table_.inputs())
    if (used.count(state)) states.push_back(state);
  return states;
}

Statements Variables::statements(std::vector<Wanted> wanted, std::string_view owner) {
  std::vector<expr::Expr> formulas;
  for (const Wanted& one : wanted)
    formulas.push_back(one.formula);
  formulas = expr::shared(formulas);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    wanted[i].formula = formulas[i];
  spelling_.steps = step_names(wanted, table_);
  spelling_.owner = owner;
  return to_statements(wanted, spelling_, names_);
}

bool acts_through_value(const Table& table, const std::string& state) {
  return table::find_axis(table, state) ||
         (table.extension && expr::symbols(*table.extension).count(state));
}

std::vector<Wanted> tangent_formulas(const Table& table, const std::string& tau,
                                     const std::vector<std::string>& states, Variables& variables) {
  const bool changes = std::any_of(states.begin(), states.end(), [&](const std::string& state) {
    return acts_through_value(table, state);
  });
  std::vector<Wanted> wanted{{table.combine, tau},
                             {changes ? derivative(table.combine, "value") : expr::Expr(0.0),
                              variables.slope(tau, "value")}};
  for (const std::string& state : states)
    wanted.push_back({derivative(table.combine, state), variables.slope(tau, state)});
  return wanted;
}

} // namespace frictab::codegen
