// Layouts of rigs' files beyond a line of names over rows: conditions above the rows, tests side by
// side, lines between the units and the rows. SYNTHETIC numbers.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"
#include "support/run_command.h"
#include "support/workbook.h"

namespace frictab::rig_layouts_test {
namespace {

using test::CommandResult;
using testing::AllOf;
using testing::HasSubstr;

class RigLayouts : public testing::Test {
protected:
  // Rows of one test at 0.1 s: time and coefficient.
  static std::string rows(int test, int count = 25) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += fmt::format("{:.1f}\t{:.4f}\n", 0.1 * i, 0.1 + 0.003 * std::sin(1.3 * i + test));
    return text;
  }

  void write_job(const std::string& data) const {
    directory.write("job.toml", data + "\n[output]\ndirectory = \"out\"\n");
  }
  CommandResult data(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"data", "job.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_frictab(arguments, directory.path());
  }
  std::string guessed(const std::string& files) const {
    const CommandResult init =
        test::run_frictab({"init", "job", "--force", "--from", files}, directory.path());
    EXPECT_EQ(init.exit_code, 0) << init.err;
    return directory.read("job/job.toml");
  }

  test::TemporaryDirectory directory;
};

TEST_F(RigLayouts, ConditionsAboveTheRowsAreColumnsWhereTheJobNamesThem) {
  for (int test = 1; test <= 4; ++test)
    directory.write(fmt::format("t{}.txt", test),
                    fmt::format("Normal load\t{} [N]\nTribometer 3\nOil:\tA{}\nDisc speed = {} "
                                "cm/s\nRadius [mm]: 10\n\nTime [s]\tmu\n",
                                5 * test, test % 2, test) +
                        rows(test));
  write_job(R"([data]
training = "t*.txt"
above = ["Oil"]
[data.columns]
time_s = "Time"
F_N_N = "Normal load"
sigma_n_MPa = { column = "Normal load", area_mm2 = 0.05 }
tau_R_MPa = { column = "mu", times = "sigma_n_MPa" }
v_rel_mm_s = "Disc speed"
s_mm = { formula = "Radius*time_s", unit = "mm" })");
  const CommandResult read = data();
  ASSERT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(
      read.out,
      AllOf(HasSubstr("  t1    train    25    0.100             -  0 to 2.4          100          "
                      "10  0 to 24"),
            HasSubstr("  t4    train    25   0.0999             -  0 to 2.4          400          "
                      "40  0 to 24"),
            HasSubstr("  Oil          label  2 levels\n"),
            HasSubstr("read: from lines above the rows: Normal load, Oil, Disc speed, Radius "
                      "[mm]\n")));
}

TEST_F(RigLayouts, AConditionThatNoLineGivesIsAnErrorWithTheNearestName) {
  directory.write("t1.txt", "Oil: A\nLoad: 5 N\ntime_s\tmu\n" + rows(1));
  const std::string job = "[data]\ntraining = \"t1.txt\"\nabove = [\"Oill\"]\n[data.columns]\n"
                          "sigma_n_MPa = { column = \"Load\", area_mm2 = 1 }\n"
                          "tau_R_MPa = { column = \"mu\", times = \"sigma_n_MPa\" }\n";
  write_job(job);
  EXPECT_THAT(data().err, HasSubstr("t1.txt:3: error: no line above the rows gives 'Oill' "
                                    "(data.above)\n  hint: did you mean 'Oil'?\n"));
  write_job(replace_all(job, "Oill", "Oil"));
  EXPECT_EQ(data().exit_code, 0);
  // A unit of another dimension is a fault as in a column.
  directory.write("t1.txt", "Oil: A\nLoad: 5 mm\ntime_s\tmu\n" + rows(1));
  EXPECT_THAT(data().err, HasSubstr("'mm'"));
  EXPECT_EQ(data().exit_code, 2);
}

TEST_F(RigLayouts, AColumnOfTheFileGoesBeforeALineAboveIt) {
  directory.write("t1.txt",
                  "sigma_n_MPa: 7\ntime_s\tmu\tsigma_n_MPa\n0\t0.1\t3\n1\t0.2\t3\n2\t0.1\t"
                  "3\n");
  write_job("[data]\ntraining = \"t1.txt\"\n[data.columns]\n"
            "tau_R_MPa = { column = \"mu\", times = \"sigma_n_MPa\" }\n");
  EXPECT_THAT(data().out, HasSubstr("            3  0.3 to 0.6"));
}

TEST_F(RigLayouts, TestsSideBySideAreATestEach) {
  std::string text = "Block 1;;;Block 2;;\np [MPa];COF;;p [MPa];COF;\n";
  for (int i = 0; i < 30; ++i)
    text +=
        fmt::format("{};{:.4f};;", 100 + i, 0.1 + 0.003 * std::sin(1.3 * i)) +
        (i < 20 ? fmt::format("{};{:.4f};\n", 200 + i, 0.12 + 0.003 * std::sin(1.7 * i)) : ";;\n");
  directory.write("side.csv", text);
  const std::string job = guessed("side.csv");
  EXPECT_THAT(job,
              AllOf(HasSubstr("\nexperiment = \"columns\" "), HasSubstr("\nsigma_n_MPa = \"p\" "),
                    HasSubstr("\ntau_R_MPa = { column = \"COF\", times = \"sigma_n_MPa\" }")));
  const CommandResult read = test::run_frictab({"data", "job/job.toml"}, directory.path());
  ASSERT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(read.out, AllOf(HasSubstr("  side Block 1  train    30    0.100 "),
                              HasSubstr("  side Block 2  train    20    0.120 "),
                              HasSubstr("read: tests side by side: 2 tests, 50 rows\n")));
}

TEST_F(RigLayouts, TestsSideBySideInAWorkbookHaveTheNamesOfTheMergedCells) {
  std::string cells = "V1;;V2;\np [MPa];mu;p [MPa];mu\n";
  for (int i = 0; i < 12; ++i)
    cells += fmt::format("{};{:.3f};{};{:.3f}\n", 100 + i, 0.1 + 0.001 * (i % 3), 300 + i,
                         0.11 + 0.001 * (i % 4));
  test::write_workbook(
      directory.path("book.xlsx"),
      {{{"Sheet1", test::xml_rows(cells),
         "<mergeCells><mergeCell ref=\"A1:B1\"/><mergeCell ref=\"C1:D1\"/></mergeCells>"}}});
  write_job("[data]\ntraining = \"book.xlsx\"\nexperiment = \"columns\"\n[data.columns]\n"
            "sigma_n_MPa = \"p\"\ntau_R_MPa = { column = \"mu\", times = \"sigma_n_MPa\" }\n");
  EXPECT_THAT(data().out, AllOf(HasSubstr("\n  book V1  train    12 "),
                                HasSubstr("\n  book V2  train    12 ")));
}

TEST_F(RigLayouts, UnequalRunsOfColumnsAreNotTakenForTests) {
  const std::string job = "[data]\ntraining = \"a.csv\"\nexperiment = \"columns\"\n[data.columns]\n"
                          "tau_R_MPa = \"mu\"\nsigma_n_MPa = \"p\"\n";
  write_job(job);
  const std::pair<const char*, const char*> cases[] = {
      {"p;mu;p;tau\n1;2;3;4\n", "test '1' has the columns mu, p, test '2' p, tau"},
      {"p;mu\n1;2\n", "no column 'p' comes again"},
      {"p;mu;mu\n1;2;3\n", "column 'mu' comes twice before 'p' comes again"}};
  for (const auto& [text, message] : cases) {
    directory.write("a.csv", text);
    const CommandResult refused = data();
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr(std::string("a.csv:1: error: ") + message)) << refused.err;
  }
}

