// What the design of tests leaves open: correlations, parameters that are not determined, how far
// a law may be followed, and which test moves it.
#include <cmath>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "calibrate/calibration_file.h"
#include "calibrate/cross_validation.h"
#include "calibrate/determined.h"
#include "calibrate/fit_law.h"
#include "calibrate/influence.h"
#include "calibrate/sandwich.h"
#include "calibrate/stress_error.h"
#include "support/gain_campaign.h"
#include "table/build.h"

namespace frictab::determined_test {

using calibrate::Calibration;
using calibrate::ModelFit;
using data::Dataset;
using models::AssembledLaw;
using test::GainCampaign;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

Calibration calibrated(const Dataset& data, const std::vector<std::string>& laws) {
  calibrate::ModelOptions models;
  models.use = laws;
  models.shear_limit = false;
  calibrate::CalibrationOptions options;
  options.bootstrap = 50;
  return calibrate::calibrate({data, data, models, options, calibrate::JudgedBy::leave_one_out});
}

ModelFit fitted(const Dataset& data, const std::string& law) {
  return calibrated(data, {law}).fits.front();
}

table::StateRange pressures(const ModelFit& fit, const Dataset& data,
                            const table::TableOptions& options = {}) {
  for (const table::StateRange& range : table::state_ranges(AssembledLaw(fit.model), data, options))
    if (range.name == "sigma_n_MPa") return range;
  throw std::logic_error("no pressure");
}

// Twelve tests at 1000 MPa +- 1 %, of a law without speed, which exp_coulomb does not take.
GainCampaign near_constant(double scatter = 0.01) {
  GainCampaign c = GainCampaign::spread(12, 3);
  c.b = 0;
  c.scatter = scatter;
  for (std::size_t e = 0; e < 12; ++e)
    c.pressure[e] = 1000 * (1 + 0.01 * (double(e % 5) - 2) / 2);
  return c;
}

// tau = sigma (c0 + c1 ln(sigma/1000) + ...) is linear: correlations and condition by hand.
TEST(Determined, CorrelationsOfALinearLawAreThoseOfItsDesign) {
  const Dataset data = GainCampaign::spread(15, 2).data();
  const ModelFit fit = fitted(data, "exp_coulomb");
  const auto sigma = data.values("sigma_n_MPa"), T = data.values("T_contact_C");
  const auto& p = fit.model.parameters; // mu0, a, b
  Eigen::MatrixXd j(Eigen::Index(data.rows()), 3);
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const double x = std::log(sigma[i] / 1000), t = T[i] - 20;
    const double tau = p[0] * sigma[i] * std::exp(p[1] * x + p[2] * t);
    j.row(Eigen::Index(i)) << tau / p[0], tau * x, tau * t;
  }
  const Eigen::MatrixXd h = j.transpose() * j, inverse = h.inverse();
  const Eigen::VectorXd scale = h.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * h * scale.asDiagonal())
          .eigenvalues();
  EXPECT_NEAR(fit.determination.condition, values(2) / values(0), 1e-6 * values(2) / values(0));
  ASSERT_EQ(fit.determination.pairs.size(), 2U);
  const auto& worst = fit.determination.pairs.front();
  EXPECT_EQ(worst.one, "mu0");
  const Eigen::Index other = worst.other == "a" ? 1 : 2;
  EXPECT_NEAR(worst.correlation,
              inverse(0, other) / std::sqrt(inverse(0, 0) * inverse(other, other)), 1e-6);
  EXPECT_GE(std::abs(worst.correlation), std::abs(fit.determination.pairs.back().correlation));
}

