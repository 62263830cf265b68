// Conditional use: a gain per experiment from its first millimetres.
#include <cmath>

#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "calibrate/conditional.h"
#include "core/error.h"
#include "core/random.h"
#include "support/refusal.h"
#include "support/sample_data.h"
#include "twin/twin.h"

namespace frictab::conditional_test {

using calibrate::conditioned_predictions;
using calibrate::gain_prior;
using calibrate::GainPrior;
using data::Dataset;

namespace {

struct Campaign {
  std::size_t experiments = 40;
  std::size_t rows = 100; // along 10 mm
  double gain_sd = 0.1;
  double noise = 0; // per row, share of tau
  std::uint64_t seed = 1;
};

// tau = gain * 0.1 sigma.
Dataset gained(const Campaign& c) {
  Dataset data;
  data.columns = {
      {"sigma_n_MPa", "MPa", {}, {}}, {"s_mm", "mm", {}, {}}, {"tau_R_MPa", "MPa", {}, {}}};
  Random random(c.seed);
  for (std::size_t e = 0; e < c.experiments; ++e) {
    const double gain = std::exp(c.gain_sd * random.normal()), level = random.uniform(800, 1500);
    for (std::size_t i = 0; i < c.rows; ++i) {
      const double s = 10 * static_cast<double>(i) / static_cast<double>(c.rows - 1);
      data.columns[0].values.push_back(level * (1 + 0.02 * s));
      data.columns[1].values.push_back(s);
      data.columns[2].values.push_back(0.1 * data.columns[0].values.back() * gain *
                                       (1 + c.noise * random.normal()));
    }
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.first_row.back() + c.rows);
  }
  return data;
}

std::vector<double> tenth_of_stress(const Dataset& data) {
  std::vector<double> tau;
  for (const double sigma : data.values("sigma_n_MPa"))
    tau.push_back(0.1 * sigma);
  return tau;
}

double mae_beyond(const Dataset& data, const std::vector<double>& predicted, double x) {
  double sum = 0, rows = 0;
  for (std::size_t i = 0; i < data.rows(); ++i)
    if (data.values("s_mm")[i] > x) {
      sum += std::abs(data.values("tau_R_MPa")[i] - predicted[i]);
      ++rows;
    }
  return sum / rows;
}

TEST(Conditional, FindsKnownGainsExactlyWithoutNoise) {
  const Dataset training = gained({}), validation = gained({.seed = 2});
  const GainPrior prior = gain_prior(training, tenth_of_stress(training), 1.0);
  EXPECT_NEAR(prior.trust(10), 1, 1e-9);
  EXPECT_NEAR(std::sqrt(prior.between), 0.1, 0.03);
  const auto plain = tenth_of_stress(validation);
  EXPECT_GT(mae_beyond(validation, plain, 1), 5);
  EXPECT_LT(mae_beyond(validation, conditioned_predictions(validation, plain, {}, prior, 1), 1),
            1e-9);
}

TEST(Conditional, DoesNotFollowNoiseWhereExperimentsAreAlike) {
  const Campaign alike{.gain_sd = 0, .noise = 0.1};
  const Dataset training = gained(alike),
                validation = gained({.gain_sd = 0, .noise = 0.1, .seed = 2});
  const GainPrior prior = gain_prior(training, tenth_of_stress(training), 0.15);
  EXPECT_LT(prior.trust(2), 0.3);
  const auto plain = tenth_of_stress(validation);
  EXPECT_LT(
      mae_beyond(validation, conditioned_predictions(validation, plain, {}, prior, 0.15), 0.15),
      1.02 * mae_beyond(validation, plain, 0.15));
}

TEST(Conditional, TrustsFewRowsLess) {
  const GainPrior prior{1, 1, 0.01, 0.005, 20};
  EXPECT_DOUBLE_EQ(prior.trust(20), 0.01 / 0.015);
  EXPECT_DOUBLE_EQ(prior.trust(2), 0.01 / 0.06);
  EXPECT_DOUBLE_EQ(prior.trust(500), prior.trust(20)) << "rows of one experiment are alike";
  EXPECT_EQ(prior.trust(0), 0);
}

TEST(Conditional, TakesOutWhatALawMissesInEveryRunIn) {
  // Friction 20 % higher in the first millimetre of every test, which the law does not know.
  Dataset training = gained({}), validation = gained({.seed = 2});
  for (Dataset* data : {&training, &validation})
    for (std::size_t i = 0; i < data->rows(); ++i)
      if (data->columns[1].values[i] <= 1) data->columns[2].values[i] *= 1.2;
  const GainPrior prior = gain_prior(training, tenth_of_stress(training), 1);
  EXPECT_NEAR(prior.usual_first, 1.2, 0.05);
  const auto plain = tenth_of_stress(validation);
  EXPECT_LT(mae_beyond(validation, conditioned_predictions(validation, plain, {}, prior, 1), 1),
            0.05 * mae_beyond(validation, plain, 1));
}

TEST(Conditional, KeepsTheShearLimitAfterTheGain) {
  const Dataset training = gained({}), validation = gained({.seed = 2});
  const GainPrior prior = gain_prior(training, tenth_of_stress(training), 1);
  const std::vector<double> limit(validation.rows(), 100.0);
  for (const double tau :
       conditioned_predictions(validation, tenth_of_stress(validation), limit, prior, 1))
    EXPECT_LE(tau, 100);
}

TEST(Conditional, OfTheTruthOfTheTwinComesNearToKnowingEachTestsFactor) {
  const twin::Twin twin = twin::make_twin({});
  const GainPrior prior = gain_prior(twin.training.data, twin.training.oracle_MPa, 1);
  const Dataset& data = twin.validation.data;
  const double without = mae_beyond(data, twin.validation.oracle_MPa, 1);
  const double with =
      mae_beyond(data, conditioned_predictions(data, twin.validation.oracle_MPa, {}, prior, 1), 1);
  EXPECT_NEAR(without, 8.45, 0.05);
  EXPECT_GT(with, 3.4) << "the factor itself known";
  EXPECT_LT(with, 4.3);
}

calibrate::CalibrationInput asked(const Dataset& training, const Dataset& validation, double x) {
  calibrate::CalibrationInput input{training, validation, {}, {}};
  input.models.use = {"coulomb", "coulomb_0.08"};
  input.options.condition_on_mm = x;
  input.options.place = {"job.toml", 5, 1};
  return input;
}

TEST(Conditional, IsReportedApartOnTheSameRowsAndReadsBack) {
  const Dataset training = gained({.noise = 0.02}), validation = gained({.noise = 0.02, .seed = 2});
  const calibrate::Calibration c = calibrate::calibrate(asked(training, validation, 1));
  EXPECT_EQ(c.fits.size(), 2u) << "not among the ranked laws";
  ASSERT_EQ(c.conditional.laws.size(), 2u);
  for (const calibrate::ConditionalFit& fit : c.conditional.laws) {
    EXPECT_EQ(fit.conditional.n_rows, fit.unconditional.n_rows);
    EXPECT_EQ(fit.conditional.n_rows, 40u * 90u) << "rows beyond 1 mm only";
    EXPECT_NEAR(fit.gain.value_MPa, fit.unconditional.mae_MPa - fit.conditional.mae_MPa, 1e-12);
    EXPECT_GT(fit.gain.interval.low, 0);
  }
  const std::string json = calibrate::calibration_json(c);
  EXPECT_EQ(calibrate::calibration_json(calibrate::parse_calibration(json, "calibration.json")),
            json);
}

TEST(Conditional, CountsExperimentsWithoutAStartOrWithoutARest) {
  const Dataset training = gained({});
  Dataset validation = gained({.seed = 2});
  for (std::size_t i = 0; i < 100; ++i)
    validation.columns[1].values[i] += 5; // E0 starts at 5 mm
  for (std::size_t i = 100; i < 200; ++i)
    validation.columns[1].values[i] *= 0.05; // E1 ends at 0.5 mm
  const calibrate::Conditional c = calibrate::calibrate(asked(training, validation, 1)).conditional;
  EXPECT_EQ(c.n_experiments, 40u);
  EXPECT_EQ(c.n_without_start, 1u);
  EXPECT_EQ(c.n_without_rest, 1u);
  EXPECT_EQ(c.laws.front().conditional.n_experiments, 39u);
}

std::string refusal(const calibrate::CalibrationInput& input) {
  return test::refusal([&] { calibrate::calibrate(input); });
}

TEST(Conditional, BeyondEveryExperimentIsRefusedWithTheLongestDistance) {
  const Dataset training = gained({}), validation = gained({.seed = 2});
  EXPECT_EQ(refusal(asked(training, validation, 10)),
            "job.toml:5:1: error: calibration.condition_on_mm = 10 leaves no row of the training "
            "data to be judged on: the longest sliding distance is 10 mm\n"
            "  hint: use a small part of the distance, for example 1\n"
            "job.toml:5:1: error: calibration.condition_on_mm = 10 leaves no row of the validation "
            "data to be judged on: the longest sliding distance is 10 mm\n"
            "  hint: use a small part of the distance, for example 1");
}

TEST(Conditional, WithoutSlidingDistanceIsRefusedWithWhatToMap) {
  Dataset training = gained({}), validation = gained({.seed = 2});
  std::erase_if(validation.columns, [](const data::Column& c) { return c.name == "s_mm"; });
  EXPECT_EQ(refusal(asked(training, validation, 1)),
            "job.toml:5:1: error: calibration.condition_on_mm needs s_mm, which the validation "
            "data do not have\n"
            "  hint: map s_mm in [data.columns], or time_s and v_rel_mm_s, from which it is "
            "integrated; or leave the key out");
}

} // namespace
} // namespace frictab::conditional_test