TEST_F(RigLayouts, LinesOfTextsBelowTheUnitsArePassedAndCounted) {
  const std::string head = "CATMAN\nDatum:\t12.03.2021\n\nZeit\tp\tmu\nSekunde\tMPa\t-\n";
  const auto text = [&](const std::string& between) {
    std::string out = head + between;
    for (int i = 0; i < 12; ++i)
      out += fmt::format("{:.1f}\t{}\t{:.3f}\n", 0.1 * i, 100 + i, 0.1 + 0.001 * (i % 3));
    return out;
  };
  directory.write("a.asc", text("MX840B 0\tMX840B 1\tMX840B 2\n"));
  const std::string job = guessed("a.asc");
  EXPECT_THAT(job, AllOf(HasSubstr("\nunits_row = true "), HasSubstr("\ntime_s = \"Zeit\" "),
                         HasSubstr("\nsigma_n_MPa = \"p\" ")));
  const CommandResult read = test::run_frictab({"data", "job/job.toml"}, directory.path());
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(read.out, AllOf(HasSubstr("read: lines of words below the units, not read: 1\n"),
                              HasSubstr("  12  ")));
  // Comments are not given for each column.
  directory.write("a.asc", text("A\t\tB\n"));
  EXPECT_THAT(test::run_frictab({"data", "job/job.toml"}, directory.path()).out,
              HasSubstr("read: lines of words below the units, not read: 1\n"));
  // Units twice may mean something else.
  directory.write("a.asc", text("s\tMPa\t1\n"));
  EXPECT_EQ(test::run_frictab({"data", "job/job.toml"}, directory.path()).exit_code, 2);
}