// ln tau = ln mu0 + a ln(p/1000) + b (T - 20): its derivatives are 1/mu0, ln(p/1000), T - 20.
TEST(Determined, StressErrorIsThatOfTheDeltaMethod) {
  const ModelFit fit = fitted(GainCampaign::spread(15, 2).data(), "exp_coulomb");
  const auto& V = fit.model.covariance;
  ASSERT_EQ(V.size(), 9U);
  EXPECT_NEAR(std::sqrt(V[4]), fit.std_error[1], 1e-15);
  EXPECT_EQ(V[1], V[3]);
  const calibrate::StressError error(fit.model, {"sigma_n_MPa", "T_contact_C"});
  const double g[] = {1 / fit.model.parameters[0], std::log(0.1), 60};
  double square = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      square += g[a] * V[std::size_t(3 * a + b)] * g[b];
  const double state[] = {100, 80};
  EXPECT_NEAR(*error.at(state), std::sqrt(square), 1e-12);
  EXPECT_EQ(fitted(GainCampaign::spread(15, 2).data(), "coulomb").model.covariance.size(), 1U);
}

TEST(Determined, AnExponentThatTestsAtOnePressureLeaveOpenIsTold) {
  const Dataset data = near_constant().data();
  const ModelFit fit = fitted(data, "exp_coulomb");
  ASSERT_EQ(fit.determination.not_determined.size(), 1U);
  const auto& open = fit.determination.not_determined.front();
  EXPECT_THAT(open.parameters, testing::Contains("a"));
  EXPECT_THAT(open.text, HasSubstr("these tests do not determine"));
  EXPECT_THAT(open.text, HasSubstr("; tests at sigma_n_MPa 670 and 1500 would"));
  EXPECT_THAT(fit.remarks, testing::Contains(open.text));
  const table::StateRange range = pressures(fit, data);
  ASSERT_TRUE(range.below);
  EXPECT_EQ(*range.below, table::Outside::clamp);
  EXPECT_THAT(range.why_held, HasSubstr("the law's own standard error is "));
  EXPECT_THAT(range.why_held, HasSubstr("20 % are allowed"));
  table::TableOptions asked;
  asked.axes["sigma_n_MPa"].outside = {"law"};
  EXPECT_FALSE(pressures(fit, data, asked).below) << "the job's word";
}

// Where so little is known that the fit ends at a bound, its error is none, and not nothing.
TEST(Determined, ALawAtABoundIsNotFollowedBeyondTheTests) {
  std::size_t at_bound = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    GainCampaign c = near_constant(0.2);
    c.seed = seed;
    const Dataset data = c.data();
    const ModelFit fit = fitted(data, "exp_coulomb");
    if (fit.uncertainty->why_none[1] != "at its bound") continue;
    ++at_bound;
    ASSERT_TRUE(pressures(fit, data).below) << seed;
    EXPECT_THAT(pressures(fit, data).why_held, HasSubstr("is not known"));
    EXPECT_THAT(fit.determination.not_determined, testing::Not(IsEmpty()));
  }
  EXPECT_GE(at_bound, 2U);
}

TEST(Determined, OneTemperatureAndOneSpeedAreToldAlike) {
  GainCampaign c = GainCampaign::spread(12, 5);
  for (std::size_t e = 0; e < 12; ++e) {
    c.temperature[e] = 100 + 0.5 * double(e % 3);
    c.speed[e] = 50 + 0.5 * double(e % 4);
  }
  const ModelFit fit = fitted(c.data(), "wzl");
  std::string said;
  for (const auto& open : fit.determination.not_determined)
    said += open.text + "\n";
  EXPECT_THAT(said, HasSubstr("tests at v_rel_mm_s 34 and 77 would"));
  EXPECT_THAT(said, HasSubstr("tests at T_contact_C 73 and 130 would"));
  EXPECT_THAT(said, testing::Not(HasSubstr("sigma_n_MPa")));
}

TEST(Determined, NothingIsToldOfWhatTheTestsDetermine) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Dataset data = GainCampaign::spread(12, seed).data();
    for (const ModelFit& fit : calibrated(data, {"coulomb", "exp_coulomb", "wzl"}).fits)
      EXPECT_THAT(fit.determination.not_determined, IsEmpty())
          << seed << ": " << fit.determination.not_determined.front().text;
  }
}

