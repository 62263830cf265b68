// The polynomial: exact likelihood, terms found and left out, held outside its data, the same bits.
#include <cmath>

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "calibrate/polynomial_bins.h"
#include "core/random.h"
#include "data/condense.h"
#include "expr/program.h"
#include "models/assembled_law.h"
#include "models/polynomial.h"
#include "support/sample_data.h"
#include "support/threads.h"

namespace frictab::polynomial_test {

using calibrate::FittedPolynomial;
using calibrate::PolynomialProblem;
using data::Column;
using data::Dataset;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const models::Law& law() {
  return *models::find_law("polynomial");
}

Dataset campaign_of(const models::Model& truth, double scatter, double noise_MPa,
                    std::size_t experiments, std::uint64_t seed = 3) {
  test::SampleOptions options;
  options.experiments = experiments;
  options.experiment_scatter = scatter;
  options.noise_MPa = noise_MPa;
  options.seed = seed;
  return test::sample_data(truth, options);
}

Dataset campaign(double scatter, double noise_MPa, std::size_t experiments) {
  return campaign_of(test::plausible_model(*models::find_law("exp_coulomb")), scatter, noise_MPa,
                     experiments);
}

FittedPolynomial fitted_to(const Dataset& data) {
  return calibrate::regress_polynomial(law(), data, calibrate::conventions_of({}, data), 1);
}

models::Model model_of(const FittedPolynomial& fitted, const Dataset& data) {
  models::Model model;
  model.law = models::unregistered_law(fitted.law);
  model.conventions = calibrate::conventions_of({}, data);
  model.parameters = {fitted.mu0};
  return model;
}

double mean_error_of(const models::Model& model, const Dataset& data) {
  const std::vector<double> tau = calibrate::predict(model, data);
  double sum = 0;
  for (std::size_t i = 0; i < tau.size(); ++i)
    sum += std::abs(data.values("tau_R_MPa")[i] - tau[i]);
  return sum / static_cast<double>(tau.size());
}

void set(Dataset& data, const std::string& name, double value) {
  test::column(data, name).values.assign(data.rows(), value);
}

// ln mu = ln 0.08 - 0.2 z_sigma + 0.1 P2(z_v) + 0.05 z_sigma z_v, over the range of sample_data.
models::Model known_polynomial() {
  models::PolynomialState sigma{"sigma_n_MPa", 500, 2750, true, 0, 0, 1};
  models::PolynomialState v{"v_rel_mm_s", 5, 500, true, 0, 0, 1};
  for (models::PolynomialState* state : {&sigma, &v}) {
    state->centre = 0.5 * std::log(state->low * state->high);
    state->half = 0.5 * std::log(state->high / state->low);
  }
  models::Model model;
  model.law = models::unregistered_law(
      models::polynomial({{sigma, v}, {{1, 0}, {0, 2}, {1, 1}}, {-0.2, 0.1, 0.05}}));
  model.conventions.shear_limit = false;
  model.parameters = {0.08};
  return model;
}

PolynomialProblem some_problem(std::size_t experiments, Index bins_each, Index terms) {
  const Index size = static_cast<Index>(experiments) * bins_each;
  Random random(3);
  PolynomialProblem problem;
  problem.design = MatrixXd::NullaryExpr(size, terms + 1, [&] { return random.uniform(-1, 1); });
  problem.design.col(0).setOnes();
  problem.order.assign(static_cast<std::size_t>(terms) + 1, 1);
  problem.order.front() = 0;
  problem.order.back() = 2;
  problem.ln_mu = VectorXd::NullaryExpr(size, [&] { return -2.5 + 0.2 * random.normal(); });
  problem.position = VectorXd::NullaryExpr(size, [&](Index i) {
    return (static_cast<double>(i % bins_each) + 0.5) / static_cast<double>(bins_each) - 0.5;
  });
  problem.rows = VectorXd::NullaryExpr(size, [&] { return random.uniform(3, 30); });
  for (std::size_t e = 0; e <= experiments; ++e)
    problem.first.push_back(static_cast<Index>(e) * bins_each);
  return problem;
}

const std::vector<double> some_logs = {std::log(0.1),  std::log(0.05), std::log(0.07),
                                       std::log(0.15), std::log(0.06), std::log(0.3),
                                       std::log(0.2)};

// ---- the formula ----

TEST(PolynomialTerms, AreAllProductsUpToTheirOrder) {
  EXPECT_EQ(models::polynomial_terms(5, 1).size(), 5U);
  EXPECT_EQ(models::polynomial_terms(5, 2).size(), 20U);
  EXPECT_EQ(models::polynomial_terms(5, 3).size(), 55U);
  const auto second = models::polynomial_terms(4, 2), third = models::polynomial_terms(4, 3);
  EXPECT_TRUE(std::equal(second.begin(), second.end(), third.begin())) << "in front of order 3";
  EXPECT_EQ(models::term_text({2, 0, 1}, {{"psi"}, {"s_mm"}, {"T_contact_C"}}), "P2(z_psi) z_T");
}

TEST(PolynomialFormula, IsTheSumOfItsTerms) {
  const models::Model model = known_polynomial();
  const expr::Program program(models::tau_formula(*model.law, model.conventions),
                              {"sigma_n_MPa", "v_rel_mm_s"}, {"mu0"});
  const double z_sigma = std::log(800 * 800 / (500.0 * 2750)) / std::log(2750 / 500.0);
  const double z_v = std::log(300 * 300 / (5.0 * 500)) / std::log(500 / 5.0);
  const double ln_mu =
      std::log(0.08) - 0.2 * z_sigma + 0.1 * (3 * z_v * z_v - 1) / 2 + 0.05 * z_sigma * z_v;
  EXPECT_NEAR(program(std::vector{800.0, 300.0}, model.parameters), 800 * std::exp(ln_mu), 1e-11);
}

TEST(PolynomialFormula, IsHeldOutsideItsData) {
  const Dataset data = campaign(0.05, 5, 12);
  const models::AssembledLaw assembled(model_of(fitted_to(data), data));
  const expr::Program mu(assembled.piece, assembled.inputs, assembled.parameters);
  std::vector<double> far, end;
  for (const std::string& name : assembled.inputs) {
    const auto kinks = assembled.model.law->kinks.find(name);
    far.push_back(1e6);
    end.push_back(kinks == assembled.model.law->kinks.end() ? 1e6 : kinks->second.back());
  }
  const double at_end = mu(end, assembled.model.parameters);
  EXPECT_EQ(mu(far, assembled.model.parameters), at_end);
  EXPECT_GT(at_end, 0);
  EXPECT_TRUE(std::isfinite(at_end));
  for (double& x : far)
    x = 0;
  EXPECT_GT(mu(far, assembled.model.parameters), 0) << "at zero of every state";
}

TEST(PolynomialFormula, StaysNearTheCoefficientsOfTheDataInAllCornersOfAllStates) {
  const Dataset data = campaign(0.05, 5, 40); // mu from 0.05 to 0.1
  const models::AssembledLaw assembled(model_of(fitted_to(data), data));
  const expr::Program mu(assembled.piece, assembled.inputs, assembled.parameters);
  for (unsigned corner = 0; corner < 64; ++corner) {
    std::vector<double> state;
    for (std::size_t i = 0; i < assembled.inputs.size(); ++i)
      state.push_back(corner >> i & 1 ? 1e5 : 0);
    EXPECT_GT(mu(state, assembled.model.parameters), 0.03) << "corner " << corner;
    EXPECT_LT(mu(state, assembled.model.parameters), 0.2) << "corner " << corner;
  }
}

// ---- the fit ----

TEST(PolynomialCriterion, IsTheRestrictedLikelihoodOfAnExplicitCovariance) {
  const PolynomialProblem problem = some_problem(6, 4, 5);
  const Index size = problem.ln_mu.size();
  MatrixXd v = MatrixXd::Zero(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j) {
      if (i / 4 != j / 4) continue;
      const double x = problem.position(i), y = problem.position(j);
      v(i, j) = 0.01 + 12 * 0.0025 * x * y + 0.0049 * std::exp(-std::abs(x - y) / 0.15);
      if (i == j) v(i, j) += 0.0036 * problem.rows.mean() / problem.rows(i);
    }
  for (Index c = 1; c <= 5; ++c)
    v += (c == 5 ? 0.04 : 0.09) * problem.design.col(c) * problem.design.col(c).transpose();
  const VectorXd one = VectorXd::Ones(size), weighted = v.inverse() * one;
  const double mean = weighted.dot(problem.ln_mu) / weighted.dot(one);
  const VectorXd r = problem.ln_mu - mean * one;
  double expected =
      0.5 * (std::log(v.determinant()) + std::log(weighted.dot(one)) + r.dot(v.inverse() * r));
  const calibrate::PolynomialNoise usual;
  const std::vector<double> from = {usual.gain,  usual.slope, usual.slow, usual.length,
                                    usual.white, 0.05,        0.05};
  for (std::size_t k = 0; k < from.size(); ++k)
    expected += std::pow((some_logs[k] - std::log(from[k])) / 10, 2) / 2;
  EXPECT_NEAR(calibrate::polynomial_criterion(problem, some_logs), expected, 1e-9);
}

TEST(PolynomialCriterion, HasTheGradientOfCentralDifferences) {
  const PolynomialProblem problem = some_problem(6, 4, 5);
  std::vector<double> gradient(some_logs.size());
  calibrate::polynomial_criterion(problem, some_logs, gradient);
  for (std::size_t k = 0; k < some_logs.size(); ++k) {
    std::vector<double> above = some_logs, below = some_logs;
    above[k] += 1e-5;
    below[k] -= 1e-5;
    const double slope = (calibrate::polynomial_criterion(problem, above) -
                          calibrate::polynomial_criterion(problem, below)) /
                         2e-5;
    EXPECT_NEAR(gradient[k], slope, 1e-5) << "logarithm " << k;
  }
}

TEST(PolynomialFit, WithoutAnExperimentIsTheFitOfTheOthers) {
  PolynomialProblem problem = some_problem(6, 4, 5);
  const auto fit = calibrate::fit_polynomial(problem);
  const VectorXd b = fit.without.col(5);
  MatrixXd normal = MatrixXd::Zero(6, 6);
  VectorXd right = VectorXd::Zero(6);
  for (Index e = 0; e < 5; ++e) {
    MatrixXd v(4, 4);
    for (Index i = 0; i < 4; ++i)
      for (Index j = 0; j < 4; ++j) {
        const double x = problem.position(4 * e + i), y = problem.position(4 * e + j);
        const auto& n = fit.noise;
        v(i, j) = n.gain * n.gain + 12 * n.slope * n.slope * x * y +
                  n.slow * n.slow * std::exp(-std::abs(x - y) / n.length) +
                  (i == j ? n.white * n.white * problem.rows.mean() / problem.rows(4 * e + i) : 0);
      }
    const MatrixXd a = problem.design.middleRows(4 * e, 4);
    normal += a.transpose() * v.inverse() * a;
    right += a.transpose() * v.inverse() * problem.ln_mu.segment(4 * e, 4);
  }
  for (Index c = 1; c < 6; ++c)
    normal(c, c) += 1 / std::pow(fit.spread[problem.order[static_cast<std::size_t>(c)] - 1], 2);
  EXPECT_LT((b - normal.inverse() * right).cwiseAbs().maxCoeff(), 1e-8);
}

// One term is constant within experiments, so that its coefficient carries their factors.
TEST(PolynomialFit, StandardErrorsAreTheScatterOfCoefficientsBetweenCampaigns) {
  constexpr Index experiments = 40, bins_each = 5;
  constexpr int campaigns = 60;
  PolynomialProblem problem = some_problem(experiments, bins_each, 2);
  for (Index b = 0; b < problem.design.rows(); ++b)
    problem.design(b, 1) = problem.design(b - b % bins_each, 1);
  VectorXd square = VectorXd::Zero(3), claimed = VectorXd::Zero(3);
  const VectorXd truth{{-2.5, 0.2, -0.1}};
  for (int c = 0; c < campaigns; ++c) {
    Random random(7, static_cast<std::uint64_t>(c));
    problem.ln_mu = problem.design * truth;
    for (Index e = 0; e < experiments; ++e)
      problem.ln_mu.segment(e * bins_each, bins_each).array() += 0.08 * random.normal();
    for (double& y : problem.ln_mu)
      y += 0.02 * random.normal();
    const auto fit = calibrate::fit_polynomial(problem);
    square += (fit.coefficients - truth).cwiseAbs2();
    claimed += calibrate::jackknife_errors(fit).cwiseAbs2();
  }
  for (Index t = 0; t < 3; ++t) {
    const double ratio = std::sqrt(claimed(t) / square(t)); // known to 10 % from 60 campaigns
    EXPECT_GT(ratio, 0.75) << "column " << t;
    EXPECT_LT(ratio, 1.35) << "column " << t;
  }
}

TEST(PolynomialBins, FollowTheStatesAndNotTheRows) {
  Dataset data = campaign(0, 0, 5);
  for (const char* constant : {"sigma_n_MPa", "psi", "T_contact_C", "v_rel_mm_s"})
    set(data, constant, 100);
  for (Column& column : data.columns)
    if (column.name == "v_rel_mm_s")
      for (std::size_t i = 0; i < data.rows(); ++i)
        column.values[i] = i % 60 < 4 ? 10 : 200; // a step after four rows of sixty
  const auto bins = calibrate::polynomial_bins({"v_rel_mm_s"}, data, {});
  ASSERT_EQ(bins.states.size(), 1U);
  for (Index b = 0; b < bins.z.rows(); ++b)
    EXPECT_NEAR(std::abs(bins.z(b, 0)), 1, 1e-12) << "no bin straddles the step";
}

TEST(PolynomialBins, OfCondensedRowsEndWhereThoseOfTheRowsDo) {
  test::SampleOptions options;
  options.experiments = 3;
  options.rows = 7040;
  options.noise_MPa = 3;
  Dataset rows = test::sample_data(known_polynomial(), options);
  set(rows, "sigma_n_MPa", 1000);
  Random random(1);
  for (Column& column : rows.columns)
    if (column.name == "T_contact_C") // rises and falls, and its sensor scatters from row to row
      for (std::size_t i = 0; i < rows.rows(); ++i)
        column.values[i] =
            100 + 40 * std::sin(5e-4 * static_cast<double>(i)) + 20 * random.normal();
  const Dataset blocks = data::condense(rows, 880, nullptr);
  ASSERT_LT(blocks.rows(), 3 * 920U);
  const auto of_rows = calibrate::polynomial_bins({"T_contact_C"}, rows, {});
  const auto of_blocks = calibrate::polynomial_bins({"T_contact_C"}, blocks, {});
  ASSERT_EQ(of_rows.position.size(), of_blocks.position.size());
  for (Index b = 0; b < of_rows.position.size(); ++b) {
    EXPECT_NEAR(of_rows.position(b), of_blocks.position(b), 1e-12);
    EXPECT_NEAR(of_rows.ln_mu(b), of_blocks.ln_mu(b), 1e-12);
    EXPECT_NEAR(of_rows.z(b, 0), of_blocks.z(b, 0), 1e-12);
  }
}

// A text column that changes in every row of the beginning makes blocks of one row there, beside
// long ones behind.
TEST(PolynomialBins, OfBlocksOfVeryUnequalLengthStayInTheirExperiment) {
  test::SampleOptions options;
  options.experiments = 3;
  options.rows = 20000;
  Dataset rows = test::sample_data(known_polynomial(), options);
  Column mode{"mode", "", {}, {"a", "b"}};
  for (std::size_t i = 0; i < rows.rows(); ++i)
    mode.values.push_back(i % options.rows < 900 ? static_cast<double>(i % 2) : 0.0);
  rows.columns.push_back(mode);
  const Dataset blocks = data::condense(rows, 10, nullptr);
  ASSERT_GT(blocks.rows(), 3 * 880U);
  const auto bins = calibrate::polynomial_bins({"sigma_n_MPa", "v_rel_mm_s"}, blocks, {});
  ASSERT_EQ(bins.experiments(), 3U);
  EXPECT_NEAR(bins.rows.sum(), 3 * 20000.0, 1e-6) << "each row is in one bin";
  for (Index b = 0; b < bins.position.size(); ++b)
    EXPECT_LE(std::abs(bins.position(b)), 0.5);
}

// ---- the law ----

TEST(Polynomial, RecoversAKnownPolynomialOfSecondOrder) {
  const models::Model truth = known_polynomial();
  const Dataset training = campaign_of(truth, 0, 0.1, 40);
  const FittedPolynomial fitted = fitted_to(training);
  EXPECT_LT(mean_error_of(model_of(fitted, training), campaign_of(truth, 0, 0, 20, 8)), 0.2);
  std::vector<std::string> largest;
  for (std::size_t t = 0; t < 3; ++t)
    largest.push_back(fitted.record.terms.at(t).text);
  EXPECT_THAT(largest, testing::UnorderedElementsAre("z_sigma", "P2(z_v)", "z_sigma z_v"));
  EXPECT_LT(std::abs(fitted.record.terms.at(3).coefficient), 0.01);
}

TEST(Polynomial, GivesMostToTheOrderThatPredictsOthers) {
  const FittedPolynomial fitted = fitted_to(campaign_of(known_polynomial(), 0.02, 1, 40));
  const auto& shares = fitted.record.shares;
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_NEAR(shares[0] + shares[1] + shares[2], 1, 1e-9);
  EXPECT_EQ(shares[0], 0) << "a straight line does not bend in v";
  EXPECT_LT(fitted.record.cv_mae_MPa[1], fitted.record.cv_mae_MPa[0]);
}

TEST(Polynomial, DoesNotLearnTheFactorOfAnExperiment) {
  const models::Model truth = known_polynomial();
  const Dataset training = campaign_of(truth, 0.1, 3, 40);
  const FittedPolynomial fitted = fitted_to(training);
  EXPECT_NEAR(fitted.record.noise.gain, 0.1, 0.03);
  EXPECT_LT(mean_error_of(model_of(fitted, training), campaign_of(truth, 0, 0, 20, 8)), 6)
      << "MPa from the truth, where tests are 10 % apart";
}

TEST(Polynomial, IsTheSameForAnyNumberOfThreads) {
  const Dataset data = campaign(0.05, 5, 12);
  const auto text = [&] { return expr::to_text(models::tau_formula(fitted_to(data).law, {})); };
  EXPECT_EQ(test::with_threads(1, text), test::with_threads(2, text));
}

TEST(Polynomial, LeavesConstantStatesOut) {
  Dataset data = campaign(0.05, 5, 12);
  set(data, "psi", 1);
  test::column(data, "s_mm").name = "other";
  EXPECT_THAT(fitted_to(data).record.inputs,
              testing::ElementsAre("sigma_n_MPa", "v_rel_mm_s", "T_contact_C"));
}

TEST(Polynomial, ModelFileReadsBackToTheSameBits) {
  const Dataset data = campaign(0.05, 5, 12);
  const calibrate::Calibration calibration =
      calibrate::calibrate({data, data, {.use = {"polynomial"}}, {}});
  const calibrate::ModelFit& fit = calibration.fits.front();
  EXPECT_GT(fit.std_error.front(), 0);
  const models::Model again =
      calibrate::parse_model(calibrate::model_json(fit, calibration), "model.json");
  EXPECT_EQ(calibrate::predict(again, data), calibrate::predict(fit.model, data));
  EXPECT_EQ(again.law->kinks, fit.model.law->kinks);
  const calibrate::Calibration read =
      calibrate::parse_calibration(calibrate::calibration_json(calibration), "calibration.json");
  EXPECT_EQ(calibrate::calibration_json(read), calibrate::calibration_json(calibration));
}

TEST(Polynomial, CountsRowsBeyondItsEndsAsARemark) {
  const Dataset data = campaign(0.05, 5, 12);
  Dataset beyond = data;
  set(beyond, "v_rel_mm_s", 1e4);
  const calibrate::Calibration calibration =
      calibrate::calibrate({data, beyond, {.use = {"polynomial"}}, {}});
  EXPECT_THAT(calibration.fits.front().remarks,
              testing::Contains(testing::AllOf(
                  testing::HasSubstr("validation rows lie beyond the ends at which the law is "
                                     "held: "),
                  testing::HasSubstr("v_rel_mm_s above "))));
}

TEST(Polynomial, NeedsFiveExperiments) {
  const Dataset data = campaign(0.05, 5, 4);
  const calibrate::Calibration calibration = calibrate::calibrate({data, data, {}, {}});
  EXPECT_THAT(calibration.left_out,
              testing::Contains(testing::Property(&calibrate::LeftOut::text,
                                                  "polynomial: needs 5 experiments to train")));
}

TEST(Polynomial, StaysFiniteOnFewExperiments) {
  for (const std::size_t experiments : {1U, 2U, 3U, 5U}) {
    const Dataset data = campaign(0.05, 5, experiments);
    EXPECT_TRUE(std::isfinite(mean_error_of(model_of(fitted_to(data), data), data)))
        << experiments << " experiments";
  }
}

TEST(Polynomial, IsCoulombsWithoutFrictionOrLoad) {
  for (const char* zero : {"tau_R_MPa", "sigma_n_MPa"}) {
    Dataset data = campaign(0, 0, 8);
    set(data, zero, 0);
    set(data, "tau_R_MPa", 0);
    const FittedPolynomial fitted = fitted_to(data);
    EXPECT_EQ(mean_error_of(model_of(fitted, data), data), 0);
    EXPECT_FALSE(fitted.remarks.empty());
  }
}

TEST(Polynomial, SaysWhichBinsHaveNoFriction) {
  Dataset data = campaign(0.05, 5, 12);
  for (Column& column : data.columns)
    if (column.name == "tau_R_MPa")
      std::fill(column.values.begin() + 60, column.values.begin() + 120, -5.0);
  const FittedPolynomial fitted = fitted_to(data);
  EXPECT_THAT(fitted.remarks,
              testing::ElementsAre(testing::HasSubstr("9 of 108 bins have hardly any friction")));
  EXPECT_EQ(fitted.record.experiments, 11U);
  EXPECT_TRUE(std::isfinite(mean_error_of(model_of(fitted, data), data)));
}

} // namespace
} // namespace frictab::polynomial_test