TEST_F(RigLayouts, AFileThatIsNotThereIsReportedAtTheLineOfTheJob) {
  directory.write("t.csv", "experiment,sigma_n_MPa,tau_R_MPa\nA,100,10\nA,101,11\n");
  directory.write("plan.csv", "experiment,oil\nA,dry\n");
  const auto refusal = [&](const std::string& keys) {
    directory.write("job.toml", "[data]\n" + keys);
    const CommandResult result = test::run_frictab({"data", "job.toml"}, directory.path());
    EXPECT_EQ(result.exit_code, 2) << keys;
    return result.err;
  };
  EXPECT_THAT(refusal("training = \"t.csv\"\ntests = \"plann.csv\"\n"),
              AllOf(HasSubstr("job.toml:3:9: error: data.tests: no such file: 'plann.csv'"),
                    HasSubstr("did you mean 'plan.csv'?")));
  EXPECT_THAT(refusal("training = [\"t.csv\", \"tt.csv\"]\n"),
              HasSubstr("job.toml:2:22: error: data.training: no such file: 'tt.csv'"));
}

TEST_F(RigLayouts, CellsThatMayBeMergedAreAQuestionOfInit) {
  std::string text = "Test;Oil;Stress [MPa];Friction [MPa]\n";
  for (int test = 0; test < 4; ++test)
    for (int row = 0; row < 5; ++row)
      text += fmt::format("T{};{};{};{:.1f}\n", test, row == 0 ? (test % 2 ? "PAO" : "dry") : "",
                          100 + row, 10 + test + 0.1 * row);
  directory.write("a.csv", text);
  EXPECT_THAT(guessed("a.csv"), HasSubstr("# fill_down = \"Oil\"\n"));
}

// What init proposes for one file is read as it is.
TEST_F(RigLayouts, InitReadsHeadersBehindACommentSignCommasInQuotesFootersAndClocks) {
  const auto text = [](const std::string& header, const char* row, const std::string& footer) {
    std::string out = header;
    for (int i = 0; i < 20; ++i)
      out += fmt::format(fmt::runtime(row), fmt::arg("t", 0.5 * i), fmt::arg("s", i % 60),
                         fmt::arg("p", 100.0 + i), fmt::arg("mu", 0.1 + 0.001 * (i % 4)),
                         fmt::arg("tau", (100 + i) * (0.1 + 0.001 * (i % 4))));
    return out + footer;
  };
  const struct {
    const char* file;
    std::string text;
    std::vector<const char*> lines;
  } cases[] = {
      {"savetxt.dat",
       text("# shear test\n#  t(s)  sigma_n(MPa)  tau(MPa)\n", "{t:8.2f} {p:9.1f} {tau:9.4f}\n",
            ""),
       {"time_s = \"t\"", "sigma_n_MPa = \"sigma_n\"", "tau_R_MPa = \"tau\""}},
      {"sign.csv",
       text("#time [s],pressure [MPa],mu\n", "{t:.2f},{p},{mu:.4f}\n", ""),
       {"time_s = \"time\"", "sigma_n_MPa = \"pressure\""}},
      {"quotes.csv",
       text("\"Zeit [s]\",\"Druck [MPa]\",\"Reibwert\"\n", "\"{s},50\",\"{p},25\",\"0,1{s:02}\"\n",
            ""),
       {"decimal = \",\"", "time_s = \"Zeit\"", "sigma_n_MPa = \"Druck\""}},
      {"footer.csv",
       text("time [s];p [MPa];mu\n", "{t:.2f};{p};{mu:.4f}\n",
            "\nMean;;0.1015\nStd;;0.001\n;;\nEnd of test\n"),
       {"skip_footer = 5", "sigma_n_MPa = \"p\""}},
      {"clock.csv",
       text("Time;p [MPa];mu\n", "10:00:{s:02}.250;{p};{mu:.4f}\n", ""),
       {"time_s = \"Time\"                              # first values: 10:00:00.250, "
        "10:00:01.250, 10:00:02.250; seconds since the first\n"}},
      {"greek.csv",
       text("t/s;σN/MPa;τR/MPa\n", "{t:.2f};{p};{tau:.4f}\n", ""),
       {"sigma_n_MPa = \"σN\"", "tau_R_MPa = \"τR\""}},
  };
  for (const auto& one : cases) {
    directory.write(one.file, one.text);
    const std::string job = guessed(one.file);
    for (const char* const line : one.lines)
      EXPECT_THAT(job, HasSubstr(std::string("\n") + line)) << one.file;
    const CommandResult read = test::run_frictab({"data", "job/job.toml"}, directory.path());
    EXPECT_EQ(read.exit_code, 0) << one.file << read.err;
    EXPECT_THAT(read.out, HasSubstr("  train    20 ")) << one.file;
  }
}

