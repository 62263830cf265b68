// Rate-and-state friction: the state's differential equations, its name, and the slip distance that
// calibration finds.
#include <cmath>
#include <iostream>
#include <numeric>

#include <gmock/gmock.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "calibrate/calibration_file.h"
#include "calibrate/fit_law.h"
#include "calibrate/slip_distance.h"
#include "core/error.h"
#include "core/random.h"
#include "data/derived.h"
#include "job/job.h"
#include "job/literature.h"
#include "support/refusal.h"
#include "support/threads.h"

namespace frictab::rate_and_state_test {
namespace {

using data::Dataset;
using testing::HasSubstr;

Dataset strokes(const std::vector<std::vector<double>>& speeds, double step_s) {
  Dataset data;
  data.columns = {{"sigma_n_MPa", "MPa", {}, {}},
                  {"v_rel_mm_s", "mm/s", {}, {}},
                  {"time_s", "s", {}, {}},
                  {"tau_R_MPa", "MPa", {}, {}}};
  for (std::size_t e = 0; e < speeds.size(); ++e) {
    for (std::size_t i = 0; i < speeds[e].size(); ++i) {
      data.columns[0].values.push_back(20 + 5 * static_cast<double>(e % 3));
      data.columns[1].values.push_back(speeds[e][i]);
      data.columns[2].values.push_back(100 + step_s * static_cast<double>(i));
      data.columns[3].values.push_back(0);
    }
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.columns[0].values.size());
  }
  data.sources = {"strokes"};
  return data;
}

std::vector<double> state(const std::string& name, const Dataset& data) {
  return data::derive(*data::find_derived(name), data, {});
}

TEST(RateAndState, StateStaysAtOneSpeedAndStartsAnewInEveryExperiment) {
  const Dataset data = strokes({std::vector<double>(50, 0.01), std::vector<double>(50, 0.04)}, 0.5);
  for (const char* name : {"aging_state_over_0p02mm", "slip_state_over_0p02mm"}) {
    const std::vector<double> theta = state(name, data);
    for (std::size_t i = 0; i < 50; ++i) {
      EXPECT_NEAR(theta[i], 2, 1e-12) << name;
      EXPECT_NEAR(theta[50 + i], 0.5, 1e-12) << name;
    }
  }
}

TEST(RateAndState, StateStartsWithTheFirstRowThatSlides) {
  std::vector<double> rested(20, 0.0), v(12, 0.02);
  v[5] = 0;
  std::ranges::copy(v, rested.begin() + 8);
  for (const char* name : {"aging_state_over_0p02mm", "slip_state_over_0p02mm"}) {
    const std::vector<double> theta = state(name, strokes({rested, v}, 2));
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_DOUBLE_EQ(theta[i], 0.02 / data::slowest_speed) << name;
    for (std::size_t i = 0; i < v.size(); ++i)
      EXPECT_EQ(theta[8 + i], theta[20 + i]) << name << " " << i;
  }
  rested[3] = std::nan("");
  EXPECT_TRUE(std::isnan(state("aging_state_over_0p02mm", strokes({rested}, 2))[12]));
}

// Classical fourth-order steps of d theta/dt on a fine clock, with the speed linear between rows.
std::vector<double> integrated(bool ages, double D, const std::vector<double>& v, double step_s) {
  constexpr int fine = 200;
  const auto rate = [&](double theta, double speed) {
    const double x = speed * theta / D;
    return ages ? 1 - x : -x * std::log(x);
  };
  std::vector<double> out{D / v[0]};
  double theta = out[0];
  const double h = step_s / fine;
  for (std::size_t i = 1; i < v.size(); ++i) {
    for (int k = 0; k < fine; ++k) {
      const auto at = [&](double part) { return v[i - 1] + (v[i] - v[i - 1]) * (k + part) / fine; };
      const double a = rate(theta, at(0)), b = rate(theta + h / 2 * a, at(0.5)),
                   c = rate(theta + h / 2 * b, at(0.5)), d = rate(theta + h * c, at(1));
      theta += h / 6 * (a + 2 * b + 2 * c + d);
    }
    out.push_back(theta);
  }
  return out;
}

TEST(RateAndState, StateConvergesToItsDifferentialEquationWithTheSquareOfTheStep) {
  for (const bool ages : {true, false}) {
    std::vector<double> errors;
    for (const int rows : {81, 161, 321}) {
      const double step = 40.0 / (rows - 1);
      std::vector<double> v;
      for (int i = 0; i < rows; ++i)
        v.push_back(0.01 * std::exp(1.5 * std::sin(0.3 * step * i)));
      const auto found =
          state(ages ? "aging_state_over_0p05mm" : "slip_state_over_0p05mm", strokes({v}, step));
      const auto expected = integrated(ages, 0.05, v, step);
      double error = 0;
      for (std::size_t i = 0; i < v.size(); ++i)
        error = std::max(error, std::abs(found[i] / expected[i] - 1));
      errors.push_back(error);
    }
    EXPECT_LT(errors[2], 5e-4);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.6) << ages;
    EXPECT_NEAR(errors[1] / errors[2], 4, 0.6) << ages;
  }
}

