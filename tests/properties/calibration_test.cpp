// Calibration: every law finds its own parameters again; errors and intervals by experiment.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/fit_law.h"
#include "calibrate/metrics.h"
#include "core/error.h"
#include "job/job.h"
#include "support/refusal.h"
#include "support/sample_data.h"
#include "support/threads.h"

namespace frictab::calibration_test {

using calibrate::Calibration;
using calibrate::calibration_json;
using calibrate::CalibrationInput;
using calibrate::Loss;
using calibrate::ModelFit;
using calibrate::predict;
using data::Dataset;
using models::find_law;
using models::Model;

namespace {

std::vector<std::string> fitted_laws() {
  std::vector<std::string> names;
  for (const models::Law& law : models::all_laws())
    if (law.calibrated == models::Calibrated::fit) names.push_back(law.name);
  return names;
}

ModelFit fit_of(const std::string& law, const Dataset& training, Loss loss = Loss::l2) {
  CalibrationInput input{training, training, {}, {}};
  input.models.use = {law};
  input.options.loss = loss;
  input.options.bootstrap = 0;
  return calibrate::calibrate(input).fits.front();
}

class EveryFittedLaw : public testing::TestWithParam<std::string> {};

TEST_P(EveryFittedLaw, RecoversItsParametersFromNoiseFreeDataWithEveryLoss) {
  const Model truth = test::plausible_model(*find_law(GetParam()));
  const Dataset data = test::sample_data(truth);
  for (const Loss loss : {Loss::l2, Loss::l1, Loss::huber}) {
    const ModelFit fit = fit_of(GetParam(), data, loss);
    for (std::size_t p = 0; p < truth.parameters.size(); ++p)
      EXPECT_NEAR(fit.model.parameters[p], truth.parameters[p],
                  1e-6 * std::abs(truth.parameters[p]))
          << truth.law->parameters[p].name << " loss " << static_cast<int>(loss) << ", "
          << fit.termination;
    EXPECT_LT(fit.training.mae_MPa, 1e-6);
  }
}

TEST_P(EveryFittedLaw, IsWithinFourStandardErrorsOfTheTruthOnNoisyData) {
  const Model truth = test::plausible_model(*find_law(GetParam()));
  test::SampleOptions options;
  options.experiments = 60;
  options.experiment_scatter = 0.03;
  options.noise_MPa = 3;
  const ModelFit fit = fit_of(GetParam(), test::sample_data(truth, options));
  for (std::size_t p = 0; p < truth.parameters.size(); ++p) {
    ASSERT_GT(fit.std_error[p], 0) << truth.law->parameters[p].name;
    EXPECT_LT(std::abs(fit.model.parameters[p] - truth.parameters[p]), 4 * fit.std_error[p])
        << truth.law->parameters[p].name;
  }
}

TEST_P(EveryFittedLaw, ModelFileReadsBackToTheSameBits) {
  const Model truth = test::plausible_model(*find_law(GetParam()));
  test::SampleOptions options;
  options.noise_MPa = 5;
  const Dataset data = test::sample_data(truth, options);
  const Calibration calibration = calibrate::calibrate({data, data, {.use = {GetParam()}}, {}});
  const ModelFit& fit = calibration.fits.front();
  const Model again = calibrate::parse_model(calibrate::model_json(fit, calibration), "model.json");
  EXPECT_EQ(again.parameters, fit.model.parameters);
  EXPECT_EQ(predict(again, data), predict(fit.model, data));
  const Calibration read =
      calibrate::parse_calibration(calibration_json(calibration), "calibration.json");
  EXPECT_EQ(calibration_json(read), calibration_json(calibration));
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFittedLaw, testing::ValuesIn(fitted_laws()));

TEST(SlowCalibration, OrowanFindsTheBestOfItsSeveralMinima) {
  // Brute force over a fine grid must not find anything better than the fit.
  const models::Law& law = *find_law("orowan");
  test::SampleOptions options;
  options.experiments = 12;
  options.experiment_scatter = 0.15;
  options.noise_MPa = 15;
  const Dataset data = test::sample_data(test::plausible_model(law), options);
  const ModelFit fit = fit_of("orowan", data);
  const auto cost = [&](double mu, double m) {
    Model trial = test::plausible_model(law);
    trial.parameters = {mu, m};
    const std::vector<double> tau = predict(trial, data);
    double sum = 0;
    for (std::size_t i = 0; i < tau.size(); ++i)
      sum += std::pow(data.values("tau_R_MPa")[i] - tau[i], 2);
    return sum;
  };
  const double found = cost(fit.model.parameters[0], fit.model.parameters[1]);
  for (int i = 0; i <= 150; ++i)
    for (int j = 0; j <= 100; ++j)
      ASSERT_LE(found, cost(0.03 + 0.001 * i, 0.1 + 0.009 * j) * (1 + 1e-12)) << i << " " << j;
}

// mu of the start, and of most of the bounds, is so large that tau_R is k in every row.
TEST(Calibration, StartsAtWhichTheShearLimitHoldsEverywhereAreNoMinimum) {
  const job::Job job = job::parse_job(
      "[data]\ntraining = \"a.csv\"\n[models.mine]\n"
      "formula = \"sigma_n_MPa*(mu0 + a*ln(v_rel_mm_s/0.001))\"\n[models.mine.parameters]\n"
      "mu0 = { range = [0, 2], start = 0.6 }\na = { range = [-0.2, 0.2], start = 0.01 }\n",
      "job.toml");
  models::Model truth = test::plausible_model(*models::find_law("coulomb"));
  truth.parameters = {0.05};
  const data::Dataset data = test::sample_data(truth);
  const calibrate::ModelFit fit =
      calibrate::fit_law(*job.models.laws.find("mine"), truth.conventions, data, {});
  const std::vector<double> tau = calibrate::predict(fit.model, data);
  for (std::size_t i = 0; i < tau.size(); ++i)
    ASSERT_NEAR(tau[i], data.values("tau_R_MPa")[i], 1e-3);
}

TEST(Calibration, MeansAreThePapersWay) {
  Dataset data = test::sample_data(test::plausible_model(*find_law("orowan")));
  double mu = 0, m = 0;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    mu += data.values("tau_R_MPa")[i] / data.values("sigma_n_MPa")[i];
    m += data.values("tau_R_MPa")[i] / (data.values("sigma_f_MPa")[i] / std::sqrt(3.0));
  }
  const ModelFit fit = fit_of("orowan_mean", data);
  EXPECT_NEAR(fit.model.parameters[0], mu / static_cast<double>(data.rows()), 1e-12);
  EXPECT_NEAR(fit.model.parameters[1], m / static_cast<double>(data.rows()), 1e-12);
}

TEST(Calibration, FixedConstantsAreNotTouched) {
  const Dataset data = test::sample_data(test::plausible_model(*find_law("coulomb")));
  EXPECT_EQ(fit_of("coulomb_0.04", data).model.parameters, std::vector<double>{0.04});
  EXPECT_EQ(fit_of("shear_0.12", data).model.parameters, std::vector<double>{0.12});
}

TEST(SlowCalibration, DoesNotDependOnTheNumberOfThreads) {
  test::SampleOptions options;
  options.experiments = 200; // enough rows for every thinned copy
  options.noise_MPa = 8;
  const Dataset data = test::sample_data(test::plausible_model(*find_law("wzl")), options);
  for (const Loss loss : {Loss::l2, Loss::l1, Loss::huber}) {
    CalibrationInput input{data, data, {}, {}};
    for (const models::Law& law : models::all_laws()) // the network has a test of its own
      if (law.calibrated != models::Calibrated::train) input.models.use.push_back(law.name);
    input.options.loss = loss;
    const auto text = [&] { return calibration_json(calibrate::calibrate(input)); };
    EXPECT_EQ(test::with_threads(1, text), test::with_threads(2, text)) << static_cast<int>(loss);
  }
}

TEST(Calibration, NamesTheParameterThatTheDataDoNotDetermineAndWhatWouldSettleIt) {
  Dataset data = test::sample_data(test::plausible_model(*find_law("log_coulomb")));
  test::column(data, "psi").values.assign(data.rows(), 1.0);
  const ModelFit fit = fit_of("log_coulomb", data);
  EXPECT_TRUE(std::isnan(fit.std_error[2]));
  EXPECT_EQ(fit.model.parameters[2], 0) << "left at its default";
  ASSERT_EQ(fit.remarks.size(), 2U);
  EXPECT_EQ(fit.remarks[0], "c2 has no influence on these data: experiments at several surface "
                            "expansions would settle it");
  EXPECT_EQ(fit.remarks[1], "psi is 1 in every row: experiments at other values would settle it");
}

TEST(Calibration, SaysWhichExperimentsWouldSettleShawsExponentAtItsBound) {
  const Model truth = test::plausible_model(*find_law("orowan")); // a kink: n beyond any bound
  test::SampleOptions options;
  options.noise_MPa = 2;
  const ModelFit fit = fit_of("shaw", test::sample_data(truth, options));
  EXPECT_EQ(fit.model.parameters[2], 20);
  EXPECT_TRUE(std::isnan(fit.std_error[2]));
  ASSERT_EQ(fit.remarks.size(), 1U);
  EXPECT_EQ(fit.remarks[0], "n is at its bound 20: experiments with sigma_N around m k/mu (u near "
                            "1) would settle it");
}

TEST(Calibration, WanheimBayReachesFullSticking) {
  Model truth = test::plausible_model(*find_law("wanheim_bay"));
  for (const double f : {0.9, 0.99, 0.9999, 1.0}) {
    truth.parameters = {f};
    const Dataset data = test::sample_data(truth);
    for (const Loss loss : {Loss::l2, Loss::l1}) {
      const ModelFit fit = fit_of("wanheim_bay", data, loss);
      EXPECT_NEAR(fit.model.parameters[0], f, 1e-6) << fit.termination;
      EXPECT_LT(fit.training.mae_MPa, 1e-3);
    }
  }
}

// tau of f = 0.5 from slip lines, which know p/k alone.
std::vector<double> slip_line_tau(const Dataset& data, double k_over_sigma_f) {
  const double f = 0.5, pi = std::acos(-1.0);
  const double mu = f / (1 + pi / 2 + std::acos(f) + std::sqrt(1 - f * f));
  const double at_limit = 1 - std::sqrt(1 - f), left = f - at_limit;
  std::vector<double> tau;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const double k = k_over_sigma_f * data.values("sigma_f_MPa")[i];
    const double line = mu * data.values("sigma_n_MPa")[i] / k;
    const double curve = at_limit + left * (1 - std::exp((at_limit - line) / left));
    tau.push_back(k * (line <= at_limit ? line : curve));
  }
  return tau;
}

