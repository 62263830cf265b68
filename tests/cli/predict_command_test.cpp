// frictab predict: rows in, stress, band, residual and what lies outside out.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "calibrate/input_columns.h"
#include "core/text.h"
#include "support/json.h"
#include "support/run_command.h"
#include "support/traced_law.h"

namespace frictab::predict_command_test {
namespace {

using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using Rows = std::vector<std::vector<std::string>>;

Rows cells_of(const std::string& csv) {
  Rows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back(1);
    for (const char c : line)
      if (c == ',')
        rows.back().emplace_back();
      else
        rows.back().back() += c;
  }
  return rows;
}

std::vector<std::string> column(const Rows& rows, const std::string& name) {
  const auto at = std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin();
  std::vector<std::string> cells;
  for (std::size_t i = 1; i < rows.size(); ++i)
    cells.push_back(rows[i].at(static_cast<std::size_t>(at)));
  return cells;
}

// ---- the twin's campaign ----

class PredictCommand : public testing::Test {
protected:
  static void SetUpTestSuite() {
    directory = new TemporaryDirectory;
    const std::string twin = directory->path("twin");
    ASSERT_EQ(run_frictab({"twin", twin, "--design", "v=50,200;T=20,120;points=12;validation=3"})
                  .exit_code,
              0);
    const auto result = run_frictab({"calibrate", twin + "/job.toml", "-q", "--set", two_laws});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  static void TearDownTestSuite() { delete directory; }

  static std::string in_twin(const std::string& file) { return directory->path("twin/" + file); }
  static test::CommandResult predict(const std::string& law, const std::string& data,
                                     std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"predict", law, data});
    if (law.ends_with(".toml")) more.insert(more.end(), {"--set", two_laws});
    return run_frictab(more);
  }
  static std::string model(const std::string& name) {
    return in_twin("out/models/" + name + ".json");
  }

  static constexpr const char* two_laws = "models.use=[\"log_coulomb\", \"orowan\"]";
  static inline TemporaryDirectory* directory = nullptr;
};

constexpr const char* states = "experiment,sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,sigma_f_MPa\n";

// tau_R = 0.1 sigma_N up to k, calibrated on 19 experiments with factors of 0.82 to 1.18.
std::string round_model() {
  calibrate::ModelFit fit;
  fit.model.law = models::shared_law(*models::find_law("coulomb"));
  fit.model.parameters = {0.1};
  fit.std_error = {0.001};
  for (int i = -9; i <= 9; ++i)
    fit.model.experiment_gains.push_back(1 + 0.02 * i);
  fit.data_range = {{"sigma_n_MPa", {500, 2000}}, {"sigma_f_MPa", {400, 500}}};
  return calibrate::model_json(fit, {});
}

TEST_F(PredictCommand, RowsWithoutAMeasuredStressHaveLawBandAndWhatIsOutside) {
  const std::string law = directory->write("round.json", round_model());
  const std::string rows = directory->write("rows.csv", "experiment,sigma_n_MPa,sigma_f_MPa\n"
                                                        "A,1000,480\n"
                                                        "A,3000,480\n"
                                                        "B,100,600\n");
  const auto result = predict(law, rows);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out,
            "experiment,row,sigma_n_MPa,sigma_f_MPa,tau_R_MPa,tau_R_q05_MPa,tau_R_q95_MPa,outside\n"
            "A,1,1000,480,100,82,118,\n"
            "A,2,3000,480,277.1281292110204,246.00000000000003,277.1281292110204,sigma_n_MPa\n"
            "B,1,100,600,10,8.200000000000001,11.799999999999999,sigma_n_MPa sigma_f_MPa\n");
  EXPECT_EQ(result.err,
            "coulomb on 3 rows of 2 experiments: " + rows +
                "\n"
                "No measured stress in the data: nothing to compare with\n"
                "Band: 5 % of new experiments lie below tau_R_q05_MPa, 5 % above tau_R_q95_MPa, "
                "each as a whole; noise within a test comes on top\n"
                "2 rows (66.7 %) outside the data that the law was calibrated on:\n"
                "  sigma_n_MPa: 2 rows outside 500 .. 2000\n"
                "  sigma_f_MPa: 1 row outside 400 .. 500\n");
}