// A tenth below the lowest pressure: how far the law is off there, and how far the coefficient at
// the end is, which a table holds; both against the truth. The rule takes the better one.
TEST(Determined, EndsAreHeldWhereTheLawWouldBeFurtherOff) {
  double shared_law = 0, held_end = 0, followed_law = 0, followed_end = 0;
  std::size_t held = 0, followed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    // From tests over a factor of 4 in the pressure to tests over 5 %.
    const double span = std::pow(4, 1 / double(1 + seed % 10));
    GainCampaign c = GainCampaign::spread(12, seed, 1000 / span, 1000 * span);
    c.b = 0;
    const Dataset data = c.data();
    const ModelFit fit = fitted(data, "exp_coulomb");
    const table::StateRange range = pressures(fit, data);
    const models::Model& m = fit.model;
    const auto mu = [&](double p) {
      return m.parameters[0] * std::pow(p / 1000, m.parameters[1]) * std::exp(m.parameters[2] * 80);
    };
    const double there = 0.1 * range.low, truth = 0.07 * std::pow(there / 1000, c.a);
    const double law = std::pow(std::log(mu(there) / truth), 2),
                 end = std::pow(std::log(mu(range.low) / truth), 2);
    (range.below ? shared_law : followed_law) += law;
    (range.below ? held_end : followed_end) += end;
    ++(range.below ? held : followed);
  }
  ASSERT_GE(held, 15U);
  ASSERT_GE(followed, 15U);
  EXPECT_LT(held_end, shared_law);
  EXPECT_LT(followed_law, followed_end);
}

TEST(Determined, StatesThatChangeTogetherTieTheirExponents) {
  GainCampaign c = GainCampaign::spread(14, 4);
  c.scatter = 0.005;
  for (std::size_t e = 0; e < 14; ++e)
    c.speed[e] = c.pressure[e] / 10 * (1 + 0.02 * (double(e % 3) - 1));
  const ModelFit fit = fitted(c.data(), "wzl");
  const auto& worst = fit.determination.pairs.front();
  EXPECT_THAT((std::vector<std::string>{worst.one, worst.other}), ElementsAre("a", "b"));
  EXPECT_LT(worst.correlation, -0.95);
  ASSERT_FALSE(fit.determination.not_determined.empty());
  EXPECT_THAT(fit.determination.not_determined.front().parameters, ElementsAre("a", "b"));
  EXPECT_THAT(fit.determination.not_determined.front().text,
              HasSubstr("these tests hardly distinguish one from the other (correlation -"));
}

TEST(Determined, IsWrittenAndReadBack) {
  Calibration c = calibrated(near_constant().data(), {"coulomb", "exp_coulomb"});
  c.influence.push_back({"coulomb", "t03", {{"mu", 0.07, 0.08, 0.003}}, "exp_coulomb"});
  const std::string text = calibrate::calibration_json(c);
  EXPECT_EQ(calibrate::calibration_json(calibrate::parse_calibration(text, "c.json")), text);
  const models::Model model =
      calibrate::parse_model(calibrate::model_json(c.fits.front(), c), "m.json");
  EXPECT_EQ(model.covariance, c.fits.front().model.covariance);
}

