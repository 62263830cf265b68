// Campaigns of few tests: every error of prediction is of a test that its law has not seen, and the
// best law's error is corrected for its having been chosen by it.
#include <array>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "calibrate/choice.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/folds.h"
#include "core/random.h"
#include "support/sample_data.h"

namespace frictab::small_campaign_test {
namespace {

using calibrate::Calibration;
using calibrate::CalibrationInput;
using calibrate::Choice;
using calibrate::JudgedBy;
using calibrate::LawErrors;
using calibrate::ModelFit;
using data::Dataset;
using stats::ErrorSums;

Dataset few_tests() {
  test::SampleOptions options;
  options.noise_MPa = 8;
  options.experiments = 9;
  return test::sample_data(test::plausible_model(*models::find_law("orowan")), options);
}

Calibration left_out_calibration(const Dataset& data, std::vector<std::string> laws) {
  CalibrationInput input{data, data, {}, {}, JudgedBy::leave_one_out};
  input.models.use = std::move(laws);
  return calibrate::calibrate(input);
}

const ModelFit& fit_of(const Calibration& calibration, const std::string& law) {
  for (const ModelFit& fit : calibration.fits)
    if (fit.model.law->name == law) return fit;
  throw std::logic_error(law);
}

TEST(SlowSmallCampaign, EveryTestIsPredictedByALawThatHasNotSeenIt) {
  const Dataset data = few_tests();
  const std::vector<std::string> laws = {"coulomb_0.08", "coulomb_mean", "orowan", "log_coulomb",
                                         "neural_network"};
  const Calibration left_out = left_out_calibration(data, laws);
  const std::size_t tests = data.experiments.size();
  EXPECT_EQ(left_out.validation_experiments, data.experiments);
  for (std::size_t e = 0; e < tests; ++e) { // by brute force: that test as validation data
    std::vector<std::size_t> others(tests);
    std::iota(others.begin(), others.end(), 0);
    others.erase(others.begin() + static_cast<long>(e));
    const Dataset training = data.subset(others), alone = data.subset(std::array{e});
    CalibrationInput input{training, alone, {}, {}};
    input.models.use = laws;
    const Calibration held_out = calibrate::calibrate(input);
    for (const std::string& law : laws) {
      const auto& unseen = fit_of(left_out, law).unseen.at(e);
      const auto& expected = fit_of(held_out, law).validation;
      EXPECT_EQ(unseen.experiment, data.experiments[e]);
      EXPECT_EQ(unseen.n_rows, expected.n_rows);
      EXPECT_DOUBLE_EQ(unseen.mae_MPa, expected.mae_MPa) << law << ", test " << e;
      EXPECT_DOUBLE_EQ(unseen.rmse_MPa, expected.rmse_MPa) << law << ", test " << e;
      EXPECT_DOUBLE_EQ(unseen.bias_MPa, expected.bias_MPa) << law << ", test " << e;
    }
  }
}

TEST(SmallCampaign, ParametersAreThoseOfAllTestsAndTheErrorsPoolTheirRows) {
  const Dataset data = few_tests();
  const Calibration left_out = left_out_calibration(data, {"coulomb", "orowan"});
  CalibrationInput all{data, data, {}, {}};
  all.models.use = {"coulomb", "orowan"};
  const Calibration seen = calibrate::calibrate(all);
  for (const ModelFit& fit : left_out.fits) {
    EXPECT_EQ(fit.model.parameters, fit_of(seen, fit.model.law->name).model.parameters);
    EXPECT_EQ(fit.training.mae_MPa, fit_of(seen, fit.model.law->name).training.mae_MPa);
    double sum = 0;
    for (const auto& one : fit.unseen)
      sum += one.mae_MPa * static_cast<double>(one.n_rows);
    EXPECT_NEAR(fit.validation.mae_MPa, sum / static_cast<double>(data.rows()), 1e-12);
    EXPECT_GT(fit.validation.mae_MPa, fit.training.mae_MPa);
    EXPECT_EQ(fit.validation.n_experiments, data.experiments.size());
  }
}

TEST(SmallCampaign, ReadsBackWithTheErrorsOfEveryTest) {
  const Dataset data = few_tests();
  const Calibration calibration = left_out_calibration(data, {"coulomb", "orowan"});
  const std::string text = calibrate::calibration_json(calibration);
  const Calibration again = calibrate::parse_calibration(text, "calibration.json");
  EXPECT_EQ(again.judged_by, JudgedBy::leave_one_out);
  EXPECT_EQ(calibrate::errors_csv(calibrate::errors_by_experiment(again, data, data)),
            calibrate::errors_csv(calibrate::errors_by_experiment(calibration, data, data)));
  EXPECT_EQ(calibrate::calibration_json(again), text);
}

// Every experiment slides from 0 to 10 mm.
Dataset sliding(Dataset data) {
  for (data::Column& column : data.columns)
    for (std::size_t e = 0; column.name == "s_mm" && e < data.experiments.size(); ++e) {
      const std::size_t first = data.first_row[e], rows = data.first_row[e + 1] - first;
      for (std::size_t i = 0; i < rows; ++i)
        column.values[first + i] = 10 * static_cast<double>(i + 1) / static_cast<double>(rows);
    }
  return data;
}

TEST(SmallCampaign, AConditionalGainIsLearnedFromTheOtherTests) {
  const Dataset data = sliding(few_tests());
  CalibrationInput input{data, data, {}, {}, JudgedBy::leave_one_out};
  input.models.use = {"coulomb"};
  input.options.condition_on_mm = 3;
  const auto left_out = calibrate::calibrate(input).conditional.laws.at(0);
  double sum = 0, rows = 0;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    std::vector<std::size_t> others;
    for (std::size_t o = 0; o < data.experiments.size(); ++o)
      if (o != e) others.push_back(o);
    const Dataset training = data.subset(others), alone = data.subset(std::array{e});
    const CalibrationInput one{training, alone, input.models, input.options};
    const auto held_out = calibrate::calibrate(one).conditional.laws.at(0).conditional;
    sum += held_out.mae_MPa * static_cast<double>(held_out.n_rows);
    rows += static_cast<double>(held_out.n_rows);
  }
  EXPECT_EQ(left_out.conditional.n_experiments, data.experiments.size());
  EXPECT_NEAR(left_out.conditional.mae_MPa, sum / rows, 1e-9);
}

TEST(SmallCampaign, TheNetworkNeedsOneMoreTestThanItTrainsOn) {
  const Dataset data = few_tests();
  const std::array first_five = {0UL, 1UL, 2UL, 3UL, 4UL};
  const Dataset five = data.subset(first_five);
  const Calibration calibration = left_out_calibration(five, {});
  ASSERT_FALSE(calibration.left_out.empty());
  EXPECT_EQ(calibration.left_out.back().text(), "neural_network: needs 6 experiments to train");
}

TEST(SmallCampaign, TellsTestsThatAreCopiesOfOthers) {
  const Dataset data = few_tests();
  EXPECT_EQ(calibrate::leak_note(data, data), "");
  const Dataset twice = data.subset(std::array{0UL, 1UL, 1UL});
  EXPECT_EQ(
      calibrate::leak_note(twice, twice),
      "2 of 3 experiments have the rows of another ('E1' those of 'E1'): they repeat nothing, "
      "and the noise floor and errors are too small");
}

// ---- choice ----

// Laws of the same true error whose errors differ by test, one by one.
std::vector<LawErrors> equal_laws(std::size_t laws, std::size_t tests, std::uint64_t seed) {
  Random random(seed);
  std::vector<LawErrors> all;
  for (std::size_t l = 0; l < laws; ++l) {
    LawErrors& law = all.emplace_back(LawErrors{"law " + std::to_string(l), {}});
    for (std::size_t e = 0; e < tests; ++e)
      law.sums.push_back({100 * (10 + 3 * random.normal()), 0, 0, 100});
  }
  const auto mae = [](const LawErrors& law) {
    double sum = 0;
    for (const ErrorSums& one : law.sums)
      sum += one.absolute;
    return sum;
  };
  std::ranges::stable_sort(all, [&](const auto& a, const auto& b) { return mae(a) < mae(b); });
  return all;
}

TEST(Choice, OfEqualLawsExpectsTheirTrueErrorWhereTheWinnersOwnIsTooSmall) {
  constexpr std::size_t campaigns = 300;
  double naive = 0, expected = 0, square = 0;
  for (std::size_t c = 0; c < campaigns; ++c) {
    const Choice choice = calibrate::choose_again(equal_laws(10, 16, c + 1), 300, 1);
    naive += choice.mae_MPa / campaigns;
    expected += choice.expected_mae_MPa / campaigns;
    square += choice.expected_mae_MPa * choice.expected_mae_MPa / campaigns;
  }
  const double error = std::sqrt((square - expected * expected) / campaigns);
  // The smallest of 10 means of 16 with a standard deviation of 3 lies 1.54 * 3/4 below 10.
  EXPECT_NEAR(naive, 10 - 1.54 * 0.75, 0.05);
  EXPECT_NEAR(expected, 10, 3 * error);
  EXPECT_LT(error, 0.06);
}

TEST(Choice, OfALawThatIsClearlyBestCostsNothing) {
  std::vector<LawErrors> laws = equal_laws(2, 12, 3);
  for (ErrorSums& one : laws[1].sums)
    one.absolute += 100 * 50;
  const Choice choice = calibrate::choose_again(laws, 500, 1);
  EXPECT_NEAR(choice.expected_mae_MPa, choice.mae_MPa, 1e-9);
  EXPECT_EQ(choice.best_in.at(0).share, 1);
  EXPECT_EQ(calibrate::share_sentence(choice),
            "of 500 resamples of the tests 100 % choose law " + laws[0].law.substr(4));
}

TEST(Choice, IsNotMadeOfOneLawOrOneTest) {
  EXPECT_EQ(calibrate::choose_again(equal_laws(1, 12, 1), 500, 1).draws, 0U);
  EXPECT_EQ(calibrate::choose_again(equal_laws(3, 1, 1), 500, 1).draws, 0U);
  EXPECT_EQ(calibrate::share_sentence({}), "");
}

TEST(Choice, OtherSplitsSayHowOftenEachLawIsBest) {
  const std::vector<LawErrors> laws = equal_laws(3, 40, 5);
  Choice choice = calibrate::choose_again(laws, 2000, 1);
  calibrate::add_split_shares(choice, laws, 10, 1);
  EXPECT_TRUE(choice.splits);
  double sum = 0;
  for (const Choice::Share& one : choice.best_in)
    sum += one.share;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_GT(choice.best_in[0].share, choice.best_in[2].share);
  EXPECT_THAT(calibrate::share_sentence(choice),
              testing::StartsWith("of 2,000 other splits of all tests "));
}

} // namespace
} // namespace frictab::small_campaign_test