TEST_F(PredictCommand, RowsWhoseMeasuredStressAloneIsEmptyArePredictedLikeTheOthers) {
  const std::string law = directory->write("round.json", round_model());
  const auto of = [&](const std::string& rows) {
    const auto result = predict(law, directory->write("some.csv", rows));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  };
  const auto some = of("experiment,sigma_n_MPa,sigma_f_MPa,tau_R_MPa\nA,1000,480,\n"
                       "B,1000,480,105\nB,500,480,n/a\nB,500,480,47\n");
  EXPECT_EQ(some.out, "experiment,row,sigma_n_MPa,sigma_f_MPa,tau_R_MPa,tau_R_q05_MPa,"
                      "tau_R_q95_MPa,measured_tau_R_MPa,residual_MPa,outside\n"
                      "A,1,1000,480,100,82,118,,,\n"
                      "B,1,1000,480,100,82,118,105,5,\n"
                      "B,2,500,480,50,41,59,,,\n"
                      "B,3,500,480,50,41,59,47,-3,\n");
  EXPECT_THAT(some.err, HasSubstr("\nMAE 4 MPa, RMSE 4.123 MPa, bias 1 MPa (measured - law; 2 rows "
                                  "without a measured stress)\n"));
  // Eq. 1: tau_R = F_R/F_N*sigma_n
  const auto forces = of("experiment,sigma_n_MPa,sigma_f_MPa,F_R_N,F_N_N\nA,1000,480,,50\n"
                         "A,1000,480,10,\nA,1000,480,5,50\n");
  EXPECT_THAT(forces.out, HasSubstr("\nA,1,1000,480,100,82,118,,,\nA,2,1000,480,100,82,118,,,\n"
                                    "A,3,1000,480,100,82,118,100,0,\n"));
  EXPECT_THAT(of("experiment,sigma_n_MPa,sigma_f_MPa,tau_R_MPa\nA,1000,480,\n").err,
              HasSubstr("\nNo measured stress in the data"));
}