TEST(Calibration, WanheimBayFindsItsFactorWhateverKTheJobMeans) {
  for (const auto& [yield, k_over_sigma_f] :
       {std::pair{models::ShearYield::mises, 1 / std::sqrt(3.0)},
        std::pair{models::ShearYield::tresca, 0.5},
        std::pair{models::ShearYield::flow_stress, 1.0}}) {
    Dataset data = test::sample_data(test::plausible_model(*find_law("wanheim_bay")));
    test::column(data, "tau_R_MPa").values = slip_line_tau(data, k_over_sigma_f);
    CalibrationInput input{data, data, {}, {}};
    input.models.use = {"wanheim_bay"};
    input.models.shear_yield = yield;
    const ModelFit fit = calibrate::calibrate(input).fits.front();
    EXPECT_NEAR(fit.model.parameters[0], 0.5, 1e-7) << models::shear_yield_name(yield);
    EXPECT_LT(fit.training.mae_MPa, 1e-6);
  }
}

// Files of 0.1.0, whose parameters meant something else.
TEST(Calibration, ParametersOfAnotherFormulaAreNotTakenForThisOne) {
  const Dataset data = test::sample_data(test::plausible_model(*find_law("wzl")));
  const auto file_of = [&](const char* law, models::ShearYield yield) {
    CalibrationInput input{data, data, {}, {}};
    input.models.use = {law};
    input.models.shear_yield = yield;
    input.options.bootstrap = 0;
    const Calibration calibration = calibrate::calibrate(input);
    return calibrate::model_json(calibration.fits.front(), calibration);
  };
  const auto old_file = [](std::string text) {
    const std::string revision = ",\n  \"revision\": 1";
    const std::size_t at = text.find(revision);
    return at == text.npos ? text : text.erase(at, revision.size());
  };
  const std::string mises = file_of("wanheim_bay", models::ShearYield::mises);
  EXPECT_EQ(mises.find("revision"), mises.npos); // as it was
  EXPECT_NO_THROW(calibrate::parse_model(mises, "m.json"));
  for (const std::string& now : {file_of("wzl", models::ShearYield::mises),
                                 file_of("wanheim_bay", models::ShearYield::tresca)}) {
    EXPECT_NO_THROW(calibrate::parse_model(now, "m.json"));
    ASSERT_NE(old_file(now), now);
    EXPECT_THAT(
        test::refusal([&] { calibrate::parse_model(old_file(now), "m.json"); }),
        testing::AllOf(testing::StartsWith("m.json: error: was made with another formula of w"),
                       testing::HasSubstr("hint: calibrate again with this version")));
  }
}

