// Writes the statements of C, which are JavaScript once their names are declared.
#include "codegen/javascript.h"

#include <set>
#include <string>
#include <vector>

#include "codegen/statements.h"
#include "core/template.h"
#include "core/text.h"
#include "expr/expr.h"

namespace frictab::codegen {

namespace {

// Words that the function or the language uses, in small letters.
const std::set<std::string>& reserved() {
  static const std::set<std::string> names = {
      "abs",    "acos",      "arguments", "await",    "break",      "case",    "catch", "class",
      "const",  "continue",  "debugger",  "default",  "delete",     "do",      "else",  "enum",
      "eval",   "exp",       "export",    "extends",  "false",      "finally", "for",   "function",
      "if",     "import",    "in",        "infinity", "instanceof", "let",     "log",   "math",
      "nan",    "new",       "null",      "pow",      "return",     "sin",     "sqrt",  "static",
      "super",  "switch",    "tanh",      "tau",      "this",       "throw",   "true",  "try",
      "typeof", "undefined", "value",     "var",      "void",       "while",   "with",  "yield"};
  return names;
}

} // namespace

std::string javascript_function(const models::AssembledLaw& law) {
  Names names(reserved());
  Spelling spelling;
  std::vector<std::string> arguments;
  for (const std::string& input : law.inputs) {
    arguments.push_back(names.give(input));
    spelling.symbols[input] = arguments.back();
  }
  const expr::Expr formula = expr::shared(law.in_numbers(law.tau_R));
  const Statements code = to_statements({{formula, "tau"}}, spelling, names);
  std::string text = "function (" + join(arguments, ", ") + ") {\n";
  for (const std::string& line : code.lines)
    text += "  const " + line + ";\n";
  return text + "  return " + code.results.front() + ";\n}";
}

std::string javascript_helpers() {
  return std::string(embedded_template("report/helpers.js"));
}

} // namespace frictab::codegen