TEST(RateAndState, AtRestTheAgingStateGrowsWithTimeAndTheSlipStateDoesNot) {
  std::vector<double> v(30, 0.02);
  std::fill(v.begin() + 10, v.begin() + 20, 0.0);
  const Dataset data = strokes({v}, 2);
  const auto aging = state("aging_state_over_0p02mm", data),
             slip = state("slip_state_over_0p02mm", data);
  EXPECT_NEAR(aging[19] - aging[11], 16, 1e-9);
  EXPECT_NEAR(slip[19], slip[10], 1e-6 * slip[10]);
}

TEST(RateAndState, DistanceStandsInTheNameToFourDigits) {
  using data::Continuation;
  for (const double D : {0.0125, 12.0, 1.5, 3.14159, 1e-5, 2.5e6}) {
    const std::string name = data::slip_state_name(Continuation::slipping, D);
    const auto read = data::slip_state(name);
    ASSERT_TRUE(read) << name;
    EXPECT_EQ(read->rule, Continuation::slipping);
    EXPECT_NEAR(read->distance_mm, D, 5e-4 * D) << name;
    EXPECT_EQ(data::slip_state_name(Continuation::slipping, read->distance_mm), name);
  }
  EXPECT_EQ(data::slip_state_name(Continuation::aging, 0.0125), "aging_state_over_0p0125mm");
  EXPECT_EQ(data::slip_state("aging_state_over_D_c")->parameter, "D_c");
  for (const char* none : {"aging_state_over_", "aging_state_over_5", "aging_state_over_0mm",
                           "slip_state_over_1p2p3mm", "state_over_1mm", "slip_state_over_5mmm"})
    EXPECT_FALSE(data::slip_state(none)) << none;
}

// Steps of speed over three decades, up and down in another order in each test.
Dataset campaign(const models::Model& truth, double scatter, double noise, std::uint64_t seed = 5) {
  std::vector<std::vector<double>> speeds;
  Random random(seed);
  for (int e = 0; e < 9; ++e) {
    std::vector<double> v;
    for (int step = 0; step < 8; ++step)
      v.insert(v.end(), 60, 0.001 * std::pow(10, random.uniform(0, 2.5)));
    speeds.push_back(v);
  }
  Dataset data = strokes(speeds, 0.25);
  const std::vector<double> tau = calibrate::predict(truth, data);
  auto& measured = data.columns[3].values;
  for (std::size_t e = 0; e < speeds.size(); ++e) {
    const double gain = std::exp(scatter * random.normal());
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      measured[i] = tau[i] * gain + noise * random.normal();
  }
  return data;
}

models::Model truth_of(const std::string& law, double D) {
  models::Model truth;
  const models::Law& open = *job::literature().find(law);
  truth.law = models::unregistered_law(
      calibrate::at_slip_distance(open, *calibrate::slip_distance(open, {}), D));
  truth.conventions.shear_limit = false;
  truth.parameters = {0.55, 0.012, 0.018};
  return truth;
}

calibrate::Calibration calibrated(const std::string& law, const Dataset& data) {
  calibrate::CalibrationInput input{data, data, {}, {}};
  input.models.laws = job::literature();
  input.models.use = {law};
  input.models.shear_limit = false;
  input.options.bootstrap = 0;
  return calibrate::calibrate(input);
}

double distance_in(const models::Model& model) {
  for (const std::string& input : models::inputs(*model.law, model.conventions))
    if (const auto found = data::slip_state(input)) return found->distance_mm;
  return 0;
}

// "D_c = 0.0432 mm ± 0.0011 (standard error by experiment), ...".
double distance_error_in(const calibrate::ModelFit& fit) {
  for (const std::string& remark : fit.remarks)
    if (const auto at = remark.find(" mm \u00B1 "); at != remark.npos)
      return std::stod(remark.substr(at + std::string(" mm \u00B1 ").size()));
  return std::nan("");
}

TEST(RateAndState, DistanceAndParametersAreFoundAgain) {
  for (const std::string law : {"rate_and_state_aging", "rate_and_state_slip"}) {
    const models::Model truth = truth_of(law, 0.0432);
    const auto exact = calibrated(law, campaign(truth, 0, 0)).fits.front();
    EXPECT_NEAR(distance_in(exact.model), 0.0432, 2e-3 * 0.0432) << law;
    for (std::size_t p = 0; p < 3; ++p)
      EXPECT_NEAR(exact.model.parameters[p], truth.parameters[p], 2e-3 * truth.parameters[p])
          << law;
    const auto noisy = calibrated(law, campaign(truth, 0.02, 0.02)).fits.front();
    EXPECT_NEAR(distance_in(noisy.model), 0.0432, 0.2 * 0.0432) << law;
    for (std::size_t p = 0; p < 3; ++p)
      EXPECT_LT(std::abs(noisy.model.parameters[p] - truth.parameters[p]), 4 * noisy.std_error[p])
          << law << " " << p;
    EXPECT_THAT(noisy.remarks, testing::Contains(HasSubstr("D_c = 0.0")));
    EXPECT_LT(std::abs(distance_in(noisy.model) - 0.0432), 4 * distance_error_in(noisy)) << law;
  }
}