// A mean moves by its residual over the others, and one step says it to the last digit where the
// law is linear.
TEST(Influence, OneStepIsTheFitWithoutATestWhereTheLawIsLinear) {
  const Dataset data = GainCampaign::spread(9, 8).data();
  const models::Conventions free{.shear_limit = false};
  for (const char* law : {"coulomb", "coulomb_mean"}) {
    const ModelFit fit = calibrate::fit_law(*models::find_law(law), free, data, {});
    for (std::size_t e = 0; e < 9; ++e) {
      const ModelFit without =
          calibrate::fit_law(*models::find_law(law), free, calibrate::without_kin(data, e), {});
      EXPECT_NEAR(fit.uncertainty->moved_without(0, Eigen::Index(e)),
                  without.model.parameters[0] - fit.model.parameters[0],
                  1e-5 * fit.std_error[0]) // what the fit's tolerance leaves
          << law << " " << e;
    }
  }
  const ModelFit curved = calibrate::fit_law(*models::find_law("exp_coulomb"), free, data, {});
  for (std::size_t e = 0; e < 9; ++e) {
    const ModelFit without = calibrate::fit_law(*models::find_law("exp_coulomb"), free,
                                                calibrate::without_kin(data, e), {});
    for (Eigen::Index p = 0; p < 3; ++p)
      EXPECT_NEAR(curved.uncertainty->moved_without(p, Eigen::Index(e)),
                  without.model.parameters[std::size_t(p)] -
                      curved.model.parameters[std::size_t(p)],
                  0.1 * curved.std_error[std::size_t(p)])
          << e << " " << p;
  }
}

TEST(Influence, OfATestAtHalfItsStressIsNamedWithTheLawWithoutIt) {
  GainCampaign c = GainCampaign::spread(12, 6);
  const Dataset clean = c.data();
  Dataset data = clean;
  for (std::size_t i = data.first_row[4]; i < data.first_row[5]; ++i)
    data.columns[3].values[i] *= 0.5;
  const Calibration found = calibrated(data, {"coulomb", "wzl"});
  for (const char* law : {"coulomb", "wzl"}) {
    const auto named = std::ranges::find_if(found.influence, [&](const auto& one) {
      return one.law == law && one.experiment == "t04";
    });
    ASSERT_NE(named, found.influence.end()) << law;
    ASSERT_FALSE(named->moved.empty());
    const models::Law& of = *models::find_law(law);
    const models::Model alone =
        calibrate::fit_law(of, {.shear_limit = false}, calibrate::without_kin(data, 4), {}).model;
    for (const auto& moved : named->moved)
      for (std::size_t p = 0; p < of.parameters.size(); ++p)
        if (of.parameters[p].name == moved.parameter) {
          EXPECT_DOUBLE_EQ(moved.without, alone.parameters[p]);
          EXPECT_GT(std::abs(moved.value - moved.without), moved.std_error);
        }
  }
  EXPECT_THAT(calibrate::influence_sentence(found), HasSubstr("test 't04' "));
}

// Of held-out tests nothing was fitted without: one step finds them, a fit says what they do.
TEST(Influence, IsFoundWhereTestsWereHeldOutToo) {
  GainCampaign c = GainCampaign::spread(40, 7);
  c.pressure[11] = 2000; // of the law's rows those at high pressure weigh most
  Dataset data = c.data();
  for (std::size_t i = data.first_row[11]; i < data.first_row[12]; ++i)
    data.columns[3].values[i] *= 2.5;
  const data::Split parts{
      data.subset(std::vector<std::size_t>{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                           10, 11, 12, 13, 14, 15, 16, 17, 18, 19,
                                           20, 21, 22, 23, 24, 25, 26, 27, 28, 29}),
      data.subset(std::vector<std::size_t>{30, 31, 32, 33, 34, 35, 36, 37, 38, 39})};
  calibrate::ModelOptions models;
  models.use = {"coulomb"};
  models.shear_limit = false;
  const Calibration found = calibrate::calibrate(
      {parts.training, parts.validation, models, {}, calibrate::JudgedBy::held_out});
  ASSERT_EQ(found.influence.size(), 1U);
  EXPECT_EQ(found.influence[0].experiment, "t11");
  const double without = calibrate::fit_law(*models::find_law("coulomb"), {.shear_limit = false},
                                            calibrate::without_kin(parts.training, 11), {})
                             .model.parameters[0];
  EXPECT_DOUBLE_EQ(found.influence[0].moved[0].without, without);
}

