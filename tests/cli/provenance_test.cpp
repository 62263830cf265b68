// What a stage is given is what its name says: of this schema, of this law, of these data, and as
// it was written. A proof that a file claims is called a claim.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"
#include "support/small_campaign.h"

namespace frictab::provenance_test {
namespace {

using test::CommandResult;
using test::run_command;
using testing::HasSubstr;
using testing::Not;

class Provenance : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job(std::string("[models]\nuse = [\"coulomb\", \"shear\", \"levanov\"]\n"
                          "[table]\nmodel = [\"shear\", \"levanov\"]\n"
                          "[export]\ntargets = [\"c\"]\n") +
              test::no_causes);
    ASSERT_EQ(frictab({"tabulate", "job.toml"}).exit_code, 0);
  }
  void copy(const std::string& from, const std::string& to) {
    directory.write(to, directory.read(from));
  }
  void replace(const std::string& file, const std::string& from, const std::string& to) {
    const std::string text = directory.read(file);
    ASSERT_THAT(text, HasSubstr(from)) << file;
    directory.write(file, replace_all(text, from, to));
  }
  void without_stages() {
    ASSERT_EQ(run_command({"rm", directory.path("out/stages.json")}).exit_code, 0);
  }
  void set_attribute(const std::string& table, const std::string& name, const std::string& value) {
    const CommandResult result = run_command(
        {FRICTAB_PYTHON, "-c",
         "import h5py, sys\nwith h5py.File(sys.argv[1], 'r+') as f: f.attrs[sys.argv[2]] = "
         "eval(sys.argv[3])",
         directory.path(table), name, value});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
};

TEST_F(Provenance, FileOfAnotherKindIsRefusedWhereverItIsRead) {
  without_stages();
  copy("out/models/shear.json", "out/calibration.json");
  for (const char* command : {"trace", "tabulate", "export", "verify", "report"}) {
    const CommandResult result = frictab({command, "job.toml"});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("out/calibration.json: error: its schema is "
                                      "\"frictab/model/1\", not \"frictab/calibration/1\"\n"))
        << command;
  }
}

TEST_F(Provenance, TableOfAnotherVersionIsRefused) {
  set_attribute("out/tables/shear.h5", "schema", "'frictab/table/9'");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"table", "info", "out/tables/shear.h5"},
        {"export", "--table", "out/tables/shear.h5", "--targets", "c", "-o", "there"},
        {"verify", "--table", "out/tables/shear.h5", "--model", "out/models/shear.json"}}) {
    const CommandResult result = frictab(command);
    EXPECT_EQ(result.exit_code, 2) << command[0];
    EXPECT_THAT(result.err, HasSubstr("the layout is frictab/table/9"));
  }
}

TEST_F(Provenance, TableUnderTheNameOfAnotherLawIsRefused) {
  without_stages(); // which would know that it was changed
  copy("out/tables/shear.h5", "out/tables/levanov.h5");
  for (const char* command : {"export", "verify", "report"}) {
    const CommandResult result = frictab({command, "job.toml"});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("out/tables/levanov.h5: error: holds a table of 'shear'\n"));
  }
}

TEST_F(Provenance, ChangedTableIsMeasuredAndNotExported) {
  ASSERT_EQ(run_command({FRICTAB_PYTHON, "-c",
                         "import h5py, sys\n"
                         "with h5py.File(sys.argv[1], 'r+') as f: f['value'][...] *= 1.2",
                         directory.path("out/tables/levanov.h5")})
                .exit_code,
            0);
  const CommandResult exported = frictab({"export", "job.toml"});
  EXPECT_EQ(exported.exit_code, 2);
  EXPECT_THAT(exported.err, HasSubstr("out/tables/levanov.h5: error: was changed since `frictab "
                                      "tabulate` wrote it\n  hint: `frictab tabulate job.toml` "
                                      "rebuilds it"));
  ASSERT_EQ(frictab({"export", "job.toml", "-o", "out"}).exit_code, 2);
  const CommandResult verified = frictab({"verify", "job.toml", "--set", "export.targets=[]"});
  EXPECT_EQ(verified.exit_code, 1);
  EXPECT_THAT(verified.err, HasSubstr("out/tables/levanov.h5 was changed since"));
  EXPECT_THAT(verified.out, HasSubstr("OVER TOLERANCE"));
}

