// Inputs of a law found in a dataset: recorded columns, histories, levels of text.
#include <cmath>

#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "calibrate/input_columns.h"
#include "core/error.h"
#include "data/derived.h"
#include "expr/program.h"
#include "support/refusal.h"
#include "support/traced_law.h"

namespace frictab::input_columns_test {

using calibrate::predict;
using data::Column;
using data::Dataset;
using models::Model;
using test::refusal;

namespace {

Column& column(Dataset& data, const std::string& name) {
  return *std::ranges::find(data.columns, name, &Column::name);
}

TEST(InputColumns, AreRecordedOnesWhateverCharactersTheirNamesHave) {
  const Model model = test::traced_model({"humidity"});
  Dataset data = test::traced_data(model);
  column(data, "humidity_pct").name = "humidity pct";
  const calibrate::InputColumns columns(*model.law, {"psi", "humidity_pct"}, data);
  EXPECT_EQ(columns.pointers()[0], data.values("psi").data()) << "not copied";
  EXPECT_EQ(columns.pointers()[1], data.values("humidity pct").data());
  EXPECT_EQ(predict(model, data).size(), data.rows());
}

TEST(InputColumns, ThatAreMissingAreNamedTogetherWithWhatTheyAreMadeFrom) {
  const Model model = test::traced_model({"humidity", "work"});
  Dataset data = test::traced_data(model);
  std::erase_if(data.columns,
                [](const Column& c) { return c.name == "humidity_pct" || c.name == "s_mm"; });
  EXPECT_EQ(refusal([&] { predict(model, data); }),
            "sample: error: the data have no column friction_work (from s_mm), humidity_pct, which "
            "log_coulomb_traced needs\n  hint: record it, map it in [data.columns], or give a "
            "constant in [data.constants]");
}

TEST(InputColumns, OfTestOrderNeedTheOrderOfTests) {
  const Model model = test::traced_model({});
  const Dataset data = test::traced_data(model);
  EXPECT_EQ(calibrate::missing_inputs({"test_order", "psi"}, data),
            (std::vector<std::string>{"test_order (from run_order)"}));
}

// A file of tools B and C alone numbers them 0 and 1.
TEST(InputColumns, OfTextAreNumberedAsTheLawKnowsThem) {
  const Model model = test::traced_model({"tool"});
  const Dataset all = test::traced_data(model);
  const std::size_t of_b_and_c[] = {1, 2};
  Dataset some = all.subset(of_b_and_c);
  Column& tool = column(some, "tool");
  tool.levels = {"B", "C"};
  for (double& number : tool.values)
    number -= 1;
  const std::vector<double> whole = predict(model, all), part = predict(model, some);
  EXPECT_EQ(part, std::vector<double>(whole.begin() + 40, whole.begin() + 120));
}

TEST(InputColumns, RefuseLevelsTheLawDoesNotKnowAndNumbersForText) {
  const Model model = test::traced_model({"tool", "humidity"});
  Dataset data = test::traced_data(model);
  column(data, "tool").levels[2] = "D";
  EXPECT_EQ(refusal([&] { predict(model, data); }),
            "sample: error: column tool has the level 'D', of which the law knows nothing\n"
            "  hint: known: A, B, C");
  Dataset empty = data; // of a part of the files: elsewhere the column is text
  column(empty, "tool").levels.clear();
  for (double& number : column(empty, "tool").values)
    number = std::nan("");
  EXPECT_EQ(refusal([&] { predict(model, empty); }),
            "sample: error: column tool has the level '', of which the law knows nothing\n"
            "  hint: known: A, B, C");
  column(data, "tool").levels.clear();
  EXPECT_EQ(refusal([&] { predict(model, data); }),
            "sample: error: column tool holds numbers\n"
            "  hint: the law knows its levels by name: A, B, C");
  data = test::traced_data(model);
  column(data, "humidity_pct").levels = {"dry", "wet"};
  EXPECT_EQ(
      refusal([&] { predict(model, data); }),
      "sample: error: column humidity_pct holds text, where log_coulomb_traced takes numbers\n"
      "  hint: for example 'dry'");
}

TEST(InputColumns, FollowTheLawsOwnStressUntilNothingChanges) {
  const Model model = test::traced_model({"work", "peak"});
  Dataset data = test::traced_data(model);
  const calibrate::Predicted found = calibrate::predict_with_columns(
      models::AssembledLaw(model), models::inputs(*model.law, model.conventions), data);
  const auto work = data::derive(*data::find_derived("friction_work"), data, found.tau_MPa);
  const auto peak = data::derive(*data::find_derived("peak_sigma_n"), data, {});
  const auto& names = found.columns.names();
  for (std::size_t c = 0; c < names.size(); ++c)
    for (std::size_t i = 0; i < data.rows(); ++i) {
      if (names[c] == "friction_work") {
        ASSERT_NEAR(found.columns[c][i], work[i], 1e-9 * work[i]);
      }
      if (names[c] == "peak_sigma_n") {
        ASSERT_EQ(found.columns[c][i], peak[i]);
      }
    }
  EXPECT_GT(*std::ranges::max_element(work), 1000);
  // Measured stress has no say.
  for (double& tau : column(data, "tau_R_MPa").values)
    tau *= 3;
  EXPECT_EQ(predict(model, data), found.tau_MPa);
}

TEST(InputColumns, TakeAHistoryForWhatItIsWhateverIsRecordedUnderItsName) {
  const Model model = test::traced_model({"energy"});
  Dataset data = test::traced_data(model);
  const std::vector<double> tau = predict(model, data);
  data.columns.push_back({"energy", "", std::vector<double>(data.rows(), 7), {}});
  EXPECT_EQ(predict(model, data), tau);
}

// Coulomb friction of 0.08 times 1 + a work/(1000 N/mm).
Model coulomb_with_work(double a) {
  effects::PlacedEffect effect = test::traced_effect("work");
  effect.form = effects::find_effect("linear");
  effect.parameters = {a, 0, 1000};
  const effects::PlacedEffect effects[] = {effect};
  const double mu[] = {0.08};
  const models::Law& coulomb = *models::find_law("coulomb");
  Model model;
  model.law =
      models::unregistered_law(effects::extended_law(coulomb, {}, mu, effects, "coulomb_traced"));
  model.parameters = {0.08, a};
  return model;
}

// One test under 1000 MPa, steps of ds.
Dataset sliding(std::size_t rows, double ds) {
  Dataset data;
  data.experiments = {"one"};
  data.columns = {
      {"sigma_n_MPa", "MPa", {}, {}}, {"s_mm", "mm", {}, {}}, {"sigma_f_MPa", "MPa", {}, {}}};
  for (std::size_t i = 0; i < rows; ++i) {
    data.columns[0].values.push_back(1000);
    data.columns[1].values.push_back(ds * static_cast<double>(i));
    data.columns[2].values.push_back(9000);
  }
  data.first_row = {0, rows};
  return data;
}

// d work/d s = p mu (1 + a work/w): work = (exp(p mu a s/w) - 1) w/a.
TEST(InputColumns, OfFrictionWorkSolveTheirEquation) {
  const std::vector<double> tau = predict(coulomb_with_work(0.4), sliding(401, 0.05));
  for (std::size_t i = 0; i <= 400; i += 100) {
    const double s = 0.05 * static_cast<double>(i);
    EXPECT_NEAR(tau[i], 80 * std::exp(80 * 0.4 * s / 1000), 5e-5) << s;
  }
}

// The work of one step is the mean of both its ends: tau = 80 (1 + g) / (1 - g), where g is what a
// change of tau at its end makes of itself. Rounds shrink a difference by |g| each.
TEST(InputColumns, OfFrictionWorkSettleWhereAStepMakesNearlyAllOfItself) {
  for (const double g : {0.6, 0.8, 0.92, -0.6, -0.8, -0.98})
    EXPECT_NEAR(predict(coulomb_with_work(25 * g), sliding(2, 1))[1] / (80 * (1 + g) / (1 - g)), 1,
                1e-10)
        << g;
}

} // namespace
} // namespace frictab::input_columns_test