TEST_F(RigLayouts, CyclesAndPositionsAreNotTakenForTests) {
  std::string text = "Cycle\tPosition (mm)\tFriction Force (N)\tNormal Load (N)\n";
  for (int i = 0; i < 200; ++i)
    text += fmt::format("{}\t{:.3f}\t{:.1f}\t30\n", 1 + i / 20, 2 * std::sin(0.314159 * i),
                        i % 20 < 10 ? 3.0 : -3.0);
  directory.write("cycles.txt", text);
  EXPECT_THAT(guessed("cycles.txt"), testing::Not(HasSubstr("experiment = \"row\"")));
}

TEST_F(RigLayouts, InitProposesConditionsAboveTheRowsThatDifferBetweenFiles) {
  for (int test = 1; test <= 4; ++test)
    directory.write(
        fmt::format("t{}.txt", test),
        fmt::format("File: t{}.dat\nPressure: 10 MPa\nRoughness Ra: 0.{} um\nLubricant: "
                    "{}\nOperator: N. N.\n\nTime [s]\tmu\n",
                    test, test, test % 2 ? "A" : "B") +
            rows(test));
  EXPECT_THAT(guessed("t*.txt"),
              AllOf(HasSubstr("\nabove = [\"Lubricant\", \"Roughness Ra\"] "),
                    HasSubstr("\nsigma_n_MPa = \"Pressure\" "),
                    HasSubstr("\n# above the rows, kept where data.above names them: File, "
                              "Operator\n")));
  const CommandResult read = test::run_frictab({"data", "job/job.toml"}, directory.path());
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(read.out, AllOf(HasSubstr("  Lubricant     label    2 levels\n"),
                              HasSubstr("  Roughness Ra  setting  one value per test")));
}

TEST_F(RigLayouts, HeadersThatComeAgainAreOneWayToNameTests) {
  std::string text;
  for (int step = 1; step <= 3; ++step) {
    text += fmt::format("Step {}\nRolling Speed (mm/s)\tSliding Speed (mm/s)\tTraction Coeff (-)\t"
                        "Ball Load (N)\n",
                        step);
    for (int i = 0; i < 20; ++i)
      text += fmt::format("{}\t{}\t{:.4f}\t{}\n", 3000 - 140 * (i / 4), 1500 - 70 * (i / 4),
                          0.05 + 0.001 * (i % 5), 20 + i % 2);
  }
  directory.write("steps.txt", text);
  const std::string job = guessed("steps.txt");
  EXPECT_THAT(job, AllOf(HasSubstr("\nexperiment = \"interval\""),
                         testing::Not(HasSubstr("experiment = \"row\"")),
                         HasSubstr("\nv_rel_mm_s = \"Sliding Speed\"")));
}

