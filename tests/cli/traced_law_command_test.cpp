// A law with traced effects through the commands: from its file in models/ to verified routines.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "support/run_command.h"
#include "support/traced_law.h"

namespace frictab::traced_law_command_test {
namespace {

namespace fs = std::filesystem;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;

// Path and speed of the sample are drawn each for itself.
const char* const job_text = R"([data]
training = "training.csv"
validation = "validation.csv"
allow_implausible = ["speed"]
[models]
use = ["log_coulomb"]
[table]
model = "log_coulomb_traced"
[export]
targets = ["c", "abaqus_vfric", "abaqus_table"]
[export.inputs]
humidity_pct = "field:1"
[verify]
samples = 2000
)";

class TracedLawCommands : public testing::Test {
protected:
  void SetUp() override {
    const data::Dataset data = test::traced_data(truth);
    const std::size_t training[] = {0, 1, 2, 3, 4, 5, 6, 7}, validation[] = {8, 9, 10, 11};
    directory.write("training.csv", test::csv_of(data.subset(training)));
    directory.write("validation.csv", test::csv_of(data.subset(validation)));
    job = directory.write("job.toml", job_text);
    const auto result = run_frictab({"calibrate", job, "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    add_traced();
  }

  // What the trace stage leaves behind.
  void add_traced() {
    calibrate::Calibration calibration =
        calibrate::parse_calibration(directory.read("out/calibration.json"), "c.json");
    calibrate::ModelFit fit = calibration.fits.front();
    fit.model = truth;
    fit.std_error.assign(truth.parameters.size(), 0.001);
    calibration.fits.push_back(fit);
    fs::remove(directory.path("out/stages.json")); // which knows what was changed
    directory.write("out/calibration.json", calibrate::calibration_json(calibration));
    directory.write("out/models/log_coulomb_traced.json", calibrate::model_json(fit, calibration));
  }

  test::CommandResult verify_alone(const std::string& data) {
    return run_frictab({"verify", "--table", directory.path("out/tables/log_coulomb_traced.h5"),
                        "--model", directory.path("out/models/log_coulomb_traced.json"), "--data",
                        data});
  }

  const models::Model truth = test::traced_model({"humidity", "work"});
  TemporaryDirectory directory;
  std::string job;
};

TEST_F(TracedLawCommands, GoFromTheModelToRoutinesThatAreVerified) {
  for (const char* stage : {"tabulate", "export", "verify", "report"}) {
    const auto result = run_frictab({stage, job, "-q"});
    ASSERT_EQ(result.exit_code, 0) << stage << result.out << result.err;
    EXPECT_EQ(result.err, "") << stage;
  }
  const std::string vfric = directory.read("out/export/abaqus_vfric/frictab_vfric.f");
  EXPECT_THAT(vfric, HasSubstr("preDefSec(k,1)"));
  EXPECT_THAT(directory.read("out/verify.json"), HasSubstr("\"passed\": true"));
  EXPECT_THAT(directory.read("out/verify.json"), HasSubstr("friction_work"));
  EXPECT_THAT(directory.read("out/report.html"), HasSubstr("log_coulomb_traced"));
  const auto info =
      run_frictab({"table", "info", directory.path("out/tables/log_coulomb_traced.h5")});
  EXPECT_THAT(info.out, HasSubstr("humidity_pct   no axis, verified from 30 to 60"));
}

TEST_F(TracedLawCommands, VerifyOneTableOnDataThatHaveItsColumns) {
  ASSERT_EQ(run_frictab({"tabulate", job, "-q"}).exit_code, 0);
  EXPECT_EQ(verify_alone(directory.path("validation.csv")).exit_code, 0);
  data::Dataset data = test::traced_data(truth);
  std::erase_if(data.columns, [](const data::Column& c) { return c.name == "humidity_pct"; });
  const auto lacking = verify_alone(directory.write("dry.csv", test::csv_of(data)));
  EXPECT_EQ(lacking.exit_code, 2);
  EXPECT_THAT(lacking.err, HasSubstr("dry.csv: error: the data have no column humidity_pct, which "
                                     "log_coulomb_traced needs"));
}

TEST_F(TracedLawCommands, RemoveWhatAnEarlierTraceLeft) {
  ASSERT_EQ(run_frictab({"tabulate", job, "-q"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(directory.path("out/tables/log_coulomb_traced.h5")));
  ASSERT_EQ(run_frictab({"calibrate", job, "-q"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(directory.path("out/models/log_coulomb_traced.json")));
  const auto missing = run_frictab({"tabulate", job, "-q"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("law 'log_coulomb_traced' was not calibrated"));
  ASSERT_EQ(run_frictab({"tabulate", job, "-q", "--set", "table.model=log_coulomb"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(directory.path("out/tables/log_coulomb_traced.h5")));
}

TEST_F(TracedLawCommands, RefuseAnInputThatIsNoColumn) {
  const auto result =
      run_frictab({"calibrate", job, "-q", "--set", "export.inputs.humidty_pct=\"field:2\""});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("'humidty_pct' in [export.inputs] is not a state, history or "
                                    "column\n  hint: did you mean 'humidity_pct'?"));
}

} // namespace
} // namespace frictab::traced_law_command_test