TEST(Calibration, TheWeightedMedianIsTheLeastMeanErrorOfOneParameter) {
  test::SampleOptions options;
  options.experiments = 5;
  options.rows = 21;
  options.noise_MPa = 20;
  for (const char* name : {"coulomb", "shear", "levanov"}) {
    const Model truth = test::plausible_model(*find_law(name));
    const Dataset data = test::sample_data(truth, options);
    const ModelFit fit = fit_of(name, data, Loss::l1);
    Model trial = truth;
    for (int i = -1000; i <= 1000; ++i) {
      trial.parameters = {fit.model.parameters[0] * (1 + 1e-4 * i)};
      const std::vector<double> tau = predict(trial, data);
      double sum = 0;
      for (std::size_t r = 0; r < tau.size(); ++r)
        sum += std::abs(data.values("tau_R_MPa")[r] - tau[r]);
      ASSERT_GE(sum / static_cast<double>(tau.size()), fit.training.mae_MPa * (1 - 1e-14)) << name;
    }
  }
}

TEST(Calibration, NamesAParameterThatOneExperimentAloneDetermines) {
  test::SampleOptions options;
  options.noise_MPa = 3;
  Dataset data = test::sample_data(test::plausible_model(*find_law("log_coulomb")), options);
  for (data::Column& column : data.columns) // psi differs from 1 in the first experiment only
    if (column.name == "psi")
      std::fill(column.values.begin() + static_cast<long>(data.first_row[1]), column.values.end(),
                1.0);
  const ModelFit fit = fit_of("log_coulomb", data);
  EXPECT_TRUE(std::isnan(fit.std_error[2]));
  EXPECT_GT(fit.std_error[0], 0);
  ASSERT_EQ(fit.remarks.size(), 1U);
  EXPECT_EQ(fit.remarks[0], "c2 is determined by a single experiment: no standard error");
}