TEST_F(PredictCommand, TheTwinsRowsHaveEveryColumn) {
  const auto result = predict(model("log_coulomb"), in_twin("validation.csv"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("experiment,row,sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,"
                                     "sigma_f_MPa,tau_R_MPa,tau_R_q05_MPa,tau_R_q95_MPa,"
                                     "measured_tau_R_MPa,residual_MPa,outside\n"
                                     "V001,1,500,1,"));
}

TEST_F(PredictCommand, MeasuredRowsHaveResidualsAndTheErrorsOfTheCalibration) {
  const auto result =
      predict(in_twin("job.toml"), in_twin("validation.csv"), {"--model", "log_coulomb"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Rows rows = cells_of(result.out);
  const auto law = column(rows, "tau_R_MPa"), measured = column(rows, "measured_tau_R_MPa"),
             residual = column(rows, "residual_MPa"), row = column(rows, "row");
  ASSERT_EQ(law.size(), 36u);
  double sum = 0;
  for (std::size_t i = 0; i < law.size(); ++i) {
    EXPECT_EQ(std::stod(residual[i]), std::stod(measured[i]) - std::stod(law[i]));
    sum += std::abs(std::stod(residual[i]));
    EXPECT_EQ(row[i], std::to_string(i % 12 + 1));
  }
  const auto calibration = test::parse_json(directory->read("twin/out/calibration.json"));
  for (const auto& fit : calibration["models"]) {
    if (fit["name"] != "log_coulomb") continue;
    const double mae = fit["validation"]["mae_MPa"];
    EXPECT_NEAR(sum / 36, mae, 1e-9);
    EXPECT_THAT(result.err, HasSubstr(fmt::format("\nMAE {:.4g} MPa, RMSE ", mae)));
  }
}

TEST_F(PredictCommand, LawIsTheOneThatIsTabulatedUnlessNamed) {
  const std::string job = in_twin("job.toml"), data = in_twin("validation.csv");
  const auto best = predict(job, data);
  const auto calibration = test::parse_json(directory->read("twin/out/calibration.json"));
  EXPECT_THAT(best.err,
              StartsWith(calibration["models"][0]["name"].get<std::string>() + " on 36 "));
  for (const char* name : {"orowan", "log_coulomb"}) {
    const auto named = predict(job, data, {"--model", name});
    EXPECT_THAT(named.err, StartsWith(std::string(name) + " on 36 rows of 3 experiments: "));
    EXPECT_EQ(predict(job, data, {"--set", "table.model=" + std::string(name)}).out, named.out);
    EXPECT_EQ(predict(model(name), data).out, named.out); // from its file the same bits
  }
}

TEST_F(PredictCommand, MappingOfTheJobReadsTheRows) {
  const std::string job = in_twin("mapped.toml");
  std::string text = directory->read("twin/job.toml");
  text.replace(text.find("[data]\n"), 7,
               "[data]\ndrop = { tau_R_MPa = { below = 0.1 } }\nbystanders = [\"film_um\"]\n");
  text += "[data.columns]\nsigma_n_MPa = { column = \"Pressure\", unit = \"Pa\" }\n"
          "tau_R_MPa = { column = \"Friction\", times = \"sigma_n_MPa\" }\n"
          "[data.constants]\nsigma_f_MPa = 480\n";
  directory->write("twin/mapped.toml", text);
  const std::string plain =
      directory->write("plain.csv", std::string(states) + "A,1000,2,50,60,480\n"
                                                          "A,900,2,50,60,480\n");
  const std::string rows = "Pressure,psi,v_rel_mm_s,T_contact_C\n1e9,2,50,60\n9e8,2,50,60\n";
  const auto lacking = predict(job, directory->write("A", rows), {"--model", "log_coulomb"});
  EXPECT_EQ(lacking.exit_code, 0) << lacking.err;
  EXPECT_EQ(lacking.out, predict(model("log_coulomb"), plain).out);
  EXPECT_THAT(lacking.err, HasSubstr("\nNo measured stress in the data"));
}

TEST_F(PredictCommand, ResultsGoToAFileAndTheSummaryToStderrOrAsJsonToStdout) {
  const std::string file = directory->path("predicted.csv");
  const std::string rows = predict(model("orowan"), in_twin("validation.csv")).out;
  const auto quiet = predict(model("orowan"), in_twin("validation.csv"), {"-o", file, "-q"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(directory->read("predicted.csv"), rows);
  const auto json = predict(model("orowan"), in_twin("validation.csv"), {"-o", file, "--json"});
  const auto summary = test::parse_json(json.out);
  EXPECT_EQ(summary["schema"], "frictab/prediction/1");
  EXPECT_EQ(summary["n_rows"], 36);
  EXPECT_EQ(summary["n_rows_measured"], 36);
  EXPECT_GT(summary["mae_MPa"], 0.0);
  const auto without = predict(model("orowan"), in_twin("validation.csv"), {"--json"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("-o FILE.csv"));
}

TEST_F(PredictCommand, CalibrationOfFewExperimentsHasNoBand) {
  auto json = test::parse_json(directory->read("twin/out/models/orowan.json"));
  json["experiment_gains"] = {0.9, 1.0, 1.1};
  const std::string few = directory->write("few.json", json.dump());
  const auto result = predict(few, in_twin("validation.csv"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("tau_R_q05_MPa")));
  EXPECT_THAT(result.err,
              HasSubstr("\nNo band: 3 experiments of the calibration do not give 5 % and 95 %\n"));
}

// ---- faults ----

TEST_F(PredictCommand, EveryFaultSaysWhereAndHowToMendIt) {
  const auto fault = [&](const std::string& law, const std::string& data,
                         std::vector<std::string> more = {}) {
    const auto result = predict(law, data, std::move(more));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  const std::string data = in_twin("validation.csv"), job = in_twin("job.toml");
  EXPECT_THAT(fault(job, data, {"--model", "shaw"}),
              HasSubstr("error: law 'shaw' was not calibrated\n  hint: "));
  EXPECT_THAT(fault(model("orowan"), data, {"--model", "orowan"}),
              HasSubstr("error: --model NAME is for a job"));
  EXPECT_THAT(fault(model("orowan"), directory->path("none.csv")), HasSubstr("none.csv"));
  EXPECT_THAT(fault(directory->path("none.json"), data), HasSubstr("none.json"));
  EXPECT_THAT(fault(in_twin("out/calibration.json"), data),
              HasSubstr("calibration.json: error: its schema is \"frictab/calibration/1\", not "
                        "\"frictab/model/1\"\n  hint: give models/"));
  EXPECT_THAT(fault(directory->write("other/job.toml", "[data]\ntraining = \"a.csv\"\n"), data),
              HasSubstr("there is no calibration yet\n  hint: run `frictab calibrate "));

  const std::string narrow =
      directory->write("narrow.csv", "sigma_n_MPa,sigma_f_MPa\n1000,480\n900,480\n");
  EXPECT_THAT(fault(model("log_coulomb"), narrow),
              HasSubstr("narrow.csv: error: the data have no column psi, v_rel_mm_s, T_contact_C, "
                        "which log_coulomb needs\n  hint: "));
  const std::string wrong =
      directory->write("wrong.csv", "sigma_n_MPa,sigma_f_MPa\n1000,480\n-900,480\n");
  EXPECT_THAT(fault(model("orowan"), wrong), HasSubstr("wrong.csv:3: error: sigma_n_MPa is -900"));

  auto json = test::parse_json(directory->read("twin/out/models/orowan.json"));
  json.erase("data_range");
  EXPECT_THAT(fault(directory->write("old.json", json.dump()), data),
              HasSubstr("does not say what the data of its calibration reached along sigma_n_MPa\n"
                        "  hint: calibrate again with this version"));
}

// ---- a law with traced effects ----

// Effects of a recorded column, a text column and a history of the law's own stress.
class PredictTraced : public testing::Test {
protected:
  void SetUp() override {
    const models::AssembledLaw law(truth);
    calibrate::ModelFit fit;
    fit.model = truth;
    fit.std_error.assign(truth.parameters.size(), 0.001);
    fit.data_range = calibrate::input_columns(law, law.inputs, data).ranges();
    file = directory.write("traced.json", calibrate::model_json(fit, {}));
  }

  test::CommandResult predict(const std::string& csv) {
    return run_frictab({"predict", file, directory.write("rows.csv", csv)});
  }

  static void drop(data::Dataset& data, const std::string& name) {
    std::erase_if(data.columns, [&](const data::Column& c) { return c.name == name; });
  }

  const models::Model truth = test::traced_model({"humidity", "work", "tool"});
  const data::Dataset data = test::traced_data(truth);
  TemporaryDirectory directory;
  std::string file;
};

TEST_F(PredictTraced, HistoriesFollowTheLawsOwnStress) {
  const auto measured = predict(test::csv_of(data));
  EXPECT_EQ(measured.exit_code, 0) << measured.err;
  EXPECT_THAT(measured.err, HasSubstr("\nNo row outside the data that the law was calibrated on"));
  data::Dataset unmeasured = data;
  drop(unmeasured, "tau_R_MPa");
  const Rows rows = cells_of(predict(test::csv_of(unmeasured)).out);
  EXPECT_EQ(column(rows, "tau_R_MPa"), column(cells_of(measured.out), "tau_R_MPa"));
  const auto tau = column(rows, "tau_R_MPa");
  for (std::size_t i = 0; i < data.rows(); ++i)
    EXPECT_NEAR(std::stod(tau[i]), data.values("tau_R_MPa")[i], 1e-9);
  EXPECT_EQ(column(rows, "tool")[0], "A"); // levels by name, not by number
  EXPECT_GT(std::stod(column(rows, "friction_work")[5]), 0);
}

TEST_F(PredictTraced, RecordedColumnsBeyondTheDataAreNamed) {
  data::Dataset damp = data;
  for (data::Column& one : damp.columns)
    if (one.name == "humidity_pct") one.values[3] = 95;
  const auto result = predict(test::csv_of(damp));
  EXPECT_EQ(column(cells_of(result.out), "outside")[3], "humidity_pct");
  EXPECT_THAT(result.err, HasSubstr("\n  humidity_pct: 1 row outside 30"));
}

TEST_F(PredictTraced, WhatTheLawCannotTakeIsAFault) {
  data::Dataset dry = data;
  drop(dry, "humidity_pct");
  EXPECT_THAT(predict(test::csv_of(dry)).err,
              HasSubstr("rows.csv: error: the data have no column humidity_pct, which "
                        "log_coulomb_traced needs\n  hint: record it"));
  data::Dataset unnamed = data;
  drop(unnamed, "tool");
  EXPECT_THAT(predict(test::csv_of(unnamed)).err, HasSubstr("labels = {...} of [[data.files]]\n"));
  data::Dataset still = data;
  drop(still, "s_mm");
  drop(still, "time_s");
  EXPECT_THAT(predict(test::csv_of(still)).err, HasSubstr("friction_work (from s_mm)"));

  const std::string text = test::csv_of(data);
  EXPECT_THAT(predict(replace_all(text, ",A,", ",X,")).err,
              HasSubstr("column tool has the level 'X', of which the law knows nothing\n"
                        "  hint: known: A, B, C"));
}

TEST_F(PredictTraced, EmptyCellThatTheLawNeedsIsAFault) {
  data::Dataset gap = data;
  for (data::Column& one : gap.columns)
    if (one.name == "humidity_pct") one.values[1] = std::nan("");
  const auto result = predict(test::csv_of(gap));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("humidity_pct is empty in row 2 of '" + data.experiments[0] +
                                    "', and log_coulomb_traced needs it"));
}

} // namespace
} // namespace frictab::predict_command_test
