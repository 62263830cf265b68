// Statements of generated code: what stands on which line, under which name, in which order of
// operations.
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/variables.h"
#include "core/text.h"
#include "expr/derivative.h"
#include "support/sample_data.h"
#include "support/traced_law.h"
#include "table/direct.h"

namespace frictab::statements_test {

using codegen::Language;
using codegen::Names;
using codegen::Statements;
using codegen::Variables;
using codegen::Wanted;
using expr::Expr;
using table::Table;

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// A law's direct form, whose constants are its parameters; of a coefficient where none is given.
Table table_of(const models::Model& model) {
  const models::AssembledLaw law(model);
  Table table;
  table.quantity = model.law->quantity;
  table.combine = law.combine;
  table::add_extension(table, law);
  table::add_constants(table, law, law.combine);
  return table;
}

Table table_of(const std::string& formula, const std::map<std::string, double>& constants = {}) {
  Table table;
  table.combine = expr::parse_expr(formula);
  table.constants = constants;
  return table;
}

Statements statements(const Table& table, const Expr& formula, Language language) {
  return Variables(table, formula, language).statements({{formula, "tau"}});
}

std::vector<std::string> lines(const std::string& formula, Language language,
                               const std::map<std::string, double>& constants = {}) {
  const Table table = table_of(formula, constants);
  return statements(table, table.combine, language).lines;
}

TEST(Statements, GiveWhatIsNeededTwiceALineAndWriteOutTheRest) {
  EXPECT_THAT(lines("exp(x_mm)*exp(x_mm) + 1", Language::c),
              ElementsAre("t1 = exp(x_mm)", "tau = t1*t1 + 1.0"));
  EXPECT_THAT(lines("x_mm**0.5*1e-7", Language::fortran), ElementsAre("tau = x_mm**0.5D0*1.0D-07"));
}

TEST(Statements, OfSeveralFormulasShareTheirSteps) {
  const Expr x = Expr::symbol("x_mm");
  const Table table;
  Variables variables(table, x, Language::c);
  variables.set("x_mm", "s");
  const Statements code = variables.statements(
      {{exp(x) * 2.0, "a"}, {exp(Expr::symbol("x_mm")) + x, "b"}, {3.0, "c"}, {exp(x) * 2.0, "d"}});
  EXPECT_THAT(code.lines, ElementsAre("t1 = exp(s)", "a = t1*2.0", "b = t1 + s"));
  EXPECT_THAT(code.results, ElementsAre("a", "b", "3.0", "a"));
  EXPECT_THAT(code.first_lines, ElementsAre(2u, 3u, 3u, 3u));
}

TEST(Statements, HaveTheParenthesesThatFortranKeepsTo) {
  EXPECT_THAT(lines("p*q*r/s", Language::c), ElementsAre("tau = p*q*r/s"));
  EXPECT_THAT(lines("p*q*r/s", Language::fortran), ElementsAre("tau = ((p*q)*r)/s"));
  EXPECT_THAT(lines("p + q - r", Language::fortran), ElementsAre("tau = (p + q) - r"));
  for (const Language language : {Language::c, Language::fortran}) {
    EXPECT_THAT(lines("p*(q*r)", language), ElementsAre("tau = p*(q*r)"));
    EXPECT_THAT(lines("p - (q - r*s)", language), ElementsAre("tau = p - (q - r*s)"));
    EXPECT_THAT(lines("(-p)*q - (-r)", language), ElementsAre("tau = (-p)*q - (-r)"));
  }
}

TEST(Statements, OfWideFormulasAreDividedIntoLinesThatFit) {
  std::string formula = "x1_mm";
  for (int i = 2; i < 60; ++i)
    formula += " + x" + std::to_string(i) + "_mm*maximum(x" + std::to_string(i - 1) + "_mm, 0)";
  for (const Language language : {Language::c, Language::fortran})
    for (const std::string& line : lines(formula, language))
      EXPECT_LE(line.size(), 80u) << line;
}

// A Fortran compiler evaluates them while it compiles, and sqrt(-1) is an error even in a branch
// that is never taken.
TEST(Statements, OfNumbersAloneDoNotStandInsideWhatIsNotDefinedEverywhere) {
  EXPECT_THAT(lines("x_mm*sqrt(1 - f) + g*(1 - f)", Language::fortran, {{"f", 2}, {"g", 1}}),
              ElementsAre("t1 = 1.0D0 - f", "tau = x_mm*sqrt(t1) + g*t1"));
  EXPECT_THAT(lines("x_mm*log(2 - f)", Language::fortran, {{"f", 2}}),
              ElementsAre("t1 = 2.0D0 - f", "tau = x_mm*log(t1)"));
}

TEST(Names, AreGivenOnceWhateverTheCaseOfTheirLetters) {
  Names names({"u"});
  EXPECT_EQ(names.give("C"), "C");
  EXPECT_EQ(names.give("c"), "c_2");
  EXPECT_EQ(names.give("c"), "c_3");
  EXPECT_EQ(names.give("U"), "U_2");
  EXPECT_EQ(names.give("2 % oil"), "c_2___oil");
  EXPECT_EQ(names.give("ftnan"), "c_ftnan");
  EXPECT_EQ(names.give(std::string(100, 'z')).size(), 28u);
}

TEST(Variables, KeepTheNamesOfParametersAndStatesOffThoseOfTheTemplates) {
  const Table table = table_of("value*MU*i*Exp*x", {{"MU", 1}, {"i", 2}});
  const Variables variables(table, table.combine, Language::fortran);
  EXPECT_EQ(variables.name("MU"), "MU");
  EXPECT_EQ(variables.name("value"), "mu_2");
  EXPECT_EQ(variables.name("i"), "i_2");
  EXPECT_EQ(variables.name("Exp"), "Exp_2");
  EXPECT_EQ(variables.name("x"), "x_2");
}

// The lines, read as formulas again and put into each other.
Expr read_back(const Statements& code) {
  const std::regex where("ftwhle\\("), number("([0-9.])D(-?[0-9]+)"), acos("\\bacos\\("),
      minimum("ftmin\\("), maximum("ftmax\\(");
  std::map<std::string, Expr> known;
  for (const std::string& line : code.lines) {
    const std::size_t at = line.find(" = ");
    std::string text = std::regex_replace(line.substr(at + 3), number, "$1e$2");
    text = std::regex_replace(text, acos, "arccos(");
    text = std::regex_replace(text, minimum, "minimum(");
    text = std::regex_replace(text, maximum, "maximum(");
    for (std::smatch call; std::regex_search(text, call, where);) {
      auto comma = static_cast<std::size_t>(call.position() + call.length());
      for (int depth = 0; depth > 0 || text[comma] != ','; ++comma)
        depth += text[comma] == '(' ? 1 : text[comma] == ')' ? -1 : 0;
      text.replace(comma, 1, " <=");
      text.replace(static_cast<std::size_t>(call.position()), 6, "where");
    }
    known.insert_or_assign(line.substr(0, at), substitute(expr::parse_expr(text), known));
  }
  return known.at(code.results[0]);
}

TEST(Statements, OfEveryLawReadBackAreItsFormulaOperationByOperation) {
  std::vector<models::Model> all;
  for (const models::Law& law : models::all_laws())
    all.push_back(test::plausible_model(law));
  all.push_back(test::traced_model({"humidity", "work", "tool", "peak", "curve", "surface"}));
  for (const models::Model& model : all) {
    const Table table = table_of(model);
    for (const Expr& formula : {table.combine, *table.extension}) {
      if (formula.operands().empty()) continue;
      Variables variables(table, formula, Language::fortran);
      for (const std::string& symbol : expr::symbols(formula))
        variables.set(symbol, symbol);
      const Statements code = variables.statements({{formula, "result"}});
      EXPECT_EQ(to_text(read_back(code)), to_text(formula)) << model.name();
    }
  }
}

TEST(StepNames, AreThoseOfTheField) {
  const Table orowan = table_of(test::plausible_model(*models::find_law("orowan")));
  EXPECT_THAT(statements(orowan, orowan.combine, Language::c).lines,
              ElementsAre("k = 0.5773502691896258*sigma_f_MPa", "limit = m*k",
                          "tau = ft_min(ft_max(ft_min(mu*sigma_n_MPa, limit), 0.0), k)"));
  const Table wzl = table_of(test::plausible_model(*models::find_law("wzl")));
  EXPECT_THAT(statements(wzl, *wzl.extension, Language::c).lines,
              ElementsAre("ln_sigma_n = log(ft_max(sigma_n_MPa, 1.0)/1000.0)",
                          "ln_v_rel = log(ft_max(v_rel_mm_s, 10.0)/100.0)",
                          "ln_T_contact = log(ft_max(T_contact_C, 20.0)/100.0)",
                          "tau = C*exp(a*ln_sigma_n + b*ln_v_rel + g*ln_T_contact)"));
}

TEST(StepNames, OfTracedEffectsAreTheirNumberAndTheirColumns) {
  effects::PlacedEffect added = test::traced_effect("tool_heat");
  added.acts_on = effects::ActsOn::tau;
  added.tau_scale_MPa = 20;
  const Table table = table_of(
      test::traced_model(test::plausible_model(*models::find_law("orowan")),
                         {test::traced_effect("humidity"), test::traced_effect("surface"), added}));
  const Statements code = statements(table, table.combine, Language::c);
  for (const char* name : {"e1_humidity_pct", "e2_T_tool_humidity_pct", "e3_T_tool", "k", "limit"})
    EXPECT_THAT(code.names, Contains(name));
  EXPECT_THAT(join(code.lines, "\n"),
              HasSubstr("mu*(e1_humidity_pct*e2_T_tool_humidity_pct)*sigma_n_MPa"));
}

TEST(StepNames, OfDerivativesSayWhatOfWhat) {
  const Table table = table_of(test::plausible_model(*models::find_law("orowan")));
  Variables variables(table, table.combine, Language::fortran);
  EXPECT_EQ(variables.slope("tau", "value"), "dtau_dmu");
  EXPECT_EQ(variables.slope("tau", "v_rel_mm_s"), "dtau_dv_rel");
}

} // namespace
} // namespace frictab::statements_test