TEST(Calibration, LeavesOutLawsWhoseColumnsAreMissingAndSaysSo) {
  Dataset data = test::sample_data(test::plausible_model(*find_law("coulomb")));
  std::erase_if(data.columns, [](const data::Column& c) { return c.name == "sigma_f_MPa"; });
  const Calibration calibration = calibrate::calibrate({data, data, {}, {}});
  EXPECT_EQ(calibration.fits.size(), 9U);
  EXPECT_EQ(calibration.left_out.front().text(), "shear_0.12: needs sigma_f_MPa");
  CalibrationInput asked{data, data, {}, {}};
  asked.models.use = {"coulomb", "shaw"};
  asked.models.place = {"job.toml", 4, 1};
  EXPECT_EQ(test::refusal([&] { calibrate::calibrate(asked); }),
            "job.toml:4:1: error: law shaw: needs sigma_f_MPa, which the data do not have\n"
            "  hint: map the columns in [data.columns], give a constant in [data.constants], or "
            "leave the law out of models.use");
}

TEST(Calibration, RanksByErrorOnExperimentsNotTrainedOn) {
  test::SampleOptions options;
  options.noise_MPa = 4;
  const Model truth = test::plausible_model(*find_law("wzl"));
  const Dataset training = test::sample_data(truth, options);
  options.seed = 2;
  const Dataset validation = test::sample_data(truth, options);
  const Calibration calibration = calibrate::calibrate({training, validation, {}, {}});
  EXPECT_EQ(calibration.fits.size(), models::all_laws().size());
  EXPECT_EQ(calibration.fits.front().model.law->name, "wzl");
  for (std::size_t i = 1; i < calibration.fits.size(); ++i)
    EXPECT_LE(calibration.fits[i - 1].validation.mae_MPa, calibration.fits[i].validation.mae_MPa);
}

