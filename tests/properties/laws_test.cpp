// What must hold for every friction law, because it is registered.
#include <cmath>

#include <gtest/gtest.h>

#include "calibrate/fit.h"
#include "core/columns.h"
#include "core/random.h"
#include "data/quantity.h"
#include "models/law.h"
#include "support/law_parameter.h"
#include "support/sample_data.h"

namespace frictab::laws_test {

using expr::Expr;
using expr::Program;
using models::inputs;
using models::parameter_names;
using models::tau_formula;

namespace {

class EveryLaw : public testing::TestWithParam<std::string> {
protected:
  const models::Law& law() const { return *models::find_law(GetParam()); }
};

TEST_P(EveryLaw, DescribesItself) {
  EXPECT_FALSE(law().title.empty());
  EXPECT_FALSE(law().formula.empty());
  EXPECT_FALSE(law().reference.empty());
  ASSERT_FALSE(law().parameters.empty());
  for (const models::Parameter& p : law().parameters) {
    EXPECT_FALSE(p.meaning.empty()) << p.name;
    EXPECT_FALSE(p.unit.empty()) << p.name;
    EXPECT_LT(p.lower, p.upper) << p.name;
    EXPECT_LE(p.lower, p.start) << p.name;
    EXPECT_LE(p.start, p.upper) << p.name;
  }
  for (const std::string& input : inputs(law(), {}))
    EXPECT_TRUE(data::find_quantity(input) && data::find_quantity(input)->state) << input;
}

TEST_P(EveryLaw, StaysBetweenZeroAndTheShearLimitForAnyParameters) {
  const models::Conventions conventions;
  const auto names = inputs(law(), conventions);
  const Program program(tau_formula(law(), conventions), names, parameter_names(law()));
  const auto states = test::random_states(names, 2000, 3);
  const auto columns = pointers(states);
  std::size_t at_k = 0;
  while (names[at_k] != "sigma_f_MPa")
    ++at_k;
  Random random(5);
  for (int draw = 0; draw < 50; ++draw) {
    std::vector<double> parameters, tau(2000);
    for (const models::Parameter& p : law().parameters)
      parameters.push_back(random.uniform(p.lower, p.upper));
    program.evaluate(2000, columns, parameters, tau.data());
    for (std::size_t i = 0; i < tau.size(); ++i) {
      const double k = conventions.k_over_sigma_f * states[at_k][i];
      ASSERT_GE(tau[i], 0) << "row " << i;
      ASSERT_LE(tau[i], k) << "row " << i;
    }
  }
}

TEST_P(EveryLaw, GradientAgreesWithCentralDifferences) {
  const models::Model model = test::plausible_model(law());
  const auto names = inputs(law(), model.conventions);
  const Program program(tau_formula(law(), model.conventions), names, parameter_names(law()));
  const auto states = test::random_states(names, 500, 7);
  const auto columns = pointers(states);
  const expr::BoundProgram bound(program, 500, columns);
  const auto tau_at = [&](std::vector<double> parameters) {
    std::vector<double> tau(500);
    program.evaluate(500, columns, parameters, tau.data());
    return tau;
  };
  std::vector<std::vector<double>> analytic(model.parameters.size(), std::vector<double>(500));
  bound.sweep(model.parameters, true, [&](const expr::BoundProgram::Block& block) {
    for (std::size_t p = 0; p < analytic.size(); ++p)
      for (std::size_t i = 0; i < block.count; ++i)
        analytic[p][block.first + i] = block.derivative[p][i];
  });
  const std::vector<double> centre = tau_at(model.parameters);
  for (std::size_t p = 0; p < analytic.size(); ++p) {
    const double h = 1e-6 * std::max(std::abs(model.parameters[p]), 1e-2);
    auto up = model.parameters, down = model.parameters;
    up[p] += h;
    down[p] -= h;
    const auto high = tau_at(up), low = tau_at(down);
    for (std::size_t i = 0; i < 500; ++i) {
      const double right = (high[i] - centre[i]) / h, left = (centre[i] - low[i]) / h;
      if (std::abs(right - left) > 1e-3 * (std::abs(right) + 1)) continue; // a kink in between
      const double difference = (high[i] - low[i]) / (2 * h);
      EXPECT_NEAR(analytic[p][i], difference, 1e-5 * (std::abs(difference) + centre[i] + 1))
          << law().parameters[p].name << " row " << i;
    }
  }
}

TEST_P(EveryLaw, NaNInAnyStateItUsesGivesNaN) {
  const models::Model model = test::plausible_model(law());
  const auto names = inputs(law(), model.conventions);
  const Program program(tau_formula(law(), model.conventions), names, parameter_names(law()));
  for (std::size_t n = 0; n < names.size(); ++n) {
    auto states = test::random_states(names, 1, 11);
    std::vector<double> row;
    for (const auto& column : states)
      row.push_back(column[0]);
    row[n] = std::nan("");
    EXPECT_TRUE(std::isnan(program(row, model.parameters))) << names[n];
  }
}

TEST_P(EveryLaw, TextOfItsFormulaReadsBackToTheSameBits) {
  const models::Model model = test::plausible_model(law());
  const Expr formula = tau_formula(law(), model.conventions);
  const Expr again = expr::parse_expr(expr::to_text(formula));
  EXPECT_EQ(expr::to_text(again), expr::to_text(formula));
  const auto names = inputs(law(), model.conventions);
  const Program a(formula, names, parameter_names(law()));
  const Program b(again, names, parameter_names(law()));
  const auto states = test::random_states(names, 300, 13);
  std::vector<double> x(300), y(300);
  a.evaluate(300, pointers(states), model.parameters, x.data());
  b.evaluate(300, pointers(states), model.parameters, y.data());
  EXPECT_EQ(x, y);
}

TEST_P(EveryLaw, WithoutTheShearLimitNeedsNoFlowStressUnlessItsFormulaDoes) {
  models::Conventions conventions;
  conventions.shear_limit = false;
  const auto limited = inputs(law(), {});
  const auto free = inputs(law(), conventions);
  EXPECT_LE(free.size(), limited.size());
  EXPECT_NE(std::ranges::find(limited, "sigma_f_MPa"), limited.end());
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryLaw, testing::ValuesIn(models::law_names()),
                         test::law_test_name);

TEST(Laws, HaveTheNamesOfTheContract) {
  const std::vector<std::string> contract = {
      "coulomb_0.04", "coulomb_0.08", "shear_0.12", "coulomb_mean", "shear_mean",    "orowan_mean",
      "coulomb",      "shear",        "orowan",     "shaw",         "wanheim_bay",   "levanov",
      "log_coulomb",  "exp_coulomb",  "wzl",        "polynomial",   "neural_network"};
  EXPECT_EQ(models::law_names(), contract);
}

double tau(const std::string& name, std::vector<double> parameters, double sigma_n, double sigma_f,
           const models::Conventions& conventions = {}) {
  const models::Law& law = *models::find_law(name);
  const Program program(tau_formula(law, conventions), {"sigma_n_MPa", "sigma_f_MPa"},
                        parameter_names(law));
  const std::vector<double> row{sigma_n, sigma_f};
  return program(row, parameters);
}

TEST(Shaw, ApproachesOrowanAsItsExponentGrows) {
  for (const double sigma : {500.0, 1500.0, 2500.0})
    EXPECT_NEAR(tau("shaw", {0.1, 0.4, 400}, sigma, 500), tau("orowan", {0.1, 0.4}, sigma, 500),
                0.3);
}

TEST(Shaw, HasSlopeMuAtZeroAndPlateauMk) {
  EXPECT_NEAR(tau("shaw", {0.1, 0.4, 2}, 1e-3, 500), 1e-4, 1e-9);
  EXPECT_NEAR(tau("shaw", {0.1, 0.4, 2}, 1e7, 500), 0.4 * 500 / std::sqrt(3.0), 1e-3);
}

TEST(WanheimBay, InitialSlopeIsThePublishedEquivalentCoefficient) {
  for (const double f : {0.1, 0.5, 0.9}) {
    const double mu = f / (1 + std::acos(-1.0) / 2 + std::acos(f) + std::sqrt(1 - f * f));
    EXPECT_NEAR(tau("wanheim_bay", {f}, 1, 500), mu, 1e-4) << f;
  }
}

TEST(WanheimBay, IsContinuousWithContinuousSlopeAtItsLimitOfProportionality) {
  const double f = 0.6, sf = 500, root = std::sqrt(1 - f);
  const double q1 = (1 + std::acos(-1.0) / 2 + std::acos(f) + std::sqrt(1 - f * f)) /
                    (std::sqrt(3.0) * (1 + root));
  const double s = q1 * sf, h = 1e-3;
  const double left = (tau("wanheim_bay", {f}, s, sf) - tau("wanheim_bay", {f}, s - h, sf)) / h;
  const double right = (tau("wanheim_bay", {f}, s + h, sf) - tau("wanheim_bay", {f}, s, sf)) / h;
  EXPECT_NEAR(left, right, 1e-5);
  EXPECT_NEAR(tau("wanheim_bay", {f}, 1e5, sf), f * sf / std::sqrt(3.0), 1e-6);
}

// tau/k over p/k, as slip lines give it: nothing in it knows the flow stress.
double slip_line_tau_over_k(double p_over_k, double f) {
  const double pi = std::acos(-1.0), mu = f / (1 + pi / 2 + std::acos(f) + std::sqrt(1 - f * f));
  const double at_limit = 1 - std::sqrt(1 - f), limit = at_limit / mu;
  if (p_over_k <= limit) return mu * p_over_k;
  const double left = f - at_limit;
  return at_limit + left * (1 - std::exp((1 - p_over_k / limit) * at_limit / left));
}

TEST(WanheimBay, FollowsSlipLinesWhateverKTheJobMeans) {
  for (const auto& [yield, k_over_sigma_f] :
       {std::pair{models::ShearYield::mises, 1 / std::sqrt(3.0)},
        std::pair{models::ShearYield::tresca, 0.5},
        std::pair{models::ShearYield::flow_stress, 1.0}}) {
    models::Conventions conventions;
    conventions.shear_yield = yield;
    conventions.k_over_sigma_f = models::shear_yield_ratio(yield);
    for (const double sigma_n : {10.0, 300.0, 600.0, 900.0, 2000.0, 6000.0})
      for (const double f : {0.1, 0.5, 0.9}) {
        const double k = k_over_sigma_f * 450;
        EXPECT_NEAR(tau("wanheim_bay", {f}, sigma_n, 450, conventions),
                    k * slip_line_tau_over_k(sigma_n / k, f), 1e-9 * k)
            << sigma_n << " " << f << " " << models::shear_yield_name(yield);
      }
  }
}

TEST(Wzl, OfItsPublishedConstantsIsThePublishedProduct) {
  const models::Law& law = *models::find_law("wzl");
  models::Conventions conventions;
  conventions.shear_limit = false;
  const Program program(tau_formula(law, conventions), {"sigma_n_MPa", "v_rel_mm_s", "T_contact_C"},
                        parameter_names(law));
  const std::vector<double> published = models::start_values(law.parameters);
  EXPECT_NEAR(published[0], 0.0198, 5e-5);
  for (const double p : {0.5, 20.0, 1500.0})
    for (const double v : {2.0, 80.0})
      for (const double T : {10.0, 150.0}) {
        const std::vector<double> row{p, v, T};
        const double mu = 0.0623 * std::pow(std::max(p, 1.0), -0.1542) *
                          std::pow(std::max(v, 10.0), -0.1192) *
                          std::pow(std::max(T, 20.0), 0.1017);
        EXPECT_NEAR(program(row, published), mu * p, 1e-12 * p) << p << " " << v << " " << T;
      }
}

TEST(Levanov, InitialCoefficientIs125mOverRoot3) {
  EXPECT_NEAR(tau("levanov", {0.2}, 1e-3, 500) / 1e-3, 1.25 * 0.2 / std::sqrt(3.0), 1e-6);
}

} // namespace
} // namespace frictab::laws_test