TEST_F(RigLayouts, InitProposesWhatStandsForNoValue) {
  std::string text = "time_s,load_kgf,torque_Nm\n";
  for (int i = 0; i < 30; ++i)
    text += fmt::format("{:.1f},{},{}\n", 0.1 * i, 100 + i % 3,
                        i == 7 ? std::string("-9999") : fmt::format("{:.3f}", 2 + 0.01 * (i % 5)));
  directory.write("m.csv", text);
  EXPECT_THAT(guessed("m.csv"),
              AllOf(HasSubstr("\nmissing_values = \"-9999\" "), HasSubstr("\nmissing = \"drop\" "),
                    HasSubstr("\nF_N_N = { column = \"load_kgf\", unit = \"kgf\" }")));
  const std::string columns =
      "[data.columns]\nF_N_N = { column = \"load_kgf\", unit = \"kgf\" }\n"
      "sigma_n_MPa = { column = \"load_kgf\", unit = \"kgf\", area_mm2 = 50 }\n"
      "F_R_N = { formula = \"torque_Nm/0.02\", unit = \"N\" }\n";
  const std::string head = "[data]\ntraining = \"m.csv\"\nmissing_values = [\"-9999\"]\n";
  write_job(head + "missing = \"drop\"\n" + columns);
  EXPECT_THAT(data().out, HasSubstr("left out: 1 row, an empty cell"));
  write_job(head + columns);
  EXPECT_THAT(data().err, HasSubstr("m.csv:9: error: torque_Nm is empty here, which the formula of "
                                    "F_R_N needs\n  hint: repair it, or data.missing = \"drop\" "
                                    "leaves such rows out\n"));
}

TEST_F(RigLayouts, InitAsksWherePointsMayStandBetweenThousands) {
  std::string text = "t [s];Normalkraft [N];Reibkraft [N]\n";
  for (int i = 0; i < 20; ++i)
    text += fmt::format("{};16.{};1.{}\n", i, 317 + i, 629 + i % 3);
  directory.write("g.csv", text);
  EXPECT_THAT(guessed("g.csv"), HasSubstr("\n# ? Is 16.317 meant as 16317? Every point stands "
                                          "before three digits, as between thousands.\n# decimal = "
                                          "\",\"\n# thousands = \".\"\n"));
  directory.write("g.csv", text + "20;16.5;1.6\n");
  EXPECT_THAT(guessed("g.csv"), testing::Not(HasSubstr("meant as")));
}

TEST_F(RigLayouts, NamesOfRowsAsRWritesThemAreAColumn) {
  std::string text = "\"time\" \"p\" \"tau\" \"oil\"\n";
  for (int i = 0; i < 20; ++i)
    text += fmt::format("\"{}\" {:.1f} {} {:.3f} \"dry\"\n", i + 1, 0.1 * i, 100 + i % 3,
                        10 + 0.01 * (i % 5));
  directory.write("r.txt", text);
  EXPECT_THAT(guessed("r.txt"),
              AllOf(HasSubstr("\ntime_s = \"time\""), HasSubstr("\nsigma_n_MPa = \"p\""),
                    HasSubstr("\ntau_R_MPa = \"tau\"")));
  directory.write("comma.csv", "time,F\n1,1,5\n2,2,5\n"); // decimal commas
  write_job("[data]\ntraining = \"comma.csv\"\n");
  EXPECT_THAT(data().err, HasSubstr("comma.csv:2: error: 3 cells, the header has 2"));
}

TEST_F(RigLayouts, ATableOfTestsIsFoundByTheNamesInOneFileOfAllTests) {
  std::string all = "testNo,timestamp,sigma_n_MPa,tau_R_MPa\n";
  for (int i = 0; i < 60; ++i)
    all += fmt::format("{},12-Mar-2021 10:{:02}:01.500,{},{:.2f}\n", 1 + i / 20, i % 20,
                       100 + i % 3, 10 + 0.1 * (i % 5));
  directory.write("all.csv", all);
  directory.write("info.csv", "testNo,Ra_um\n1,0.3\n2,0.9\n3,0.5\n");
  EXPECT_THAT(guessed("*.csv"), AllOf(HasSubstr("\ntests = \"../info.csv\""),
                                      HasSubstr("\ntraining = \"../all.csv\""),
                                      HasSubstr("\ntime_s = \"timestamp\"")));
  const CommandResult read = test::run_frictab({"data", "job/job.toml"}, directory.path());
  EXPECT_THAT(read.out, HasSubstr("Ra_um"));
  directory.write("info.csv", "ID,Ra_um\n1,0.3\n2,0.9\n3,0.5\n");
  EXPECT_THAT(guessed("*.csv"), HasSubstr("\nexperiment = [\"testNo\", \"ID\"] "));
  EXPECT_EQ(test::run_frictab({"data", "job/job.toml"}, directory.path()).exit_code, 0);
}