// Searches run side by side: none may die of what another has set in the library. (A flat loss is
// an error to its minimiser.)
TEST(RateAndState, ErrorsOfTheLibraryEndNoSearch) {
  gsl_function flat{[](double, void*) { return 1.0; }, nullptr};
  gsl_min_fminimizer* const brent = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
  EXPECT_EQ(gsl_min_fminimizer_set(brent, &flat, 1, 0, 2), GSL_EINVAL);
  gsl_min_fminimizer_free(brent);
}

TEST(RateAndState, CalibrationIsTheSameForAnyNumberOfThreadsAndItsFileReadsBack) {
  const Dataset data = campaign(truth_of("rate_and_state_slip", 0.03), 0.02, 0.05);
  const auto fitted = [&] { return calibrated("rate_and_state_slip", data); };
  const auto one = test::with_threads(1, fitted), three = test::with_threads(3, fitted);
  EXPECT_EQ(calibrate::model_json(one.fits.front(), one),
            calibrate::model_json(three.fits.front(), three));
  const models::Model again =
      calibrate::parse_model(calibrate::model_json(one.fits.front(), one), "model.json");
  EXPECT_EQ(calibrate::predict(again, data), calibrate::predict(one.fits.front().model, data));
}

TEST(SlowRateAndState, StandardErrorOfTheDistanceIsItsScatterBetweenCampaigns) {
  for (const std::string law : {"rate_and_state_aging", "rate_and_state_slip"}) {
    const models::Model truth = truth_of(law, 0.0432);
    std::vector<double> errors, found;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
      const Dataset data = campaign(truth, 0.02, 0.1, seed);
      const auto fit =
          calibrate::fit_law(*job::literature().find(law), truth.conventions, data, {});
      found.push_back(distance_in(fit.model));
      errors.push_back(distance_error_in(fit));
    }
    const auto mean = [](const std::vector<double>& x) {
      return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
    };
    double squares = 0;
    for (const double x : found)
      squares += (x - mean(found)) * (x - mean(found));
    const double scatter = std::sqrt(squares / static_cast<double>(found.size() - 1));
    std::cout << law << ": mean " << mean(found) << " mm, scatter " << scatter
              << " mm, standard error in the mean " << mean(errors) << " mm\n";
    EXPECT_NEAR(mean(found), 0.0432, 3 * scatter / std::sqrt(24.0));
    EXPECT_GT(mean(errors), 0.6 * scatter) << law;
    EXPECT_LT(mean(errors), 1.6 * scatter) << law;
  }
}

TEST(RateAndState, DistanceOfOneExperimentHasNoStandardError) {
  const models::Model truth = truth_of("rate_and_state_aging", 0.0432);
  const std::size_t one[] = {0};
  const auto fit = calibrate::fit_law(*job::literature().find("rate_and_state_aging"),
                                      truth.conventions, campaign(truth, 0, 0.02).subset(one), {});
  EXPECT_THAT(fit.remarks, testing::Contains(HasSubstr("; it has no standard error")));
  EXPECT_TRUE(std::isnan(distance_error_in(fit)));
}

std::string faults_of(const std::string& law) {
  return test::refusal(
      [&] { job::parse_job("[data]\ntraining = \"a.csv\"\n[models.mine]\n" + law, "job.toml"); });
}

TEST(RateAndState, ALawOfTheJobHasADistanceThatIsAParameterAConstantOrANumber) {
  const std::string formula =
      "formula = \"mu*sigma_n_MPa*(1 + b*ln(aging_state_over_D/1))\"\n[models.mine.parameters]\n"
      "mu = { range = [0, 1] }\nb = { range = [-1, 1] }\n";
  EXPECT_EQ(faults_of(formula + "D = { range = [0.01, 1] }\n"), "accepted");
  EXPECT_EQ(faults_of(formula + "D = 0.02\n"), "accepted");
  EXPECT_THAT(faults_of(formula), HasSubstr("job.toml:4:37: error: law mine has no parameter 'D' "
                                            "for aging_state_over_D"));
  EXPECT_THAT(faults_of(formula + "D = { range = [0, 1] }\n"),
              HasSubstr("the distance D of law mine may be 0"));
}

} // namespace
} // namespace frictab::rate_and_state_test