TEST(Metrics, AreTheErrorsOfAHandWorkedCase) {
  const std::vector<double> measured{10, 12, 8, 20}, predicted{9, 14, 8, 17};
  const std::vector<std::size_t> first_row{0, 2, 4};
  const calibrate::Metrics m = calibrate::metrics(measured, predicted, first_row, 500, 1);
  EXPECT_DOUBLE_EQ(m.mae_MPa, 1.5);
  EXPECT_DOUBLE_EQ(m.rmse_MPa, std::sqrt(14.0 / 4));
  EXPECT_DOUBLE_EQ(m.bias_MPa, 0.5);
  EXPECT_EQ(m.n_rows, 4U);
  EXPECT_EQ(m.n_experiments, 2U);
  // Two experiments with biases -0.5 and 1.5: standard error 1, one degree of freedom.
  EXPECT_NEAR(m.bias_interval.low, 0.5 - 12.706, 1e-3);
  EXPECT_NEAR(m.bias_interval.high, 0.5 + 12.706, 1e-3);
}

TEST(Metrics, IntervalTreatsTheExperimentAsTheUnit) {
  // 20 experiments of 100 equal residuals: rows must not make the interval 10 times too narrow.
  std::vector<double> measured, predicted(2000, 0.0);
  std::vector<std::size_t> first_row{0};
  for (int e = 0; e < 20; ++e) {
    measured.insert(measured.end(), 100, e % 2 ? 1.0 : -1.0);
    first_row.push_back(measured.size());
  }
  const calibrate::Metrics m = calibrate::metrics(measured, predicted, first_row, 2000, 1);
  EXPECT_NEAR(m.bias_interval.high, 1.96 / std::sqrt(20.0), 0.08);
}

TEST(ExperimentErrors, AddUpToThoseOfTheRankingAndNameTheOutlier) {
  test::SampleOptions noisy;
  noisy.noise_MPa = 2;
  const Dataset training = test::sample_data(test::plausible_model(*find_law("coulomb")), noisy);
  Dataset validation = training;
  for (std::string& name : validation.experiments)
    name = "held out, " + name;
  // The last test slides with 1.5 times the stress.
  for (data::Column& column : validation.columns)
    for (std::size_t i = *(validation.first_row.end() - 2); i < column.values.size(); ++i)
      if (column.name == "tau_R_MPa") column.values[i] *= 1.5;
  CalibrationInput input{training, validation, {}, {}};
  input.models.use = {"coulomb", "coulomb_0.04"};
  const Calibration calibration = calibrate::calibrate(input);
  std::istringstream lines(
      calibrate::errors_csv(calibrate::errors_by_experiment(calibration, training, validation)));
  std::string line, furthest;
  std::getline(lines, line);
  EXPECT_EQ(line, "law,experiment,held_out,n,mae_MPa,rmse_MPa,bias_MPa,gain");
  double sum = 0, bias = 0, largest = 0, gain = 0;
  std::size_t count = 0;
  while (std::getline(lines, line)) {
    ++count;
    const std::size_t at = line.find(",1,"); // held out
    if (!line.starts_with("coulomb,\"held out") || at == line.npos) continue;
    double n = 0, mae = 0, rmse = 0, mean = 0, factor = 0;
    ASSERT_EQ(
        std::sscanf(line.c_str() + at, ",1,%lf,%lf,%lf,%lf,%lf", &n, &mae, &rmse, &mean, &factor),
        5)
        << line;
    EXPECT_LE(mae, rmse);
    sum += n * mae;
    bias += n * mean;
    if (mae <= largest) continue;
    largest = mae;
    furthest = line;
    gain = factor;
  }
  EXPECT_EQ(count, 4 * training.experiments.size()) << "two laws, two sets";
  const auto fit = std::ranges::find_if(
      calibration.fits, [](const ModelFit& f) { return f.model.law->name == "coulomb"; });
  const auto rows = static_cast<double>(validation.rows());
  EXPECT_NEAR(sum / rows, fit->validation.mae_MPa, 1e-4);
  EXPECT_NEAR(bias / rows, fit->validation.bias_MPa, 1e-4);
  EXPECT_THAT(furthest, testing::HasSubstr(validation.experiments.back()));
  EXPECT_NEAR(gain, 1.5, 0.05);
}

} // namespace
} // namespace frictab::calibration_test