TEST_F(RigLayouts, ALogBookIsJoinedByNumbersOnlyWhereNamesAgree) {
  const std::string head = "time_s\tmu\n";
  for (int test = 1; test <= 3; ++test)
    directory.write(fmt::format("Al_{}.txt", test), head + rows(test));
  const std::string job =
      "[data]\ntraining = \"Al_*.txt\"\ntests = \"log.csv\"\nexperiment = \"file\"\n"
      "[data.columns]\nexperiment = \"ID\"\n"
      "tau_R_MPa = { column = \"mu\", times = \"sigma_n_MPa\" }\n"
      "[data.constants]\nsigma_n_MPa = 10\n";
  write_job(job);
  directory.write("log.csv", "ID,Ra_um\nSteel_1,0.5\nSteel_2,0.7\nSteel_3,0.9\n");
  EXPECT_THAT(data().err, HasSubstr("test 'Al_1' of Al_1.txt is not in this table"));
  directory.write("log.csv", "ID,Ra_um\nVersuch 01 (al),0.5\nVersuch 02 (al),0.7\nV03,0.9\n");
  EXPECT_THAT(data().out, HasSubstr("tests are found by the numbers in their names"));
}

TEST_F(RigLayouts, InitAsksWhetherColumnsOfFrictionAreATestEach) {
  std::string text = "Time [s];mu T1 dry;mu T2 oil;mu T3 oil\n";
  for (int i = 0; i < 20; ++i)
    text += fmt::format("{:.1f};{:.3f};{:.3f};{:.3f}\n", 0.1 * i, 0.2, 0.1 + 0.001 * (i % 5), 0.11);
  directory.write("wide.csv", text);
  EXPECT_THAT(guessed("wide.csv"),
              AllOf(HasSubstr("\n# ? Is each of the 3 columns like mu T1 dry a test?"),
                    HasSubstr("\n# columns = \"^mu (?<experiment>.+)\"\n")));
}

TEST_F(RigLayouts, RolesAreGivenToColumnsByTheNamesOfTheFile) {
  directory.write("t1.txt", "time_s\tmu\tCup height H1/H2 [mm]\n0\t0.1\t3\n1\t0.2\t4\n2\t0.1\t5\n");
  write_job("[data]\ntraining = \"t1.txt\"\n[data.columns]\n"
            "tau_R_MPa = { column = \"mu\", times = \"sigma_n_MPa\" }\n[data.constants]\n"
            "sigma_n_MPa = 10\n[data.roles]\n\"Cup height H1/H2 [mm]\" = \"response\"\n");
  const CommandResult read = data();
  EXPECT_EQ(read.exit_code, 0) << read.err;
  EXPECT_THAT(read.out, HasSubstr("Cup height H1/H2 [mm] belongs to the measured friction"));
}

TEST_F(RigLayouts, InitFindsTheLoadAndTheSpeedAboveTheRows) {
  for (int test = 1; test <= 3; ++test)
    directory.write(fmt::format("t{}.txt", test),
                    fmt::format("Normal load\t{} [N]\nSample\tC45\nSliding speed\t20 [mm/s]\n"
                                "Sample rate\t10\n\nTime [s]\tmu\n",
                                5 * test) +
                        rows(test));
  const std::string job = guessed("t*.txt");
  EXPECT_THAT(
      job, AllOf(HasSubstr("\nF_N_N = \"Normal load\"                        # above the rows: 5 "
                           "[N]; in N, as the file says\n"),
                 HasSubstr("\nv_rel_mm_s = \"Sliding speed\" "),
                 HasSubstr("\n# above the rows, kept where data.above names them: Sample, Sample "
                           "rate\n"),
                 HasSubstr("\n# sigma_n_MPa = { column = \"Normal load\", area_mm2 = 78.5 }")));
}

} // namespace
} // namespace frictab::rig_layouts_test