TEST(Influence, SaysWhichTestDecidesTheFirstPlace) {
  GainCampaign c = GainCampaign::spread(10, 9);
  c.a = c.b = c.g = 0;
  c.scatter = 0.01;
  Dataset data = c.data();
  // One test follows another law, which the others do not: the first place hangs on it.
  for (std::size_t i = data.first_row[2]; i < data.first_row[3]; ++i)
    data.columns[3].values[i] *= 3;
  const Calibration found = calibrated(data, {"coulomb", "coulomb_mean"});
  std::vector<double> mae(2);
  for (std::size_t l = 0; l < 2; ++l)
    for (std::size_t e = 0; e < 10; ++e)
      if (e != 2) mae[l] += found.fits[l].unseen[e].mae_MPa;
  const bool turns = mae[1] < mae[0] * (1 - 1e-4);
  const auto named = std::ranges::find_if(found.influence, [&](const auto& one) {
    return one.experiment == "t02" && one.law == found.fits[0].model.law->name;
  });
  ASSERT_NE(named, found.influence.end());
  EXPECT_EQ(named->first, turns ? found.fits[1].model.law->name : "");
}

// Rows that count as their uncertainty says: least squares of mu sigma under 1/u^2.
TEST(Uncertainties, WeighRowsInFits) {
  Dataset data = GainCampaign::spread(8, 10).data();
  std::vector<double> u;
  for (std::size_t i = 0; i < data.rows(); ++i)
    u.push_back(1 + double(i % 7));
  const auto sigma = data.values("sigma_n_MPa"), tau = data.values("tau_R_MPa");
  double above = 0, below = 0, ratios = 0, weights = 0;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const double w = 1 / (u[i] * u[i]);
    above += w * tau[i] * sigma[i];
    below += w * sigma[i] * sigma[i];
    ratios += w * tau[i] / sigma[i];
    weights += w;
  }
  const auto fit_of = [&](const char* law) {
    return calibrate::fit_law(*models::find_law(law), {.shear_limit = false}, data, {});
  };
  const double plain = fit_of("coulomb").model.parameters[0];
  data.columns.push_back({"tau_R_error_MPa", "MPa", u, {}});
  EXPECT_NEAR(fit_of("coulomb").model.parameters[0], above / below, 1e-9);
  EXPECT_NEAR(fit_of("coulomb_mean").model.parameters[0], ratios / weights, 1e-12);
  EXPECT_GT(std::abs(fit_of("coulomb").model.parameters[0] - plain), 1e-7);
  for (double& value : data.columns.back().values)
    value = 3;
  EXPECT_EQ(fit_of("coulomb").model.parameters[0], plain) << "one for all is none";
}

// Two tests that do not count at all leave the fit of the others, standard errors included.
TEST(Uncertainties, TakeAwayWhatTheyMakeWorthless) {
  const Dataset whole = GainCampaign::spread(12, 11).data();
  Dataset data = whole;
  std::vector<double> u(data.rows(), 1.0);
  for (std::size_t i = data.first_row[10]; i < data.rows(); ++i) {
    u[i] = 1e5;
    data.columns[3].values[i] *= 4;
  }
  data.columns.push_back({"tau_R_error_MPa", "MPa", u, {}});
  const std::vector<std::size_t> first_ten{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  for (const calibrate::Loss loss :
       {calibrate::Loss::l2, calibrate::Loss::l1, calibrate::Loss::huber}) {
    calibrate::CalibrationOptions options;
    options.loss = loss;
    const models::Law& law = *models::find_law("exp_coulomb");
    const ModelFit all = calibrate::fit_law(law, {.shear_limit = false}, data, options),
                   ten = calibrate::fit_law(law, {.shear_limit = false}, whole.subset(first_ten),
                                            options);
    for (std::size_t p = 0; p < 3; ++p) {
      EXPECT_NEAR(all.model.parameters[p], ten.model.parameters[p], 0.02 * ten.std_error[p])
          << int(loss) << " " << p;
      EXPECT_NEAR(all.std_error[p], ten.std_error[p], 0.02 * ten.std_error[p]) << int(loss);
    }
  }
}

} // namespace
} // namespace frictab::determined_test
