// "frictab init --from": a job file guessed from a lab's files, used with nothing edited.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/program.h"
#include "core/text.h"
#include "support/encoding.h"
#include "support/json.h"
#include "support/run_command.h"
#include "support/workbook.h"

namespace frictab::init_from_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using test::utf16;
using testing::HasSubstr;
using testing::Not;

constexpr int rows_per_test = 30;

// One row of a test that nobody would find odd; F_N over 20 mm2.
struct Row {
  double time_s, sigma_MPa, mu;
  double F_N() const { return 20 * sigma_MPa; }
  double F_R() const { return mu * F_N(); }
};

std::vector<Row> rows(int test) {
  std::vector<Row> out;
  for (int i = 0; i < rows_per_test; ++i)
    out.push_back({0.1 * i, 100.0 * test + 5 * i,
                   0.1 + 0.01 * (test % 3) + 0.002 * std::sin(1.7 * i + test)});
  return out;
}

// "1.234,50", as a German rig writes.
std::string german(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text[text.size() - 3] = ',';
  if (text.size() > 6) text.insert(text.size() - 6, ".");
  return text;
}

// "Time [s];COF;Pressure [MPa]".
std::string coefficient_file(int test) {
  std::string text = "Time [s];COF;Pressure [MPa]\n";
  for (const Row& row : rows(test))
    text += fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu, row.sigma_MPa);
  return text;
}

// Four tests, each below a header of its own, in kPa.
std::string shear_cell() {
  std::string text;
  for (int test = 1; test <= 4; ++test) {
    text += fmt::format("Interval;{}\n\nTime;Shear stress;Normal stress\n[s];[kPa];[kPa]\n", test);
    for (const Row& row : rows(test))
      text +=
          fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu * row.sigma_MPa, row.sigma_MPa);
  }
  return text;
}

class InitFrom : public testing::Test {
protected:
  CommandResult frictab(const std::vector<std::string>& arguments) const {
    return run_frictab(arguments, directory.path());
  }

