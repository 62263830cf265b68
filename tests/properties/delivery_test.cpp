// Laws that are delivered from all experiments: fitted to both parts, judged as before, with an
// expected error of their own.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "calibrate/calibration_file.h"
#include "calibrate/refit.h"
#include "core/error.h"
#include "core/parallel.h"
#include "data/append.h"
#include "support/refusal.h"
#include "support/sample_data.h"

namespace frictab::delivery_test {

using calibrate::Calibration;
using calibrate::CalibrationInput;
using calibrate::Deliver;
using calibrate::delivery_sentence;
using calibrate::JudgedBy;
using calibrate::ModelFit;
using data::Dataset;

namespace {

Dataset campaign(std::size_t experiments, std::uint64_t seed) {
  test::SampleOptions options;
  options.experiments = experiments;
  options.rows = 20 + 5 * seed; // so that tests of both parts weigh differently
  options.experiment_scatter = 0.1;
  options.noise_MPa = 4;
  options.seed = seed;
  return test::sample_data(test::plausible_model(*models::find_law("exp_coulomb")), options);
}

// Column by column, as the test understands it.
Dataset end_to_end(Dataset first, const Dataset& second) {
  for (data::Column& column : first.columns) {
    const auto more = second.values(column.name);
    column.values.insert(column.values.end(), more.begin(), more.end());
  }
  const std::size_t rows = first.first_row.back();
  for (std::size_t e = 0; e < second.experiments.size(); ++e) {
    first.experiments.push_back("second part, " + second.experiments[e]);
    first.first_row.push_back(rows + second.first_row[e + 1]);
  }
  return first;
}

Calibration calibrated(const Dataset& training, const Dataset& validation, Deliver deliver,
                       std::vector<std::string> laws,
                       JudgedBy judged_by = JudgedBy::validation_files) {
  CalibrationInput input{training, validation, {}, {}, judged_by};
  input.models.use = std::move(laws);
  input.options.deliver = deliver;
  input.options.bootstrap = 100;
  return calibrate::calibrate(input);
}

const std::vector<std::string> some_laws = {"coulomb_0.08", "coulomb_mean", "orowan",
                                            "exp_coulomb"};

TEST(Deliver, AllGivesTheFitToBothPartsTogether) {
  const Dataset training = campaign(12, 1), validation = campaign(6, 2);
  const Calibration c = calibrated(training, validation, Deliver::all, some_laws);
  const Dataset both = end_to_end(training, validation);
  const Calibration of_both = calibrated(both, both, Deliver::training, some_laws);
  for (const ModelFit& fit : c.fits) {
    ASSERT_TRUE(fit.on_all);
    for (const ModelFit& other : of_both.fits) {
      if (other.model.law->name != fit.model.law->name) continue;
      EXPECT_EQ(fit.on_all->model.parameters, other.model.parameters) << fit.model.law->name;
      EXPECT_EQ(fit.on_all->std_error, other.std_error);
      EXPECT_EQ(fit.on_all->model.experiment_gains, other.model.experiment_gains);
      EXPECT_EQ(fit.on_all->data_range, other.data_range);
      EXPECT_EQ(fit.on_all->training.mae_MPa, other.training.mae_MPa);
    }
  }
}

TEST(Deliver, AllLeavesEverythingJudgedAsItIs) {
  const Dataset training = campaign(12, 1), validation = campaign(6, 2);
  Calibration all = calibrated(training, validation, Deliver::all, some_laws);
  const Calibration usual = calibrated(training, validation, Deliver::training, some_laws);
  for (std::size_t i = 0; i < all.fits.size(); ++i) {
    EXPECT_NE(calibrate::model_json(all.fits[i], all), calibrate::model_json(usual.fits[i], usual));
    EXPECT_EQ(&usual.fits[i].delivered(), &usual.fits[i]);
    all.fits[i].on_all = nullptr;
    all.fits[i].seconds = usual.fits[i].seconds;
  }
  all.deliver = Deliver::training;
  all.delivery_folds = 0;
  EXPECT_EQ(calibrate::calibration_json(all), calibrate::calibration_json(usual));
}

// Least squares of tau = mu sigma_N without experiment `left_out`, by hand.
double mu_without(const Dataset& data, std::size_t left_out) {
  const auto tau = data.values("tau_R_MPa"), pressure = data.values("sigma_n_MPa");
  double up = 0, down = 0;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    if (i >= data.first_row[left_out] && i < data.first_row[left_out + 1]) continue;
    up += tau[i] * pressure[i];
    down += pressure[i] * pressure[i];
  }
  return up / down;
}

TEST(Deliver, TheErrorToExpectIsThatOfExperimentsLeftOutInTurn) {
  const Dataset training = campaign(12, 1), validation = campaign(6, 2);
  CalibrationInput input{training, validation, {}, {}};
  input.models.use = {"coulomb"};
  input.models.shear_limit = false; // then the fit is a line through the origin
  input.options.deliver = Deliver::all;
  const Calibration c = calibrate::calibrate(input);
  const Dataset both = end_to_end(training, validation);
  const auto tau = both.values("tau_R_MPa"), pressure = both.values("sigma_n_MPa");
  double absolute = 0, square = 0, sum = 0;
  for (std::size_t e = 0; e < both.experiments.size(); ++e) {
    const double mu = mu_without(both, e);
    for (std::size_t i = both.first_row[e]; i < both.first_row[e + 1]; ++i) {
      const double residual = tau[i] - mu * pressure[i];
      absolute += std::abs(residual);
      square += residual * residual;
      sum += residual;
    }
  }
  const double rows = static_cast<double>(both.rows());
  const calibrate::Metrics& expected = c.fits.front().on_all->validation;
  EXPECT_NEAR(expected.mae_MPa, absolute / rows, 1e-6);
  EXPECT_NEAR(expected.rmse_MPa, std::sqrt(square / rows), 1e-6);
  EXPECT_NEAR(expected.bias_MPa, sum / rows, 1e-6);
  EXPECT_EQ(expected.n_experiments, 18U);
  EXPECT_EQ(c.delivery_folds, 18U);
}

TEST(Deliver, FromThirtyExperimentsOnThereAreTenFolds) {
  const Calibration c =
      calibrated(campaign(24, 1), campaign(6, 2), Deliver::all, {"coulomb", "exp_coulomb"});
  EXPECT_EQ(c.delivery_folds, 10U);
  EXPECT_EQ(c.fits.front().on_all->validation.n_experiments, 30U);
}

TEST(Deliver, SaysWhatIsDeliveredAndWhatToExpectOfIt) {
  const Dataset training = campaign(24, 1), validation = campaign(6, 2);
  EXPECT_EQ(
      delivery_sentence(calibrated(training, validation, Deliver::training, {"orowan"}), 2),
      "delivered: fitted to the 24 experiments of the training; calibration.deliver = \"all\" fits "
      "again to all");
  Calibration c = calibrated(training, validation, Deliver::all, {"coulomb", "exp_coulomb"});
  const calibrate::Metrics& m = c.fits.front().on_all->validation;
  const std::string said = fmt::format(
      "delivered: fitted again to all 30 experiments; cross-validated over these exp_coulomb errs "
      "by {:.2f} MPa ({:.2f} to {:.2f}), cross-validated by experiment in 10 folds; the errors "
      "above "
      "are of the fits to the 24 experiments of the training",
      m.mae_MPa, m.mae_interval.low, m.mae_interval.high);
  EXPECT_EQ(delivery_sentence(c, 2), said);
  c.fits.back().on_all = nullptr; // as a law that tracing added
  EXPECT_EQ(delivery_sentence(c, 2), said + "; coulomb is delivered as traced, fitted to the "
                                            "training experiments alone");
}

TEST(Deliver, WhereAllExperimentsAreInTheFitAnywaySaysSo) {
  const Dataset data = campaign(12, 1);
  for (const Deliver deliver : {Deliver::training, Deliver::all}) {
    const Calibration c = calibrated(data, data, deliver, {"orowan"}, JudgedBy::leave_one_out);
    EXPECT_FALSE(c.fits.front().on_all);
    EXPECT_EQ(delivery_sentence(c, 2),
              deliver == Deliver::training
                  ? ""
                  : "deliver = \"all\" changes nothing: the laws delivered are fitted to all 12 "
                    "experiments, and the errors of those left out in turn are what to expect on "
                    "new tests");
  }
  const Dataset one = campaign(1, 1);
  EXPECT_EQ(
      delivery_sentence(calibrated(one, one, Deliver::all, {"orowan"}, JudgedBy::fit), 2),
      "deliver = \"all\" changes nothing: the laws are fitted to the one experiment there is");
}

TEST(Deliver, FilesReadBackAndThoseOfEarlierVersionsToo) {
  const Calibration c = calibrated(campaign(12, 1), campaign(6, 2), Deliver::all, some_laws);
  const std::string text = calibrate::calibration_json(c);
  const Calibration again = calibrate::parse_calibration(text, "c.json");
  EXPECT_EQ(calibrate::calibration_json(again), text);
  const ModelFit model =
      calibrate::parse_model_fit(calibrate::model_json(again.fits[0], again), "m.json");
  EXPECT_EQ(model.model.parameters, c.fits[0].on_all->model.parameters);
  EXPECT_TRUE(model.fitted_to_all);

  auto old = nlohmann::ordered_json::parse(text);
  old.erase("deliver");
  old.erase("delivery_folds");
  for (auto& fit : old.at("models"))
    fit.erase("delivered");
  const Calibration read = calibrate::parse_calibration(old.dump(), "c.json");
  EXPECT_EQ(read.deliver, Deliver::training);
  EXPECT_FALSE(read.fits[0].delivered().fitted_to_all);

  auto mixed = nlohmann::ordered_json::parse(text);
  mixed["models"][0]["delivered"] = mixed["models"][1]["delivered"];
  EXPECT_EQ(test::refusal([&] { calibrate::parse_calibration(mixed.dump(), "c.json"); }),
            fmt::format("c.json: error: what is delivered of '{}' is a '{}'\n"
                        "  hint: calibrate again",
                        c.fits[0].model.law->name, c.fits[1].model.law->name));
}

TEST(LongDeliver, AllIsTheSameForAnyNumberOfThreads) {
  const Dataset training = campaign(24, 1), validation = campaign(8, 2);
  std::string first;
  for (const unsigned threads : {1U, 2U, 3U}) {
    set_threads(threads);
    Calibration c =
        calibrated(training, validation, Deliver::all, {"exp_coulomb", "neural_network"});
    set_threads(0);
    for (const ModelFit& fit : c.fits)
      EXPECT_EQ(fit.on_all->network.has_value(), fit.network.has_value());
    const std::string text = calibrate::calibration_json(c);
    if (first.empty()) first = text;
    EXPECT_EQ(text, first) << threads;
  }
}

TEST(Together, HoldsTheColumnsOfBothAndTellsExperimentsApart) {
  Dataset first, second;
  first.columns = {
      {"x", "", {1, 2}, {}}, {"batch", "", {0, 1}, {"a", "c"}}, {"own", "", {5, 6}, {}}};
  first.experiments = {"A", "A (2)"};
  first.first_row = {0, 1, 2};
  second.columns = {{"batch", "", {0, 0, 1}, {"b", "c"}}, {"x", "", {3, 4, 5}, {}}};
  second.experiments = {"A", "B"};
  second.first_row = {0, 2, 3};
  const Dataset both = data::together(first, second);
  EXPECT_THAT(both.experiments, testing::ElementsAre("A", "A (2)", "A (3)", "B"));
  EXPECT_THAT(both.first_row, testing::ElementsAre(0, 1, 2, 4, 5));
  ASSERT_EQ(both.columns.size(), 2U);
  EXPECT_THAT(both.find("x")->values, testing::ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(both.find("batch")->levels, testing::ElementsAre("a", "b", "c"));
  EXPECT_THAT(both.find("batch")->values, testing::ElementsAre(0, 2, 1, 1, 2));
}

} // namespace
} // namespace frictab::delivery_test
