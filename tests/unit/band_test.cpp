// The band in which experiments lie around a law.
#include <cmath>

#include <gtest/gtest.h>

#include "calibrate/band.h"
#include "calibrate/calibration_file.h"
#include "core/random.h"
#include "support/refusal.h"
#include "support/sample_data.h"

namespace frictab::band_test {

using calibrate::at_quantile;
using models::Model;

namespace {

std::vector<double> lognormal(std::size_t count, double sd, Random& random) {
  std::vector<double> gains;
  for (std::size_t i = 0; i < count; ++i)
    gains.push_back(std::exp(sd * random.normal()));
  return gains;
}

TEST(Band, AShareOfNewExperimentsLiesBelowItsQuantile) {
  Random random(7);
  for (const double quantile : {0.05, 0.3, 0.95}) {
    constexpr int draws = 4000;
    double below = 0; // of the distribution that the factors are drawn from
    for (int draw = 0; draw < draws; ++draw) {
      const double gain = *calibrate::gain_at_quantile(
          calibrate::gains_of_new_experiments(lognormal(39, 0.1, random), 0), quantile);
      below += 0.5 * std::erfc(-std::log(gain) / 0.1 / std::sqrt(2.0)) / draws;
    }
    EXPECT_NEAR(below, quantile, 0.004) << "3.5 standard deviations of the mean of the draws";
  }
}

TEST(Band, FactorsOfFittedExperimentsAreSpreadToThoseOfNewOnes) {
  // log factors minus their mean: one parameter fitted to 10 experiments.
  Random random(11);
  double fitted = 0, widened = 0;
  for (int draw = 0; draw < 3000; ++draw) {
    std::vector<double> gains = lognormal(10, 0.1, random);
    double mean = 0;
    for (const double g : gains)
      mean += std::log(g) / 10;
    for (double& g : gains)
      g = std::exp(std::log(g) - mean);
    for (const double g : gains)
      fitted += std::pow(std::log(g), 2);
    for (const double g : calibrate::gains_of_new_experiments(gains, 1))
      widened += std::pow(std::log(g), 2);
  }
  EXPECT_NEAR(widened / fitted, 10.0 / 9.0, 0.01);
}

TEST(Band, SaysWhichQuantilesSoManyExperimentsGive) {
  Model model = test::plausible_model(*models::find_law("coulomb"));
  model.experiment_gains = {0.8, 0.9, 1.0, 1.1};
  EXPECT_EQ(at_quantile(model, 0.2, {}).gain, 0.8);
  EXPECT_EQ(at_quantile(model, 0.8, {}).gain, 1.1);
  EXPECT_EQ(at_quantile(model, 0.5, {}).gain, 1) << "the law itself";
  EXPECT_EQ(test::refusal([&] {
              at_quantile(model, 0.05, {"job.toml", 7, 1});
            }),
            "job.toml:7:1: error: 4 experiments do not give the quantile 0.05 of 'coulomb'\n"
            "  hint: between 0.2 and 0.8, or more experiments");
}

TEST(Band, MultipliesTheLawBelowTheShearLimit) {
  const Model law = test::plausible_model(*models::find_law("log_coulomb"));
  data::Dataset data = test::sample_data(law);
  const std::vector<double> tau = calibrate::predict(law, data);
  Model end = law;
  end.quantile = 0.95;
  end.gain = 3;
  const std::vector<double> high = calibrate::predict(end, data);
  std::size_t limited = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const double k = law.conventions.k_over_sigma_f * data.values("sigma_f_MPa")[i];
    EXPECT_NEAR(high[i], std::min(3 * tau[i], k), 1e-12 * k);
    limited += high[i] == k;
  }
  EXPECT_GT(limited, 0U);
  EXPECT_EQ(end.name(), "log_coulomb_q95");
}

TEST(Band, OfACampaignCoversItsExperiments) {
  test::SampleOptions options;
  options.experiments = 80;
  options.experiment_scatter = 0.1;
  const Model truth = test::plausible_model(*models::find_law("coulomb"));
  const data::Dataset training = test::sample_data(truth, options);
  options.seed = 2;
  options.experiments = 400;
  const data::Dataset validation = test::sample_data(truth, options);
  calibrate::CalibrationInput input{training, validation, {}, {}};
  input.models.use = {"coulomb"};
  input.models.shear_limit = false;
  const calibrate::BandCheck band = calibrate::calibrate(input).fits.front().band;
  EXPECT_NEAR(*band.low, std::exp(-1.645 * 0.1), 0.04);
  EXPECT_NEAR(*band.high, std::exp(1.645 * 0.1), 0.06);
  EXPECT_EQ(band.experiments, 400U);
  EXPECT_NEAR(static_cast<double>(band.inside), 360, 24);
}

} // namespace
} // namespace frictab::band_test
