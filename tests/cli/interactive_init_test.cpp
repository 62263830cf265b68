// "frictab init --interactive --from": what the files leave open is asked, and answers make a job
// that runs.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::interactive_init_test {
namespace {

using test::CommandResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class InteractiveInit : public testing::Test {
protected:
  // SYNTHETIC tests of 30 rows, in files t1.csv, t2.csv, ...: a force of 100 N times the test over
  // 20 mm2, and a friction coefficient of 0.1, written as `friction` times that.
  void write_tests(int count, const std::string& header, double friction, bool with_force) const {
    for (int test = 1; test <= count; ++test) {
      std::string text = header;
      for (int i = 0; i < 30; ++i) {
        const double mu = 0.1 + 0.004 * std::sin(1.7 * i + test);
        text += fmt::format("{:.1f};{};{:.5f};20\n", 0.1 * i, 100 * test + i,
                            friction * mu * (with_force ? 100 * test + i : 1));
      }
      directory.write(fmt::format("t{}.csv", test), text);
    }
  }

  // Each answer is a line.
  CommandResult init(const std::string& answers, const std::string& more = "--interactive") const {
    directory.write("answers", answers);
    return test::run_command(
        {"sh", "-c", test::program() + " init job --force --from 't*.csv' " + more + " < answers"},
        directory.path());
  }

  void expect_reads(const std::string& tests, const std::string& law) const {
    const CommandResult fit = test::run_frictab(
        {"calibrate", "job/job.toml", "--set", fmt::format("models.use=[\"{}\"]", law)},
        directory.path());
    EXPECT_EQ(fit.exit_code, 0) << fit.err;
    EXPECT_THAT(fit.out, HasSubstr(tests)) << fit.out;
  }

  test::TemporaryDirectory directory;
};

TEST_F(InteractiveInit, GivesColumnsWithoutNamesTheirMeaningInEveryFile) {
  write_tests(3, "", 1, false);
  const CommandResult asked = init("time_s\nF_N_N\nmu\nv_rel_mm_s\n/20\ns\nN\nm/min\n480\n");
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_THAT(asked.err, AllOf(HasSubstr("What is column 3 (0.10337, "),
                               HasSubstr("/78.5  the normal force over this area, in mm2"),
                               Not(HasSubstr("open question"))));
  EXPECT_EQ(
      directory.read("job/job.toml"),
      R"(# Guessed from the files; every line may be wrong. frictab data shows what is read with it,
# frictab explain job what else there is.

[data]
training = "../*.csv"                        # 3 files
header = false                               # no line of names: columns are taken by number
experiment = "file"                          # no column names the tests: each file is one

[data.columns]
time_s = { column = 1 }                      # first values: 0, 0.1, 0.2; in s, as answered
F_N_N = { column = 2 }                       # first values: 100, 101, 102; in N, as answered
tau_R_MPa = { column = 3, times = "sigma_n_MPa" } # first values: 0.10337, 0.10171, 0.09619; a coefficient of friction
v_rel_mm_s = { column = 4, unit = "m/min" }  # first values: 20, 20, 20; in m/min, as answered
sigma_n_MPa = { column = 2, area_mm2 = 20 }  # the force over the area of contact, as the file or an answer gives it

[data.constants]
sigma_f_MPa = 480                            # for all rows, as answered

[output]
directory = "out"
)");
  expect_reads("3", "shear");
}

TEST_F(InteractiveInit, TakesATorqueAtARadiusAndAForceOverAnArea) {
  write_tests(2, "Zeit [s];Kraft;Drehmoment [Ncm];T1\n", 5, true); // at 50 mm
  const CommandResult asked = init("50\n1\n=15\nkN\n\n");
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_THAT(asked.err, HasSubstr("At which radius does friction act? Drehmoment [Ncm] is a "
                                   "torque, in Ncm.\n"));
  EXPECT_THAT(directory.read("job/job.toml"),
              AllOf(HasSubstr("\nF_R_N = { formula = \"0.01*Drehmoment/0.05\" }"),
                    HasSubstr("\nF_N_N = { column = \"Kraft\", unit = \"kN\" }"),
                    HasSubstr("\nsigma_n_MPa = 15 ")));
  EXPECT_EQ(init("50\nKraft\nKraft/20\nN\n\n").exit_code, 0);
  expect_reads("2", "coulomb");
}

TEST_F(InteractiveInit, AsksForTheFactorOfAVoltageAndTheRadiusOfARotation) {
  write_tests(2, "Time [s];Load [N];Friction [mV];Speed [rpm]\n", 2, true);
  const CommandResult asked = init("0.5\n/20\n\n15\n");
  EXPECT_EQ(asked.exit_code, 0) << asked.err;
  EXPECT_THAT(asked.err,
              AllOf(HasSubstr("How many newtons is one unit of Friction [mV]? It is a "
                              "voltage.\n"),
                    HasSubstr("At which radius is the contact? Speed [rpm] is a speed of "
                              "rotation.\n")));
  EXPECT_THAT(directory.read("job/job.toml"),
              AllOf(HasSubstr("\nF_R_N = { formula = \"Friction*0.5\" }"),
                    HasSubstr("\nv_rel_mm_s = { formula = \"Speed*2*pi/60*15\" }")));
  expect_reads("2", "coulomb");
}

TEST_F(InteractiveInit, TakesAForceWithoutANameOverAnArea) {
  write_tests(2, "Zeit [s];Kraft;Kanal 3;T1\n", 1, false);
  EXPECT_EQ(init("2\ncoefficient\n1/20\nN\n\n").exit_code, 0);
  EXPECT_THAT(directory.read("job/job.toml"),
              AllOf(HasSubstr("\ntau_R_MPa = { column = \"Kanal 3\", times = \"sigma_n_MPa\" }"),
                    HasSubstr("\nsigma_n_MPa = { column = \"Kraft\", area_mm2 = 20 }")));
  expect_reads("2", "coulomb");
}

TEST_F(InteractiveInit, FindsAColumnByItsNameInFilesWithOtherColumnsBesideIt) {
  write_tests(2, "Zeit [s];F_N [N];Kanal 3;T1\n", 1, false);
  directory.write("t1.csv",
                  "T1;Kanal 3;Zeit [s];F_N [N]\n5;0.1;0;100\n5;0.11;1;101\n5;0.1;2;103\n");
  EXPECT_EQ(init("Kanal 3\n3\n/20\n480\n").exit_code, 0);
  const std::string job = directory.read("job/job.toml");
  EXPECT_THAT(job, HasSubstr("\ntau_R_MPa = { column = \"Kanal 3\", times = "));
  EXPECT_EQ(job.find("Kanal 3", job.find("Kanal 3") + 1), job.npos) << job; // no rule of its own
  expect_reads("2", "coulomb");
}

TEST_F(InteractiveInit, AsksAgainForWhatCannotBeMeant) {
  write_tests(2, "Zeit [s];F_N;Kanal 3;T1\n", 1, false);
  const CommandResult asked =
      init("9\nKanal 4\nkanal 3\nforse\n3\n/0\n/x\n/20\nkilo\nkN\n-3\n480\n");
  EXPECT_EQ(asked.exit_code, 0);
  EXPECT_THAT(asked.err, AllOf(HasSubstr("  '9' is none of them: known: Kanal 3, T1\n"),
                               HasSubstr("  'Kanal 4' is none of them: did you mean 'Kanal 3'?\n"),
                               HasSubstr("  'forse' is none of them: did you mean 'force'?\n"),
                               HasSubstr("  '0' is not a number above 0\n"),
                               HasSubstr("  'x' is not a number above 0\n"),
                               HasSubstr("  'kilo' does not convert to N: known: N, "),
                               HasSubstr("  '-3' is not a number above 0\n"),
                               Not(HasSubstr("open question"))));
}

TEST_F(InteractiveInit, LeavesOpenWhatIsNotAnswered) {
  write_tests(1, "Zeit;F_N;Kanal 3;T1\n", 1, false);
  EXPECT_EQ(init("", "").exit_code, 0);
  const std::string without = directory.read("job/job.toml");
  EXPECT_THAT(without,
              HasSubstr("\n# ? Is Kanal 3 a coefficient of friction? Its numbers are as "
                        "small, and nothing else is friction.\n"
                        "# tau_R_MPa = { column = \"Kanal 3\", times = \"sigma_n_MPa\" }"));
  for (const char* const answers : {"", "\n", "\n\n\n\n\n\n\n\n\n\n", "  \n \t\n", "nonsense"}) {
    const CommandResult asked = init(answers);
    EXPECT_EQ(asked.exit_code, 0);
    EXPECT_EQ(directory.read("job/job.toml"), without) << answers;
    EXPECT_THAT(asked.err, HasSubstr("open question in job/job.toml: Is Kanal 3 a coefficient"));
  }
}

TEST_F(InteractiveInit, NeedsFilesToAskAbout) {
  const CommandResult alone = test::run_frictab({"init", "job", "--interactive"}, directory.path());
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_EQ(alone.err, "error: --interactive has no files to ask about\n"
                       "  hint: frictab init DIR --interactive --from FILES\n");
}

} // namespace
} // namespace frictab::interactive_init_test
