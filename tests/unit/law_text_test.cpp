// Laws that users write: what is understood, what is refused and where.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "expr/mathml.h"
#include "expr/program.h"
#include "job/job.h"
#include "models/law_text.h"
#include "support/refusal.h"

namespace frictab::law_text_test {
namespace {

using expr::Expr;
using models::Parameter;
using models::PieceQuantity;
using testing::HasSubstr;

const std::vector<Parameter> open{{"mu", "1", "", 0.1, 0, 1},
                                  {"m", "1", "", 0.5, 0, 1},
                                  {"a", "1", "", 0.1, -1, 1},
                                  {"c", "1", "", 0.1, 0.01, 1}};

models::Parts split(const std::string& formula) {
  return models::parts_of(shared(expr::parse_expr(formula)), open);
}

struct Case {
  const char* formula;
  const char* piece;
  const char* combine;
  PieceQuantity quantity;
};

TEST(LawText, KinksStayOutsideThePieceAndItIsACoefficientWherePossible) {
  const Case cases[] = {
      {"mu*sigma_n_MPa", "mu", "value*sigma_n_MPa", PieceQuantity::mu},
      {"min(mu*sigma_n_MPa, m*k_MPa)", "mu", "minimum(value*sigma_n_MPa, m*k_MPa)",
       PieceQuantity::mu},
      {"sigma_n_MPa*max(mu + a*ln(v_rel_mm_s/100), 0)", "mu + a*log(v_rel_mm_s/100)",
       "sigma_n_MPa*maximum(value, 0)", PieceQuantity::mu},
      {"m*k_MPa*(1 - exp(-1.25*sigma_n_MPa/sigma_f_MPa))",
       "m*k_MPa*(1 - exp(-1.25*sigma_n_MPa/sigma_f_MPa))", "value", PieceQuantity::tau_R},
      {"mu*sigma_n_MPa/(1 + psi)", "mu/(1 + psi)", "value*sigma_n_MPa", PieceQuantity::mu},
      {"where(psi <= 3, mu*sigma_n_MPa, c*sigma_n_MPa*psi**a)", "c*psi**a",
       "where(psi <= 3, mu*sigma_n_MPa, value*sigma_n_MPa)", PieceQuantity::mu},
      {"min(mu, m)*sigma_n_MPa", "minimum(mu, m)", "value*sigma_n_MPa", PieceQuantity::mu},
  };
  for (const Case& c : cases) {
    const models::Parts parts = split(c.formula);
    EXPECT_EQ(expr::to_text(parts.formula.value), c.piece) << c.formula;
    EXPECT_EQ(expr::to_text(parts.formula.combine), c.combine) << c.formula;
    EXPECT_EQ(parts.quantity, c.quantity) << c.formula;
  }
}

// Formulas from a grammar of its own, kinks anywhere.
class Maker {
public:
  explicit Maker(Random& random) : random_(random) {}
  std::string formula(int depth) {
    static const char* const atoms[] = {"sigma_n_MPa", "psi", "v_rel_mm_s", "mu",
                                        "m",           "a",   "c",          "2"};
    if (depth == 0) return atoms[pick(8)];
    const std::string x = formula(depth - 1), y = formula(depth - 1);
    switch (pick(9)) {
    case 0:
      return "min(" + x + ", " + y + ")";
    case 1:
      return "max(" + x + ", " + y + ")";
    case 2:
      return "where(" + x + " <= " + y + ", " + formula(depth - 1) + ", " + x + ")";
    case 3:
      return "tanh(" + x + ")";
    case 4:
      return "(" + x + ")/(1 + (" + y + ")^2)";
    case 5:
      return "(" + x + " - " + y + ")";
    case 6:
      return "(" + x + " + " + y + ")";
    default:
      return "(" + x + ")*(" + y + ")";
    }
  }

private:
  std::size_t pick(std::size_t most) {
    return std::min(most - 1, static_cast<std::size_t>(random_.uniform() * double(most)));
  }
  Random& random_;
};

TEST(LawText, PieceAndCombineGiveTheFormulaAgainWhateverItIs) {
  Random random(11);
  Maker maker(random);
  const std::vector<std::string> names = {"a", "c", "m", "mu", "psi", "sigma_n_MPa", "v_rel_mm_s"};
  for (int i = 0; i < 500; ++i) {
    const std::string text = maker.formula(1 + i % 4);
    const Expr whole = shared(expr::parse_expr(text));
    const models::Parts parts = models::parts_of(whole, open);
    const expr::Program one(whole, names, {});
    const expr::Program two(substitute(parts.formula.combine, {{"value", parts.formula.value}}),
                            names, {});
    for (int row = 0; row < 5; ++row) {
      std::vector<double> at;
      for (std::size_t n = 0; n < names.size(); ++n)
        at.push_back(random.uniform(0.1, 3));
      const double expected = one(at, {});
      if (!std::isfinite(expected)) continue;
      ASSERT_NEAR(two(at, {}), expected, 1e-9 * (1 + std::abs(expected))) << text;
    }
  }
}

std::string fault_of(const std::string& law) {
  return test::refusal([&] { job::parse_job("[data]\ntraining = \"a.csv\"\n" + law, "job.toml"); });
}

std::string fault_of_formula(const std::string& formula) {
  return fault_of("[models.mine]\nformula = \"" + formula +
                  "\"\nparameters = { mu = { range = [0, 1] } }\n");
}

TEST(LawText, FaultsStandWhereTheyAreInTheFormula) {
  EXPECT_THAT(fault_of_formula("mu*cosh(psi)*sigma_n_MPa"),
              HasSubstr("job.toml:4:19: error: unknown function 'cosh'"));
  EXPECT_THAT(fault_of_formula("mu*sigma_n_MPa*time_s"),
              HasSubstr("job.toml:4:27: error: law mine depends on time_s, which is not a state"));
  EXPECT_THAT(fault_of_formula("mu*value"),
              HasSubstr("job.toml:4:15: error: law mine uses `value`"));
  EXPECT_THAT(fault_of_formula("sigma_n_MPa"),
              HasSubstr("job.toml:5:21: error: law mine does not use its parameter 'mu'"));
  EXPECT_THAT(fault_of_formula("mu"),
              HasSubstr("job.toml:3:1: error: law mine depends on no state"));
  EXPECT_THAT(fault_of_formula("mu*sigma_n_MPa*ln(-psi)"), HasSubstr("gives no number at sigma_n"));
}

TEST(LawText, APartMayUseThePieceWhereCombineDoes) {
  const std::string rest = "parameters = { mu = { range = [0, 1] } }\n"
                           "where = { load = \"value*sigma_n_MPa\" }\n";
  EXPECT_EQ(fault_of("[models.mine]\npiece = \"mu\"\ncombine = \"load/(1 + load)\"\n" + rest),
            "accepted");
  EXPECT_THAT(fault_of("[models.mine]\nformula = \"mu*load\"\n" + rest),
              HasSubstr("job.toml:6:19: error: law mine uses `value` outside combine"));
}

TEST(LawText, KeysOfTheRegistryAreUnknownInAJob) {
  for (const char* key : {"order = 1", "people = \"mu p\"", "calibrated = \"mean\"",
                          "log_value = true", "nodes_at_kinks = false", "revisions = \"mises\""})
    EXPECT_THAT(fault_of(std::string("[models.mine]\n") + key +
                         "\nformula = \"mu*sigma_n_MPa\"\n"
                         "parameters = { mu = { range = [0, 1] } }\n"),
                HasSubstr("job.toml:4:1: error: unknown key"))
        << key;
  EXPECT_THAT(fault_of_formula("mu*sigma_f_over_k*sigma_n_MPa"), "accepted"); // a column's name
}

TEST(LawText, NamesThatMeanSomethingElseAreRefused) {
  const auto with = [](const std::string& name) {
    return fault_of("[models.mine]\nformula = \"" + name + "*sigma_n_MPa\"\nparameters = { " +
                    name + " = { range = [0, 1] } }\n");
  };
  EXPECT_THAT(with("psi"), HasSubstr("has the name of a quantity"));
  EXPECT_THAT(with("Sigma_N_MPa"), HasSubstr("has the name of a quantity"));
  EXPECT_THAT(with("min"), HasSubstr("has the name of a function"));
  EXPECT_THAT(with("value"), HasSubstr("has the name of the piece"));
  EXPECT_THAT(with("e1_a"), HasSubstr("has the name of what tracing adds"));
  EXPECT_THAT(with("friction_work"), HasSubstr("has the name of a history"));
  EXPECT_EQ(with("mu_static"), "accepted");
  for (const char* law : {"coulomb", "best", "mine_traced", "mine_q05"})
    EXPECT_THAT(
        fault_of(std::string("[models.") + law +
                 "]\nformula = \"mu*sigma_n_MPa\"\nparameters = { mu = { range = [0, 1] } }\n"),
        HasSubstr("a law cannot be called '" + std::string(law)));
  for (const char* law : {"oil-film", "oil film", "\xc3\x96l"})
    EXPECT_THAT(fault_of(std::string("[models.\"") + law + "\"]\nformula = \"mu*sigma_n_MPa\"\n"),
                HasSubstr("job.toml:3:9: error: '" + std::string(law) +
                          "' in [models] cannot be the name of a law\n  hint: names have letters "
                          "from a to z, digits and _"));
}

TEST(LawText, AFormulaThatGrowsBeyondItsTextIsRefused) {
  std::string law = "[models.mine]\nformula = \"mu*sigma_n_MPa*x40\"\n"
                    "parameters = { mu = { range = [0, 1] } }\n[models.mine.where]\nx0 = \"psi\"\n";
  for (int i = 1; i <= 40; ++i)
    law += "x" + std::to_string(i) + " = \"x" + std::to_string(i - 1) + "*x" +
           std::to_string(i - 1) + "\"\n";
  EXPECT_THAT(fault_of(law), HasSubstr("is too large with its parts in place"));
}

TEST(LawText, AFormulaIsSetAsMathematics) {
  const auto symbol = [](const std::string& name) { return "<mi>" + name + "</mi>"; };
  EXPECT_EQ(expr::mathml(expr::parse_expr("a*(x - 1)/sqrt(y)"), symbol),
            "<mrow><mfrac><mrow><mrow><mi>a</mi></mrow><mo>&#8290;</mo><mrow><mo>(</mo><mi>x</mi>"
            "<mo>&#8722;</mo><mrow><mn>1</mn></mrow><mo>)</mo></mrow></mrow><mrow><msqrt><mrow>"
            "<mi>y</mi></mrow></msqrt></mrow></mfrac></mrow>");
  EXPECT_THAT(expr::mathml(expr::parse_expr("where(x <= 3, x**2, 1e-9)"), symbol),
              HasSubstr("<msup><mrow><mi>x</mi></mrow><mrow><mn>2</mn></mrow></msup>"));
}

} // namespace
} // namespace frictab::law_text_test