  // The job file that is guessed, which asks nothing that must be answered.
  std::string job_from(const std::vector<std::string>& files) const {
    std::vector<std::string> arguments = {"init", "job", "--from"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    const CommandResult result = frictab(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "job/job.toml\n");
    return result.exit_code == 0 ? directory.read("job/job.toml") : "";
  }

  // As it is read and calibrated with nothing edited: "K1 30, K2 30", and the text of frictab data.
  struct Read {
    std::string tests, text;
  };
  Read read() const {
    const CommandResult data = frictab({"data", "job/job.toml", "--json", "-q"});
    EXPECT_EQ(data.exit_code, 0) << data.err;
    if (data.exit_code != 0) return {};
    std::vector<std::string> tests;
    const auto json = nlohmann::json::parse(data.out);
    for (const auto& test : json["tests"])
      tests.push_back(
          fmt::format("{} {}", test["experiment"].get<std::string>(), test["rows"].get<int>()));
    std::sort(tests.begin(), tests.end());
    const CommandResult fit =
        frictab({"calibrate", "job/job.toml", "-q", "--set", "models.use=[\"coulomb\"]"});
    EXPECT_EQ(fit.exit_code, 0) << fit.err;
    return {join(tests, ", "), frictab({"data", "job/job.toml", "-q"}).out};
  }

  TemporaryDirectory directory;
};

// ---- files of one dialect ----

TEST_F(InitFrom, TakesCanonicalNamesAsTheyAre) {
  std::string text = "experiment,time_s,sigma_n_MPa,v_rel_mm_s,tau_R_MPa,sigma_f_MPa,room_C\n";
  for (int test = 1; test <= 4; ++test)
    for (const Row& row : rows(test))
      text += fmt::format("K{},{:.1f},{:.1f},{},{:.3f},900,21\n", test, row.time_s, row.sigma_MPa,
                          50 * test, row.mu * row.sigma_MPa);
  directory.write("a.csv", text);
  EXPECT_EQ(
      job_from({"a.csv"}),
      R"(# Guessed from the files; every line may be wrong. frictab data shows what is read with it,
# frictab explain job what else there is.

[data]
training = "../a.csv"                        # 1 file

[data.columns]
# known by their names: experiment, time_s, sigma_n_MPa, v_rel_mm_s, tau_R_MPa, sigma_f_MPa
# kept as recorded; what changes friction may be among them: room_C

[output]
directory = "out"
)");
  EXPECT_EQ(read().tests, "K1 30, K2 30, K3 30, K4 30");
}

TEST_F(InitFrom, FindsDecimalCommasPreamblesUnitsAndGroupsOfDigits) {
  for (int test = 1; test <= 4; ++test) {
    std::string text = "Pr\xFC"
                       "fstand 7;Labor S\xFC"
                       "d\nDatum;12.03.2024\nBediener;N, N\n\n"
                       "Normalkraft [kN];Reibkraft [N];Zeit [s];Normalspannung [MPa]\n";
    for (const Row& row : rows(9 + test))
      text += fmt::format("{};{};{};{}\n", german(row.F_N() / 1000), german(row.F_R()),
                          german(row.time_s), german(row.sigma_MPa));
    directory.write(fmt::format("rig/versuch_{}.csv", test), text);
  }
  const std::string job = job_from({"rig"});
  EXPECT_THAT(job, HasSubstr(R"(
training = "../rig/*.csv"                    # 4 files
decimal = ","                                # more cells are numbers than with a point
thousands = "."                              # digits stand in groups of three
experiment = "file"                          # no column names the tests: each file is one

[data.columns]
F_N_N = "Normalkraft"                        # first values: 20, 20.1, 20.2; in kN, as the file says
)"));
  EXPECT_THAT(job, Not(HasSubstr("[[data.files]]"))) << "all are read alike";
  const Read found = read();
  EXPECT_EQ(found.tests, "versuch_1 30, versuch_2 30, versuch_3 30, versuch_4 30");
  EXPECT_THAT(found.text, HasSubstr("1,300 to 1,445")) << found.text;
}

TEST_F(InitFrom, SkipsAPreambleThatHoldsNamesOfColumnsItself) {
  // The time of a test is no header; three names may be.
  for (const auto& [preamble, skipped] : std::map<std::string, bool>{
           {"Zeit;12:30 Uhr\n", false}, {"Zeit;Druck [MPa];Reibwert;Regler\n", true}}) {
    for (int test = 1; test <= 3; ++test) {
      std::string text = preamble + "Zeit;Reibwert;Druck [MPa]\n";
      for (const Row& row : rows(test))
        text += fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu, row.sigma_MPa);
      directory.write(fmt::format("{}.csv", test), text);
    }
    const std::string job = job_from({"1.csv", "2.csv", "3.csv", "--force"});
    EXPECT_EQ(job.find("\nskip_rows = 1 ") != job.npos, skipped) << job;
    EXPECT_EQ(read().tests, "1 30, 2 30, 3 30");
  }
}

TEST_F(InitFrom, FindsALineOfUnitsAndAColumnThatNamesTests) {
  std::string text = "Test,Time,Load,Friction force,Contact pressure\n,s,kN,N,MPa\n";
  for (int test = 1; test <= 4; ++test)
    for (const Row& row : rows(test))
      text += fmt::format("{},{:.1f},{:.4f},{:.3f},{:.1f}\n", test, row.time_s, row.F_N() / 1000,
                          row.F_R(), row.sigma_MPa);
  directory.write("a.csv", text);
  const std::string job = job_from({"a.csv"});
  EXPECT_THAT(job, HasSubstr("\nunits_row = true "));
  EXPECT_THAT(job, HasSubstr("\nexperiment = \"Test\" "));
  EXPECT_THAT(job, HasSubstr("first values: 2, 2.1, 2.2; in kN, as the file says"));
  const Read found = read();
  EXPECT_EQ(found.tests, "1 30, 2 30, 3 30, 4 30");
  EXPECT_THAT(found.text, HasSubstr("F_N_N: kN in the file, converted to N"));
}

TEST_F(InitFrom, TakesAHeaderThatComesAgainForTheNextTest) {
  directory.write("cell.csv", shear_cell());
  const std::string job = job_from({"cell.csv"});
  EXPECT_THAT(job, HasSubstr("\nexperiment = \"interval\" "));
  EXPECT_THAT(job, HasSubstr("in kPa, as the file says"));
  EXPECT_EQ(read().tests, "cell 1 30, cell 2 30, cell 3 30, cell 4 30");
}

TEST_F(InitFrom, ReadsUtf16WithTabs) {
  directory.write("cell.txt",
                  utf16(replace_all(replace_all(shear_cell(), ";", "\t"), "\n", "\r\n")));
  job_from({"cell.txt"});
  EXPECT_EQ(read().tests, "cell 1 30, cell 2 30, cell 3 30, cell 4 30");
}

TEST_F(InitFrom, TakesACoefficientTimesThePressure) {
  std::string text = "Sample,Elapsed time (s),Friction coefficient,Contact pressure (MPa),"
                     "Sliding speed (m/s)\n";
  for (int test = 1; test <= 4; ++test)
    for (const Row& row : rows(test))
      text += fmt::format("S{},{:.1f},{:.4f},{:.1f},{}\n", test, row.time_s, row.mu, row.sigma_MPa,
                          0.05 * test);
  directory.write("a.csv", text);
  EXPECT_THAT(job_from({"a.csv"}), HasSubstr("\ntau_R_MPa = { column = \"Friction coefficient\", "
                                             "times = \"sigma_n_MPa\" } "));
  const Read found = read();
  EXPECT_EQ(found.tests, "S1 30, S2 30, S3 30, S4 30");
  EXPECT_THAT(found.text, HasSubstr("v_rel_mm_s: m/s in the file, converted to mm/s"));
}

// ---- what names say ----

TEST_F(InitFrom, FindsConditionsInTheNamesOfFiles) {
  int test = 0;
  for (const char* steel : {"316SS", "52100"})
    for (const int radius : {5, 20, 100})
      for (const int repeat : {1, 2})
        directory.write(fmt::format("raw_data/{}_{}mm_r{}.csv", steel, radius, repeat),
                        coefficient_file(++test));
  EXPECT_THAT(job_from({"raw_data"}), HasSubstr(R"(
[[data.files]]
match = "*"
from_name = '(?<name1>[^_ /-]+)_(?<x2_mm>[\d.,]+)mm_(?<repeat>[^_ /-]+)\.csv$'
# name1: 316SS, 52100
# x2_mm: 5, 20, 100
# repeat: r1, r2
# Give the groups names that say what they are; one without a meaning may go.
)"));
  EXPECT_THAT(read().text, HasSubstr("from the names name1 (2: 316SS, 52100), repeat (2: r1, r2), "
                                     "x2_mm (3: 100, 20, 5)"));
}

TEST_F(InitFrom, KeepsAConditionThatDiffersInAllFiles) {
  for (const int load : {20, 50, 100})
    directory.write(fmt::format("pin_{}N.csv", load), coefficient_file(1 + load / 20));
  EXPECT_THAT(job_from({"pin_*.csv"}), HasSubstr("from_name = 'pin_(?<x2_N>[\\d.,]+)N\\.csv$'\n"
                                                 "# x2_N: 20, 50, 100\n"));
  EXPECT_EQ(read().tests, "pin_100N 30, pin_20N 30, pin_50N 30");
}

TEST_F(InitFrom, LeavesNamesAloneThatOnlyTellTheTestsApart) {
  for (int test = 1; test <= 3; ++test)
    directory.write(fmt::format("K{}_raw.csv", test), coefficient_file(test));
  EXPECT_THAT(job_from({"K1_raw.csv", "K2_raw.csv", "K3_raw.csv"}), Not(HasSubstr("from_name")));
  EXPECT_EQ(read().tests, "K1_raw 30, K2_raw 30, K3_raw 30");
}

TEST_F(InitFrom, FindsConditionsInTheNamesOfFolders) {
  int test = 0;
  for (const char* filler : {"0pct", "2.5pct", "10pct"})
    for (const int repeat : {1, 2})
      directory.write(fmt::format("rig/{}/test {}.csv", filler, repeat), coefficient_file(++test));
  const std::string job = job_from({"rig/*/*.csv"});
  EXPECT_THAT(job, HasSubstr("training = \"../rig/*/*.csv\""));
  EXPECT_THAT(job, HasSubstr("from_name = '(?<folder_pct>[\\d.,]+)pct/test "
                             "(?<repeat>[^_ /-]+)\\.csv$'\n# folder_pct: 0, 2.5, 10\n"));
  EXPECT_EQ(read().tests, "0pct/test 1 30, 0pct/test 2 30, 10pct/test 1 30, 10pct/test 2 30, "
                          "2.5pct/test 1 30, 2.5pct/test 2 30");
}

TEST_F(InitFrom, NamesNoFilesThatARunWritesBesideTheData) {
  for (const char* file : {"dry/1.csv", "dry/2.csv", "oil/1.csv", "oil/2.csv"})
    directory.write(file, coefficient_file(1));
  ASSERT_EQ(frictab({"init", "--from", "dry", "oil"}).exit_code, 0);
  EXPECT_THAT(directory.read("job.toml"), HasSubstr("\ntraining = [\"dry/*.csv\", \"oil/*.csv\"] "))
      << "*/*.csv would find out/*.csv";
}

// ---- files of several dialects ----

TEST_F(InitFrom, GivesARuleToEachFileThatIsReadInAnotherWay) {
  directory.write("1.csv", "Rig 2\nZeit [s];Normalkraft [kN];Reibkraft [N];Kontaktdruck [MPa]\n"
                           "0,0;2,0;200,5;100,5\n0,5;2,1;210,5;105,5\n");
  for (int test = 2; test <= 4; ++test) {
    std::string text = "Time [s],Normal force [N],Friction force [N],Contact pressure [MPa]\n";
    for (const Row& row : rows(test))
      text += fmt::format("{:.1f},{:.1f},{:.3f},{:.1f}\n", row.time_s, row.F_N(), row.F_R(),
                          row.sigma_MPa);
    directory.write(fmt::format("{}.csv", test), text);
  }
  const std::string job = job_from({"*.csv"});
  EXPECT_THAT(job, HasSubstr("\nF_N_N = \"Normal force\" ")) << "as most files are";
  EXPECT_THAT(job, HasSubstr(R"(
[[data.files]]
match = "../1.csv"
decimal = ","                                # more cells are numbers than with a point

[data.files.columns]
time_s = "Zeit"                              # first values: 0, 0.5; in s, as the file says
F_N_N = "Normalkraft"                        # first values: 2, 2.1; in kN, as the file says
)"));
  EXPECT_EQ(read().tests, "1 2, 2 30, 3 30, 4 30");
}

TEST_F(InitFrom, GivesNoRuleToAFileWithoutDecimalsAmongOthersWithCommas) {
  for (int test = 1; test <= 3; ++test)
    directory.write(fmt::format("{}.csv", test),
                    test == 1 ? "t;FR;FN;p [MPa]\n0;100;1000;50\n1;101;1010;51\n"
                              : "t;FR;FN;p [MPa]\n0,0;1.000,5;10.000,5;50\n1,5;101,5;1010;51\n");
  EXPECT_THAT(job_from({"*.csv"}), Not(HasSubstr("[[data.files]]")));
  EXPECT_EQ(read().tests, "1 2, 2 2, 3 2");
}

// ---- folders with more than recordings ----

TEST_F(InitFrom, LeavesResultsAndSentencesWithAWord) {
  for (int test = 1; test <= 3; ++test)
    directory.write(fmt::format("rig/pin{}.csv", test), coefficient_file(test));
  directory.write("rig/results.csv", "Specimen;COF mean;Track [um2]\nDLC 7;0.12;50\n"
                                     "DLC 8;0.13;64\nDLC 9;0.11;44\n");
  directory.write("rig/protocol.txt", "(lost) 4 strokes, 100 mm, pressure constant. Zero 2, 3.\n");
  const CommandResult result = frictab({"init", "job", "--from", "rig"});
  EXPECT_THAT(result.err,
              testing::AllOf(HasSubstr("not read: rig/protocol.txt: no table of numbers"),
                             HasSubstr("not read: ../rig/results.csv: it has no column for time_s, "
                                       "which most files have; if it has a row per test, write "
                                       "tests = \"../rig/results.csv\"\n")));
  EXPECT_THAT(directory.read("job/job.toml"),
              testing::AllOf(HasSubstr("\n# not read: ../rig/results.csv: "),
                             Not(HasSubstr("[[data.files]]")), Not(HasSubstr("column_1"))));
  EXPECT_EQ(read().tests, "pin1 30, pin2 30, pin3 30");
}

TEST_F(InitFrom, JoinsAListByTheNumbersOfTests) {
  for (int test = 21; test <= 23; ++test)
    directory.write(fmt::format("pack{}.csv", test), coefficient_file(test - 20));
  directory.write("list.csv", "Pack,Batch,Ra um\n21,B1,5.4\n22,B2,6.8\n23,B1,5.3\n");
  EXPECT_THAT(job_from({"*.csv"}), testing::AllOf(HasSubstr("\ntests = \"../list.csv\" "),
                                                  HasSubstr("\nexperiment = \"Pack\" ")));
  EXPECT_THAT(read().text, HasSubstr("list.csv: Batch, Ra um, by test"));
}

TEST_F(InitFrom, LeavesAnOlderVersionOfAFile) {
  const std::string whole = coefficient_file(2);
  directory.write("T1.csv", coefficient_file(1));
  directory.write("T2.csv", whole);
  directory.write("T2_old.csv", whole.substr(0, whole.find("\n1.2;") + 1));
  directory.write("T3.csv", coefficient_file(3));
  EXPECT_THAT(job_from({"*.csv"}), HasSubstr("\n# not read: ../T2_old.csv: it has the tests and "
                                             "rows of T2.csv again; if it is the better one, "));
  EXPECT_EQ(read().tests, "T1 30, T2 30, T3 30");
}

TEST_F(InitFrom, KeepsEqualRowsUnderTheNamesOfTwoTests) {
  for (const char* file : {"T1.csv", "T2.csv"})
    directory.write(file, coefficient_file(1));
  EXPECT_THAT(job_from({"T1.csv", "T2.csv"}), Not(HasSubstr("not read")));
}

TEST_F(InitFrom, TakesTheColumnThatChangesWhereTheClockBeginsAgainForTheTests) {
  for (const bool newer : {false, true}) {
    std::string text = "project,series,disc,day,t_s,p_nom_MPa,mu\n";
    for (int test = 1; test <= (newer ? 6 : 4); ++test)
      for (const Row& row : rows(test))
        text += fmt::format("oil,A{},D{},2024-05-0{},{:.1f},{:.1f},{:.4f}\n", test, (test + 1) / 2,
                            test, row.time_s, row.sigma_MPa, row.mu);
    directory.write(newer ? "all_v2.csv" : "all_v1.csv", text);
  }
  EXPECT_THAT(job_from({"*.csv"}),
              testing::AllOf(HasSubstr("\nexperiment = \"series\" "),
                             HasSubstr("\n# not read: ../all_v1.csv: it has the tests and rows of "
                                       "all_v2.csv again")));
  EXPECT_EQ(read().tests, "A1 30, A2 30, A3 30, A4 30, A5 30, A6 30");
}

TEST_F(InitFrom, LeavesAQuantityOfTheTableOfTestsThatTheRowsHave) {
  // the first file is read in another way than the rest, and has no such column
  directory.write("a0.csv", "t [s];mu;p [MPa]\n0;0.1;5\n1;0.2;6\n2;0.1;7\n");
  std::string plan = "Run,Disc temp C,Oil\na0,20,A\n";
  for (int test = 1; test <= 3; ++test) {
    std::string text = "Time,COF,Pressure,Disc temperature\ns,-,MPa,degC\n";
    for (const Row& row : rows(test))
      text += fmt::format("{:.1f},{:.4f},{:.1f},20.5\n", row.time_s, row.mu, row.sigma_MPa);
    directory.write(fmt::format("a{}.csv", test), text);
    plan += fmt::format("a{},{},B\n", test, 20 + test);
  }
  directory.write("plan.csv", plan);
  const std::string job = job_from({"*.csv"});
  EXPECT_THAT(job, testing::AllOf(HasSubstr("\nT_contact_C = \"Disc temperature\" "),
                                  HasSubstr("\ntests = \"../plan.csv\" "),
                                  Not(HasSubstr("\nT_contact_C = { column = \"Disc temp C\""))));
}

TEST_F(InitFrom, NamesFoldersThatItDoesNotLookInto) {
  for (int test = 1; test <= 2; ++test) {
    directory.write(fmt::format("lab/{}.csv", test), coefficient_file(test));
    directory.write(fmt::format("lab/more/{}.csv", test + 2), coefficient_file(test + 2));
  }
  directory.write("lab/out/stages.json", "{}");
  const std::string said = "not looked into: lab/more (2 files); if they have data, name them "
                           "too: frictab init --force --from lab lab/more\n";
  EXPECT_THAT(frictab({"init", "job", "--from", "lab"}).err, HasSubstr(said));
  EXPECT_THAT(frictab({"init", "job", "--force", "--from", "lab", "lab/more"}).err,
              Not(HasSubstr("not looked into")));
  EXPECT_EQ(read().tests, "1 30, 2 30, 3 30, 4 30");
}

TEST_F(InitFrom, GivesTheDecimalSignOfAPlanToFilesThatNeedNone) {
  for (int test = 1; test <= 4; ++test) {
    std::string text = "LabVIEW Measurement\nSeparator\tTab\nDecimal_Separator\t,\n"
                       "***End_of_Header***\n\nTime [s]\tCOF\tPressure [MPa]\n";
    for (const Row& row : rows(test))
      text += replace_all(
          fmt::format("{:.1f}\t{:.4f}\t{:.1f}\n", row.time_s, row.mu, row.sigma_MPa), ".", ",");
    directory.write(fmt::format("B_{}.txt", test), text);
  }
  directory.write("Plan.csv", "Versuch;Menge [g/m2]\nB_1;0,5\nB_2;1,0\nB_3;2,5\nB_4;0,5\n");
  EXPECT_THAT(job_from({"*.txt", "Plan.csv"}), HasSubstr("\ndecimal = \",\" "));
  EXPECT_THAT(read().text, HasSubstr("Menge [g/m2]  setting  one value per test, 3 of them"));
}

TEST_F(InitFrom, GivesFilesWithPointsARuleWhereTheirPlanHasCommas) {
  for (int test = 1; test <= 4; ++test)
    directory.write(fmt::format("B_{}.csv", test), coefficient_file(test));
  directory.write("plan.txt", "Versuch;Menge [g/m2]\nB_1;0,5\nB_2;1,0\nB_3;2,5\nB_4;0,5\n");
  EXPECT_THAT(job_from({"*.csv", "plan.txt"}),
              testing::AllOf(HasSubstr("\ndecimal = \",\" "),
                             HasSubstr("\n[[data.files]]\nmatch = \"*\"\ndecimal = \".\"\n")));
  const Read found = read();
  EXPECT_EQ(found.tests, "B_1 30, B_2 30, B_3 30, B_4 30");
  EXPECT_THAT(found.text, HasSubstr("Menge [g/m2]  setting  one value per test, 3 of them"));
}

TEST_F(InitFrom, ReadsAColumnPerTestBelowATitle) {
  std::string text = "COF over the path - all specimens,,,,\nDistance (m),S01,S02,S03,S04\n";
  for (int i = 0; i < 30; ++i)
    text +=
        fmt::format("{},0.5{:02},0.4{:02},0.3{:02},0.35{}\n", 5 * i, i % 7, i % 5, i % 9, i % 3);
  directory.write("cof.csv", text);
  directory.write("specimens.csv", "Specimen,Pressure (MPa),Hardness (HRC)\nS01,10,41\nS02,20,42\n"
                                   "S03,30,43\nS04,40,44\n");
  const std::string job = job_from({"cof.csv", "specimens.csv"});
  EXPECT_THAT(job, testing::AllOf(
                       HasSubstr("\ntests = \"../specimens.csv\" "),
                       HasSubstr("\nexperiment = [\"Specimen\", \"experiment\"] "),
                       HasSubstr("\n[data.wide]\ncolumns = \"^(?<experiment>S\\\\d+)$\" "),
                       HasSubstr("\n# ? Which form of friction do the columns of the tests have?"),
                       Not(HasSubstr("units_row"))));
  directory.write("job/job.toml", replace_all(job, "# tau_R_MPa = {", "tau_R_MPa = {"));
  EXPECT_EQ(read().tests, "S01 30, S02 30, S03 30, S04 30");
}

TEST_F(InitFrom, TakesARotationAtTheRadiusOfARing) {
  std::string summary = "Test,Speed rpm\n";
  for (int test = 1; test <= 3; ++test) {
    std::string text = "Ring dia (mm),35\nTime (s),Ring speed (rpm),COF,Pressure (MPa)\n";
    for (const Row& row : rows(test))
      text += fmt::format("{:.1f},{},{:.4f},{:.1f}\n", row.time_s, 60, row.mu, row.sigma_MPa);
    directory.write(fmt::format("BR{}.csv", test), text);
    summary += fmt::format("BR{},60\n", test);
  }
  directory.write("summary.csv", summary);
  const std::string job = job_from({"*.csv"});
  EXPECT_THAT(job, testing::AllOf(HasSubstr("\nv_rel_mm_s = { formula = "
                                            "\"Ring_speed*2*pi/60*Ring_dia/2\" }"),
                                  Not(HasSubstr("At which radius"))));
  EXPECT_THAT(read().text, HasSubstr("110")) << "mm/s";
}

TEST_F(InitFrom, AsksWhetherATemperatureIsThatOfTheContact) {
  for (int test = 1; test <= 2; ++test) {
    std::string text = "Time (s),COF,Pressure (MPa),Oil temp C,pin_end_temperature_C\n";
    for (const Row& row : rows(test))
      text += fmt::format("{:.1f},{:.4f},{:.1f},40,{}\n", row.time_s, row.mu, row.sigma_MPa, 50);
    directory.write(fmt::format("k{}.csv", test), text);
  }
  EXPECT_THAT(
      job_from({"k1.csv", "k2.csv"}),
      testing::AllOf(HasSubstr("\n# ? Is it the temperature of the contact, or of the tool? "),
                     HasSubstr("\n# T_contact_C = { column = \"Oil temp C\", unit = \"C\" }\n"
                               "# T_tool_C = { column = \"pin_end_temperature_C\", unit = "
                               "\"C\" }\n"),
                     Not(HasSubstr("\nT_contact_C"))));
  EXPECT_EQ(read().tests, "k1 30, k2 30");
}

// ---- other formats ----

TEST_F(InitFrom, ReadsCanonicalHdf5) {
  if (!have_program("/usr/bin/python3")) GTEST_SKIP() << "python3 is not installed";
  directory.write("make.py", R"(
import h5py
with h5py.File('a.h5', 'w') as f:
    f['experiment'] = ['K%d' % (i // 3) for i in range(9)]
    f['sigma_n_MPa'] = [100.0 + i for i in range(9)]
    f['tau_R_MPa'] = [10.0 + (i % 2) for i in range(9)]
)");
  const CommandResult made = test::run_command({"/usr/bin/python3", "make.py"}, directory.path());
  if (made.exit_code != 0) GTEST_SKIP() << "h5py is not installed";
  EXPECT_THAT(job_from({"a.h5"}),
              HasSubstr("# known by their names: experiment, sigma_n_MPa, tau_R_MPa\n"));
  EXPECT_EQ(read().tests, "K0 3, K1 3, K2 3");
}

TEST_F(InitFrom, ReadsAWorkbook) {
  std::string rows = "Rig 7\nTest;Time [s];COF;Pressure [MPa]\n";
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 5; ++i)
      rows +=
          fmt::format("K{};{};{};{}\n", k, 0.5 * i, 0.1 + 0.01 * (i % 2) + 0.001 * k, 100.5 + i);
  test::write_workbook(directory.path("a.xlsx"), {{{"1", test::xml_rows(rows)}}});
  EXPECT_THAT(job_from({"a.xlsx"}), HasSubstr("\nexperiment = \"Test\" "));
  EXPECT_EQ(read().tests, "K0 5, K1 5, K2 5");
}

// ---- what is missing, what is there ----

TEST_F(InitFrom, AsksForWhatIsMissing) {
  directory.write("a.csv", "Time [s];FF;Batch\n0;100.5;40\n1;101.5;40\n0;99.5;41\n1;99;41\n");
  const CommandResult result = frictab({"init", "--from", "a.csv"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(
      result.err,
      "open question in job.toml: Which column names the tests? None was found: the file is taken "
      "as one test.\n"
      "open question in job.toml: In which units? The file does not say, and these are taken: FF "
      "(N). A line here replaces the one above.\n"
      "open question in job.toml: Where does the contact normal stress come from? None was "
      "found.\n"
      "open question in job.toml: Which normal force belongs to the friction force? None was "
      "found.\n"
      "next: frictab data job.toml (shows what is read), frictab run job.toml\n");
  EXPECT_EQ(
      directory.read("job.toml"),
      R"(# Guessed from the files; every line may be wrong. frictab data shows what is read with it,
# frictab explain job what else there is.

[data]
training = "a.csv"                           # 1 file
# ? Which column names the tests? None was found: the file is taken as one test.
# experiment = "COLUMN"

[data.columns]
time_s = "Time"                              # first values: 0, 1, 0; in s, as the file says
F_R_N = "FF"                                 # first values: 100.5, 101.5, 99.5; no unit is given: N is assumed
# kept as recorded; what changes friction may be among them: Batch
# ? In which units? The file does not say, and these are taken: FF (N). A line here replaces the one above.
# F_R_N = { column = "FF", unit = "kN" }     # or N, kgf, lbf, mN
# ? Where does the contact normal stress come from? None was found.
# sigma_n_MPa = "COLUMN"
# sigma_n_MPa = { column = "FORCE", area_mm2 = 78.5 } # a force over the nominal contact area
# or one value for all rows, in [data.constants] below
# ? Which normal force belongs to the friction force? None was found.
# F_N_N = "COLUMN"
# or one value for all rows, in [data.constants] below

[data.constants]
# sigma_n_MPa = 500.0
# F_N_N = 50.0
# sigma_f_MPa = 480.0                        # flow stress of the workpiece: laws with a shear limit need it

[output]
directory = "out"
)");
  EXPECT_THAT(frictab({"data", "job.toml"}).err,
              HasSubstr("answer the open questions in job.toml (lines 6, 13, 15, 19): "));
  // Its lines answer, once their # is gone.
  std::string job = directory.read("job.toml");
  for (const char* line : {"sigma_n_MPa = 500.0", "F_N_N = 50.0", "sigma_f_MPa = 480.0"})
    job = replace_all(job, std::string("# ") + line, line);
  job = replace_all(job, "# experiment = \"COLUMN\"", "experiment = \"Batch\"");
  directory.write("job.toml", replace_all(job, "F_N_N = 50.0", "F_N_N = 500.0"));
  const CommandResult data = frictab({"data", "job.toml", "-q"});
  EXPECT_EQ(data.exit_code, 0) << data.err;
}

TEST_F(InitFrom, AsksForAnAreaUnderTheForceThatItFound) {
  directory.write("a.csv", "Test,Load [kN],Friction force [N]\n1,1.5,200\n1,1.6,210\n");
  ASSERT_EQ(frictab({"init", "--from", "a.csv"}).exit_code, 0);
  EXPECT_THAT(directory.read("job.toml"),
              HasSubstr("\n# sigma_n_MPa = { column = \"Load\", area_mm2 = 78.5 }"));
}

TEST_F(InitFrom, TellsWhatIsNoTable) {
  directory.write("letter.txt", "Dear all,\nthe tests went well.\nRegards\n");
  directory.write("empty.csv", "\n");
  const std::string none = ": error: no table of numbers under a line of names was found\n"
                           "  hint: frictab init DIR writes a job with every key, to be filled in "
                           "by hand\n";
  for (const auto& [file, said] :
       {std::pair<std::string, std::string>{"letter.txt", "letter.txt" + none},
        {"empty.csv", "empty.csv: error: the file is empty\n"},
        {"gone.csv", "gone.csv: error: no such file\n"}}) {
    const CommandResult result = frictab({"init", "job", "--from", file});
    EXPECT_EQ(result.exit_code, 2) << file;
    EXPECT_EQ(result.err, said);
  }
}

TEST_F(InitFrom, AsksWhichColumnsAreWhichWhereNoLineNamesThem) {
  for (int test = 1; test <= 3; ++test) {
    std::string text = "0.05\t0.1\n";
    for (const Row& row : rows(test))
      text +=
          fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu * row.sigma_MPa, row.sigma_MPa);
    directory.write(fmt::format("{}.txt", test), text);
  }
  std::string job = job_from({"1.txt", "2.txt", "3.txt"});
  EXPECT_THAT(job, testing::AllOf(HasSubstr("\nskip_rows = 1 "), HasSubstr("\nheader = false "),
                                  HasSubstr("\n# ? Which columns are these?"),
                                  HasSubstr("\n# QUANTITY = { column = 3 } ")));
  int number = 0;
  for (const char* quantity : {"time_s", "tau_R_MPa", "sigma_n_MPa"}) {
    const std::string of_column = fmt::format(" = {{ column = {} }}", ++number);
    job = replace_all(job, "# QUANTITY" + of_column, quantity + of_column);
  }
  directory.write("job/job.toml", job);
  EXPECT_EQ(read().tests, "1 30, 2 30, 3 30");
}

TEST_F(InitFrom, NumbersColumnsWithoutANameOrWithEqualOnes) {
  const std::string text = "Date:;2020-01-01 10:00\n;Shear stress;p;p\nms;MPa;MPa;MPa\n";
  for (int test = 1; test <= 2; ++test) {
    std::string file = text;
    for (const Row& row : rows(test))
      file += fmt::format("{:.1f};{:.4f};{:.1f};{:.2f}\n", 1000 * row.time_s,
                          row.mu * row.sigma_MPa, row.sigma_MPa, row.mu);
    directory.write(fmt::format("{}.csv", test), file);
  }
  const std::string job = job_from({"1.csv", "2.csv"});
  EXPECT_THAT(job, testing::AllOf(HasSubstr("\nunits_row = true "),
                                  HasSubstr("\ntime_s = { column = 1 } "),
                                  HasSubstr("\nsigma_n_MPa = { column = 3 } ")));
  EXPECT_EQ(read().tests, "1 30, 2 30");
}

TEST_F(InitFrom, FindsTheTestsOfAPlanInAWorkbookAndTheAreaAboveTheRows) {
  for (int test = 1; test <= 3; ++test) {
    std::string text = fmt::format("Pr\xfc"
                                   "fstand 2\nCharge: {}\nKontaktfl\xe4"
                                   "che [mm\xb2]: 2,5\n\n"
                                   "Zeit [s];Normalkraft [N];Reibkraft [N]\n",
                                   test == 2 ? "B" : "A");
    for (const Row& row : rows(test))
      text += replace_all(fmt::format("{:.1f};{:.2f};{:.4f}\n", row.time_s, 2.5 * row.sigma_MPa,
                                      2.5 * row.mu * row.sigma_MPa),
                          ".", ",");
    directory.write(fmt::format("V0{}.csv", test), text);
  }
  test::write_workbook(
      directory.path("plan.xlsx"),
      {{{"Info", test::xml_rows("Rig 7\n")},
        {"Plan", test::xml_rows("Versuch;Geschwindigkeit [mm/s];Charge\nVersuch_001_C45;5;A\n"
                                "Versuch_002_C45;50;B\nVersuch_003_C45;50;A\n")}}});
  const std::string job = job_from({"V01.csv", "V02.csv", "V03.csv", "plan.xlsx"});
  EXPECT_THAT(job, testing::AllOf(Not(HasSubstr("\nabove = ")), // the plan has it
                                  HasSubstr("\ntests = \"../plan.xlsx\" "),
                                  HasSubstr("\ntests_sheet = \"Plan\"\n"),
                                  HasSubstr("\nexperiment = \"Versuch\" "),
                                  HasSubstr("column = \"Normalkraft\", area_mm2 = 2.5 }")));
  const Read data = read();
  EXPECT_EQ(data.tests, "V01 30, V02 30, V03 30");
  EXPECT_THAT(data.text, HasSubstr("tests are found by the numbers in their names"));
}

TEST_F(InitFrom, TakesSheetsOfAWorkbookForTests) {
  std::vector<test::XmlSheet> sheets = {{"Cover", test::xml_rows("Order 4711\n")}};
  for (int test = 1; test <= 3; ++test) {
    std::string text = "Time [s];COF;Pressure [MPa]\n";
    for (const Row& row : rows(test))
      text += fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu, row.sigma_MPa);
    sheets.push_back({fmt::format("v{}_1", 5 * test), test::xml_rows(text)});
  }
  test::write_workbook(directory.path("tests.xlsx"), {sheets});
  const std::string job = job_from({"tests.xlsx"});
  EXPECT_THAT(job, testing::AllOf(
                       HasSubstr("\ntraining = \"../tests.xlsx\"                   # 3 sheets\n"),
                       HasSubstr("\nsheet = \"*\" "), HasSubstr("# not read: Cover\n")));
  EXPECT_EQ(read().tests, "v10_1 30, v15_1 30, v5_1 30");
}

TEST_F(InitFrom, TakesTheSheetsThatItIsTold) {
  std::vector<test::XmlSheet> sheets;
  for (int test = 1; test <= 3; ++test) {
    std::string text = "Time [s];COF;Pressure [MPa]\n";
    for (const Row& row : rows(test))
      text += fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu, row.sigma_MPa);
    sheets.push_back({fmt::format("T{}", test), test::xml_rows(text)});
  }
  test::write_workbook(directory.path("tests.xlsx"), {sheets});
  ASSERT_EQ(frictab({"init", "job", "--from", "tests.xlsx", "--sheet", "T1", "T3"}).exit_code, 0);
  EXPECT_THAT(directory.read("job/job.toml"), HasSubstr("\nsheet = [\"T1\", \"T3\"]\n"));
  EXPECT_EQ(read().tests, "T1 30, T3 30");
  const CommandResult none = frictab({"init", "--from", "tests.xlsx", "--sheet", "T4"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("no workbook has a table in a sheet 'T4'"));
}

// A sheet whose rows have other names than those of its summary.
std::string shear_box(double sigma_kPa) {
  std::string text = "Normal stress (kPa);" + shortest(sigma_kPa) +
                     "\n\nElapsed time;Shear stress;Normal stress;Remarks\nmin;kPa;kPa\n";
  for (int i = 0; i < 60; ++i)
    text +=
        fmt::format("{};{};{}{}\n", i, 0.5 * sigma_kPa + i % 3, sigma_kPa, i == 0 ? ";start" : "");
  return text;
}

TEST_F(InitFrom, TakesTheLongSheetsAndNotTheirSummary) {
  std::vector<test::XmlSheet> sheets = {
      {"Summary", test::xml_rows("Normal stress (kPa);Peak shear stress (kPa)\n50;26\n100;52\n"
                                 "200;101\n400;200\n")}};
  for (const double sigma : {50, 100, 200, 400})
    sheets.push_back({shortest(sigma) + " kPa", test::xml_rows(shear_box(sigma))});
  test::write_workbook(directory.path("box.xlsx"), {sheets});
  EXPECT_THAT(job_from({"box.xlsx"}),
              testing::AllOf(HasSubstr("not read: Summary"), HasSubstr("\nunits_row = true "),
                             Not(HasSubstr("\nabove = "))));
  EXPECT_EQ(read().tests, "100 kPa 60, 200 kPa 60, 400 kPa 60, 50 kPa 60");
  ASSERT_EQ(frictab({"init", "two", "--from", "box.xlsx", "--sheet", "?00 kPa"}).exit_code, 0);
  EXPECT_THAT(directory.read("two/job.toml"), HasSubstr("\nsheet = \"?00 kPa\""));
}

TEST_F(InitFrom, TakesTheLoadOfASledTestForItsPull) {
  for (int test = 1; test <= 3; ++test) {
    std::string text = fmt::format("Sled weight,1.961,N\nMaximum rows,{}\nContact area,40,cm2\n\n"
                                   "Time,Extension,Load\n(s),(mm),(N)\n",
                                   20 + test);
    for (int i = 0; i < 20 + test; ++i)
      text += fmt::format("{:.1f},{:.2f},{:.3f}\n", 0.1 * i, 0.25 * i, 0.4 + 0.01 * (i % 3));
    directory.write(fmt::format("s{}.csv", test), text);
  }
  ASSERT_EQ(frictab({"init", "--from", "s1.csv", "s2.csv", "s3.csv"}).exit_code, 0);
  EXPECT_THAT(
      directory.read("job.toml"),
      testing::AllOf(HasSubstr("\nF_N_N = \"Sled weight\" "),
                     HasSubstr("\n# ? Is Load the friction force? It is the only force left"),
                     HasSubstr("\nsigma_n_MPa = { column = \"Sled weight\", area_mm2 = 4000 }"),
                     Not(HasSubstr("\nabove = "))))
      << "a number of rows is no condition";
}

TEST_F(InitFrom, SeesTheStatisticsBelowTheRows) {
  for (int test = 1; test <= 2; ++test)
    directory.write(fmt::format("t{}.csv", test),
                    coefficient_file(test) + "\nStatistics:\nn = 5;-;MPa\nx;0.12;102\ns;0.01;3\n");
  EXPECT_THAT(job_from({"t1.csv", "t2.csv"}), HasSubstr("\nskip_footer = 5 "));
  EXPECT_EQ(read().tests, "t1 30, t2 30");
}

TEST_F(InitFrom, TakesNoDurationForAClockAndTheToolForTheTool) {
  for (int test = 1; test <= 2; ++test) {
    std::string text = "Stop time (s);COF;Pressure (MPa);Temperatur Werkzeug (°C)\n";
    for (int i = 0; i < 30; ++i)
      text += fmt::format("{};{};{};{}\n", 5 + i % 4, 0.1 + 0.01 * (i % 3), 10 + i, 40 + i % 5);
    directory.write(fmt::format("b{}.csv", test), text);
  }
  EXPECT_THAT(job_from({"b1.csv", "b2.csv"}),
              testing::AllOf(Not(HasSubstr("time_s")), HasSubstr("\nT_tool_C = \"Temperatur")));
}

TEST_F(InitFrom, TakesPartsOfVeryDifferentLengthForPhasesOfATest) {
  for (int test = 1; test <= 2; ++test) {
    std::string text;
    for (const int length : {4, 5, 40}) {
      text += "Time [s];Shear stress [MPa];Normal stress [MPa]\n";
      for (int i = 0; i < length; ++i)
        text += fmt::format("{};{};{}\n", i, 10 + i % 3, 100 + i);
    }
    directory.write(fmt::format("h{}.csv", test), text);
  }
  ASSERT_EQ(frictab({"init", "--from", "h1.csv", "h2.csv"}).exit_code, 0);
  EXPECT_THAT(directory.read("job.toml"), HasSubstr("\nexperiment = \"file\" "));
}

TEST_F(InitFrom, CutsTheRowsAtTitlesBetweenThem) {
  for (int test = 1; test <= 2; ++test) {
    std::string text = "Time;COF;Pressure\ns;-;MPa\n";
    for (int i = 0; i < 30; ++i) {
      if (i % 10 == 0) text += fmt::format("{} Fade test\n", 1 + i / 10);
      const Row row = rows(test)[static_cast<std::size_t>(i)];
      text += fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu, row.sigma_MPa);
    }
    directory.write(fmt::format("d{}.csv", test), text);
  }
  EXPECT_THAT(job_from({"d1.csv", "d2.csv"}),
              HasSubstr("\n[data.segments]\nbegins = '^(?<title>[^;]*[A-Za-z][^;]*)$'"));
  EXPECT_EQ(read().tests, "d1 30, d2 30");
}

TEST_F(InitFrom, OffersTheRadiiAboveTheRows) {
  directory.write("a.csv", "Inner radius;9.5;mm\nOuter radius;12.7;mm\n\n"
                           "Test;Normal force [kN];Torque [Nm]\n1;1.5;200\n1;1.6;210\n");
  ASSERT_EQ(frictab({"init", "--from", "a.csv"}).exit_code, 0);
  EXPECT_THAT(directory.read("job.toml"),
              testing::AllOf(HasSubstr("area_mm2 = 223.2 }"), HasSubstr("\"Torque/0.0111\"")));
}

TEST_F(InitFrom, KeepsAPlanWithALegendBelowIt) {
  std::vector<test::XmlSheet> sheets = {
      {"Plan", test::xml_rows("Versuch;Geschwindigkeit [mm/s];Oil;Remark\nV01;5;A\nV02;50;B;new\n"
                              "V03;50;A\n\nLegend: A = mineral oil\n")}};
  for (int test = 1; test <= 3; ++test) {
    std::string text = "Time [s];COF;Pressure [MPa]\n";
    for (const Row& row : rows(test))
      text += fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu, row.sigma_MPa);
    sheets.push_back({fmt::format("V0{}", test), test::xml_rows(text)});
  }
  test::write_workbook(directory.path("tests.xlsx"), {sheets});
  EXPECT_THAT(job_from({"tests.xlsx"}), HasSubstr("\ntests_sheet = \"Plan\"\n"));
  EXPECT_EQ(read().tests, "V01 30, V02 30, V03 30");
}

TEST_F(InitFrom, PassesOverAFileThatIsNoTableWithAWord) {
  for (int test = 1; test <= 3; ++test)
    directory.write(fmt::format("rig/{}.txt", test), coefficient_file(test));
  directory.write("rig/notes.txt", "Dear all,\nthe tests went well.\n");
  const CommandResult result = frictab({"init", "job", "--from", "rig"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("not read: rig/notes.txt: no table of numbers under a line of "
                                    "names was found\n"));
  EXPECT_EQ(read().tests, "1 30, 2 30, 3 30");
}

TEST_F(InitFrom, AsksForTheRadiusOfATorque) {
  directory.write("a.csv",
                  "Test,Load [N],Torque [N mm],Pressure [MPa]\n1,1.5,200,3\n1,1.6,210,3\n");
  ASSERT_EQ(frictab({"init", "--from", "a.csv"}).exit_code, 0);
  EXPECT_THAT(
      directory.read("job.toml"),
      testing::AllOf(HasSubstr("\n# ? At which radius does friction act? Torque [N mm] is a "
                               "torque, in N mm.\n"),
                     HasSubstr("\n# F_R_N = { formula = \"0.001*Torque/RADIUS_M\" }")));
}

TEST_F(InitFrom, KeepsAJobFileThatIsThereUnlessForced) {
  directory.write("a.csv", coefficient_file(1));
  directory.write("job.toml", "mine");
  const CommandResult kept = frictab({"init", "--from", "a.csv"});
  EXPECT_EQ(kept.exit_code, 2);
  EXPECT_THAT(kept.err, HasSubstr("job.toml: error: is there already\n  hint: name another "
                                  "directory, or --force to replace it"));
  EXPECT_EQ(directory.read("job.toml"), "mine");
  EXPECT_EQ(frictab({"init", "--from", "a.csv", "--force"}).exit_code, 0);
  EXPECT_THAT(directory.read("job.toml"), HasSubstr("tau_R_MPa = { column = \"COF\""));
}

TEST_F(InitFrom, UnitsBelowAllNamesAreNotTakenForTheHeader) {
  int jobs = 0;
  for (const std::string preamble : {"", "Rig: 3;;\nDate: 3.5.2024;;\n\n", "Rig: 3\n\n"})
    for (const std::string units : {"[s];[-];[MPa]", "s;-;MPa"}) {
      std::string text;
      for (int test = 1; test <= 2; ++test) {
        text = preamble + "Time;COF;Pressure\n" + units + "\n";
        for (const Row& row : rows(test))
          text += fmt::format("{:.1f};{:.4f};{:.1f}\n", row.time_s, row.mu, row.sigma_MPa);
        directory.write(fmt::format("t{}.csv", test), text);
      }
      const std::string name = fmt::format("job{}", jobs++);
      const CommandResult made = frictab({"init", name, "--from", "t1.csv", "t2.csv"});
      ASSERT_EQ(made.exit_code, 0) << made.err;
      EXPECT_THAT(directory.read(name + "/job.toml"), HasSubstr("units_row = true")) << text;
      EXPECT_THAT(directory.read(name + "/job.toml"), HasSubstr("\"Pressure\"")) << text;
    }
}

} // namespace
} // namespace frictab::init_from_test