TEST_F(Provenance, ChangedCalibrationIsNamed) {
  const std::string text = directory.read("out/calibration.json");
  directory.write("out/calibration.json", text + " ");
  for (const char* command : {"trace", "tabulate", "export", "verify", "report"}) {
    const CommandResult result = frictab({command, "job.toml"});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("out/calibration.json: error: was changed since `frictab "
                                      "calibrate` wrote it\n"));
  }
}

TEST_F(Provenance, StatusNamesAResultThatWasChanged) {
  for (const char* file : {"models/shear.json", "calibration.json"}) {
    directory.write(std::string("out/") + file, directory.read(std::string("out/") + file) + " ");
    EXPECT_THAT(frictab({"status", "job.toml"}).out,
                HasSubstr("calibrate  stale: " + std::string(file) + " was changed since\n"));
  }
}

TEST_F(Provenance, PredictTakesNoCalibrationOfAnotherJob) {
  const std::vector<std::string> command = {"predict", "job.toml", "data/validation.csv", "-q"};
  ASSERT_EQ(frictab(command).exit_code, 0);
  std::vector<std::string> other = command;
  other.insert(other.end(), {"--set", "models.shear_yield=\"tresca\""});
  const CommandResult result = frictab(other);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("out/calibration.json: error: is stale: [models] or "
                                    "[calibration] of the job has changed since\n"));
  directory.write("out/calibration.json", directory.read("out/calibration.json") + " ");
  EXPECT_THAT(frictab(command).err, HasSubstr("was changed since `frictab calibrate` wrote it\n"));
}

TEST_F(Provenance, OtherDataAreNamedByEveryStageWithAndWithoutARecord) {
  replace("data/training.csv", "E001,", "E001_again,");
  for (const char* command : {"trace", "tabulate", "export", "verify", "report"})
    EXPECT_THAT(frictab({command, "job.toml"}).err, HasSubstr("the data have changed since"))
        << command;
  without_stages();
  for (const char* command : {"trace", "tabulate", "export", "verify", "report"}) {
    const CommandResult result = frictab({command, "job.toml"});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("out/calibration.json: error: was made from other data"));
  }
}

TEST_F(Provenance, ProofThatAFileClaimsIsCalledAClaim) {
  set_attribute("out/tables/levanov.h5", "proven_drift_MPa", "1e-7");
  EXPECT_THAT(frictab({"table", "info", "out/tables/levanov.h5"}).out,
              HasSubstr("Proven, as the file says: nowhere above 1e-07 MPa\n"));
  ASSERT_EQ(frictab({"export", "--table", "out/tables/levanov.h5", "--targets", "c", "-o", "there"})
                .exit_code,
            0);
  EXPECT_THAT(directory.read("there/c/frictab_tau_R.h"), HasSubstr("(so says the table's file)"));
  const CommandResult verified = frictab({"verify", "job.toml", "--set", "export.targets=[]"});
  EXPECT_EQ(verified.exit_code, 1) << "a claim that is not true";
  EXPECT_THAT(verified.out, HasSubstr("proven_drift_MPa is 1e-07, made as "));
  EXPECT_THAT(directory.read("out/verify.json"), Not(HasSubstr("\"proven_MPa\": 1e-07")));
}

TEST_F(Provenance, NameOfALawLeadsNowhere) {
  without_stages();
  for (const std::string name : {"../../../../escaped", "a/b", "a\\nb", "<b>", "", ".hidden"}) {
    copy("out/calibration.json", "saved.json");
    replace("out/calibration.json", "\"name\": \"levanov\"", "\"name\": \"" + name + "\"");
    for (const char* command : {"trace", "tabulate", "report"}) {
      const CommandResult result = frictab({command, "job.toml"});
      EXPECT_EQ(result.exit_code, 2) << name;
      EXPECT_THAT(result.err, HasSubstr("out/calibration.json: error: "));
    }
    copy("saved.json", "out/calibration.json");
  }
}

TEST_F(Provenance, ControlCharactersReachNoTerminal) {
  replace("data/training.csv", "E001,", "E0\x1b[2J01,");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"data", "job.toml"}, {"run", "job.toml"}, {"status", "\x1b[1m"}}) {
    const CommandResult result = frictab(command);
    EXPECT_THAT(result.out + result.err, Not(HasSubstr("\x1b"))) << command[0];
  }
  EXPECT_THAT(frictab({"data", "job.toml"}).out, HasSubstr("E0\\x1b[2J01"));
}

} // namespace
} // namespace frictab::provenance_test
