// Reading data files: what rigs write is read, and every fault is told with its place.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "data/leave_out.h"
#include "data/load.h"
#include "io/hdf5.h"
#include "unit/load_case.h"

namespace frictab::load_test {

using data::Dataset;
using data::load_dataset;

namespace {

using testing::HasSubstr;
using testing::Not;

using Load = test::LoadCase;
namespace fs = std::filesystem;
using Values = std::vector<double>;

TEST_F(Load, ReadsCanonicalColumnsAndNamesTheExperimentByTheFile) {
  const Dataset data = read("sigma_n_MPa,tau_R_MPa\n1000,80.5\n1100,8.1e1\n");
  EXPECT_EQ(column(data, "sigma_n_MPa"), (Values{1000, 1100}));
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{80.5, 81}));
  EXPECT_EQ(data.experiments, std::vector<std::string>{"a"});
  EXPECT_EQ(data.find("sigma_n_MPa")->unit, "MPa");
}

TEST_F(Load, FindsEveryDelimiter) {
  for (const std::string d : {",", ";", "\t", "|", "   "}) {
    const Dataset data = read("sigma_n_MPa" + d + "tau_R_MPa\n1000" + d + "80\n1100" + d + "81\n");
    EXPECT_EQ(column(data, "tau_R_MPa"), (Values{80, 81})) << "'" << d << "'";
  }
}

TEST_F(Load, PrefersTheDelimiterThatTheRowsShareOverOneInsideNames) {
  options.columns["sigma_n_MPa"].names = {"p (MPa, nominal, mean, max)"};
  const Dataset data = read("p (MPa, nominal, mean, max)\ttau_R_MPa\n1\t2\n3\t4\n");
  EXPECT_EQ(column(data, "sigma_n_MPa"), (Values{1, 3}));
}

TEST_F(Load, ReadsDecimalCommaPreambleUnitsFooterAndWindowsLineEnds) {
  options.decimal = ',';
  options.skip_rows = 2;
  options.skip_footer = 1;
  options.units_row = true;
  const Dataset data = read("\xef\xbb\xbfrig 7\r\n\r\nsigma_n_MPa\ttau_R_MPa\r\n[Pa]\t(kPa)\r\n"
                            "1800,\t500,5\r\n2000\t,5\r\nTest completed\r\n\r\n");
  EXPECT_EQ(column(data, "sigma_n_MPa"), (Values{1800 * 1e-6, 2000 * 1e-6}));
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{500.5 * 1e-3, 0.5 * 1e-3}));
}

TEST_F(Load, ReadsLinesThatEndWithCarriageReturnsAlone) {
  EXPECT_EQ(read("sigma_n_MPa,tau_R_MPa\r1,2\r3,4\r").rows(), 2u);
}

TEST_F(Load, ReadsQuotedTextWithDelimitersNewlinesAndQuotes) {
  const Dataset data = read("sigma_n_MPa,lot,tau_R_MPa\n\"1\",\"a,\n\"\"b\"\"\",2\n3,c,4\n");
  EXPECT_EQ(data.find("lot")->levels, (std::vector<std::string>{"a,\n\"b\"", "c"}));
  EXPECT_EQ(column(data, "lot"), (Values{0, 1}));
}

TEST_F(Load, KeepsExperimentNamesAsTheyAreWritten) {
  const Dataset data = read("experiment,sigma_n_MPa,tau_R_MPa\n007,1,2\n7,1,2\n007,3,4\n7,3,5\n");
  EXPECT_EQ(data.experiments, (std::vector<std::string>{"007", "7"}));
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{2, 4, 2, 5}));
}

TEST_F(Load, TurnsLatin1TextIntoUtf8) {
  const Dataset data = read("sigma_n_MPa,tau_R_MPa,Raum \xb0"
                            "C\n1,2,20\n3,4,21\n");
  EXPECT_TRUE(data.has("Raum \u00b0C"));
}

TEST_F(Load, TakesColumnsByNumberByAlternativeNamesAndWithUnits) {
  options.columns["tau_R_MPa"].number = 3;
  options.columns["sigma_n_MPa"].names = {"Stress", "Normal stress"};
  options.columns["sigma_n_MPa"].unit = "GPa";
  options.columns["T_contact_C"].names = {"T"};
  options.columns["T_contact_C"].unit = "K";
  options.bystanders = std::vector<std::string>{};
  const Dataset data = read("F,Normal stress,F,T\n9,1,2,293.15\n9,3,4,300\n");
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{2, 4}));
  EXPECT_EQ(column(data, "sigma_n_MPa"), (Values{1000, 3000}));
  EXPECT_DOUBLE_EQ(column(data, "T_contact_C")[1], 300 - 273.15);
  EXPECT_EQ(data.columns.size(), 3u);
}

TEST_F(Load, MultipliesMeasuredCoefficientsAndDividesForcesByArea) {
  options.columns["tau_R_MPa"].names = {"mu"};
  options.columns["tau_R_MPa"].times = "sigma_n_MPa";
  options.columns["sigma_n_MPa"].names = {"Load"};
  options.columns["sigma_n_MPa"].unit = "kN";
  options.columns["sigma_n_MPa"].area_mm2 = 50;
  const Dataset data = read("Load,mu\n1,0.5\n2,0.25\n");
  EXPECT_EQ(column(data, "sigma_n_MPa"), (Values{20, 40}));
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{10, 10}));
}

TEST_F(Load, TakesSpeedAsTheSizeOfALocalSlope) {
  options.columns["v_rel_mm_s"].names = {"x"};
  options.columns["v_rel_mm_s"].unit = "um";
  options.columns["v_rel_mm_s"].slope_rows = 3;
  std::string text = "time_s,x,sigma_n_MPa,tau_R_MPa\n";
  for (int i = 0; i < 9; ++i) // falls by 2000 um each half second
    text += std::to_string(0.5 * i) + "," + std::to_string(9000 - 2000 * i) + ",1,2\n";
  for (const double v : column(read(text), "v_rel_mm_s"))
    EXPECT_NEAR(v, 4.0, 1e-12); // rounding of sums of 3
}

TEST_F(Load, DerivesShearStressByEquation1AndDistanceByTrapezoids) {
  const Dataset data =
      read("experiment,time_s,v_rel_mm_s,sigma_n_MPa,F_R_N,F_N_N\n"
           "a,0,10,1000,5,50\na,1,20,1000,5,100\nb,5,2,800,1,10\nb,7,4,800,1,20\n");
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{100, 50, 80, 40}));
  EXPECT_EQ(column(data, "s_mm"), (Values{0, 15, 0, 6}));
  EXPECT_THAT(data.notes, testing::Contains(HasSubstr("eq. 1")));
  EXPECT_THAT(data.notes, testing::Contains("s_mm integrated from v_rel_mm_s and time_s"));
}

TEST_F(Load, LeavesRowsOutBeforeTheyAreChecked) {
  options.drop.push_back({"tau_R_MPa", 0.1, {}, {}});
  const Dataset data = read("sigma_n_MPa,tau_R_MPa\nx,-3\n-1,0\n1,2\n3,4\n");
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{2, 4}));
  ASSERT_EQ(data.dropped.size(), 1u);
  EXPECT_EQ(data.dropped[0].rule, "tau_R_MPa below 0.1");
  EXPECT_EQ(data.dropped[0].rows, 2u);
}

TEST_F(Load, LeavesRowsOutByTheirTextAndTestsByTheirName) {
  const std::string rows = "experiment,sigma_n_MPa,tau_R_MPa,valid,grade\n"
                           "a,10,1,TRUE,1\na,10,2,TRUE,1\nb,10,3,FALSE,1\nb,10,4,FALSE,1\n"
                           "c,10,5,TRUE,0\nc,10,6,TRUE,0\nd,10,7,TRUE,1\nd,10,8,TRUE,1\n";
  options.drop.push_back({"valid", {}, {}, {}, {"FALSE"}});
  options.drop.push_back({"grade", {}, {}, {}, {"0"}});
  options.drop.push_back({"experiment", {}, {}, {}, {"d"}});
  options.bystanders.emplace(); // kept because it is asked for
  const Dataset data = read(rows);
  EXPECT_EQ(column(data, "tau_R_MPa"), (Values{1, 2}));
  ASSERT_EQ(data.dropped.size(), 3u);
  EXPECT_EQ(data.dropped[0].rule, "valid is 'FALSE'");
  EXPECT_EQ(data.dropped[0].rows, 2u);
  EXPECT_EQ(data.dropped[1].rule, "grade is '0'");
  EXPECT_EQ(data.dropped[2].rule, "experiment is 'd'");
  const auto faults_of = [&](const std::string& name, const std::string& text) {
    options.drop = {{name, {}, {}, {}, {text}}};
    const Dataset all = read(rows);
    const Dataset* const parts[] = {&all};
    FaultList faults;
    data::check_texts_to_drop(parts, options, faults);
    return faults.empty() ? "" : faults.all().front().what + "; " + faults.all().front().hint;
  };
  EXPECT_EQ(faults_of("valid", "FALSE"), "");
  EXPECT_THAT(faults_of("valid", "FALS"),
              HasSubstr("data.drop: no row has 'FALS' in valid; did you "
                        "mean 'FALSE'?"));
  EXPECT_THAT(faults_of("valit", "FALSE"), HasSubstr("data.drop: the data have no column 'valit'"));
  EXPECT_THAT(faults_of("experiment", "e"), HasSubstr("no row has 'e' in experiment"));
  options.drop = {{"valid", 1.0, {}, {}, {}}};
  EXPECT_THAT(fault(rows), HasSubstr("data.drop: valid holds texts, no numbers"));
}

TEST_F(Load, TellsTheFaultsOfAllCellsAtOnceInTheOrderOfTheFile) {
  const std::string text = fault("sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,tau_R_MPa\n"
                                 "1,1,1,20,2\n"
                                 "-5,0.5,-1,-300,-2\n"
                                 "nan,1,inf,20,1e999\n"
                                 "\"1,5\",1,1,20,abc\n"
                                 ",1,1,20,2\n");
  EXPECT_THAT(text, HasSubstr("a.csv:3: error: sigma_n_MPa is -5"));
  EXPECT_THAT(text, HasSubstr("a.csv:3: error: psi is 0.5"));
  EXPECT_THAT(text, HasSubstr("a.csv:3: error: T_contact_C is -300"));
  EXPECT_THAT(text, HasSubstr("a.csv:4:1: error: sigma_n_MPa: nan stands for no value"));
  EXPECT_THAT(text, HasSubstr("a.csv:4:7: error: v_rel_mm_s: inf is not a finite number"));
  EXPECT_THAT(text, HasSubstr("a.csv:4:14: error: tau_R_MPa: 1e999 is not a finite number"));
  EXPECT_THAT(text, HasSubstr("a.csv:5:1: error: sigma_n_MPa: '1,5' is not a number\n"
                              "  hint: a decimal comma? set data.decimal = \",\""));
  EXPECT_THAT(text, HasSubstr("a.csv:5:14: error: tau_R_MPa: 'abc' is not a number"));
  EXPECT_THAT(text, HasSubstr("a.csv:6:1: error: sigma_n_MPa: the cell is empty"));
  EXPECT_LT(text.find("a.csv:3:"), text.find("a.csv:4:"));
  EXPECT_LT(text.find("a.csv:4:"), text.find("a.csv:5:"));
}

TEST_F(Load, TellsRaggedRowsAndOpenQuotesWithTheirLines) {
  EXPECT_THAT(fault("sigma_n_MPa,tau_R_MPa\n1,2\n\n1,2,3\n4\n5,6\n"),
              testing::AllOf(HasSubstr("a.csv:4: error: 3 cells, the header has 2"),
                             HasSubstr("a.csv:5: error: 1 cells, the header has 2")));
  EXPECT_THAT(fault("sigma_n_MPa,tau_R_MPa\n1,2\n1,\"2\n4,5\n"),
              HasSubstr("a.csv:3: error: a quotation mark opens here and is never closed"));
}

TEST_F(Load, TellsFilesWithoutATable) {
  EXPECT_THAT(fault(""), HasSubstr("the file is empty"));
  EXPECT_THAT(fault(" \n\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(fault("sigma_n_MPa,tau_R_MPa\n"), HasSubstr("a.csv:1: error: there are no rows"));
  EXPECT_THAT(fault("1,2\n3,4\n"), HasSubstr("column names in this line are numbers"));
  EXPECT_THAT(fault("sigma_n_MPa" + std::string(1000001, ',') + "\n1\n"),
              HasSubstr("a.csv:1: error: more than 1,000,000 columns in this line"));
  EXPECT_THAT(fault(std::string("a\0b,\n1,2", 8)), HasSubstr("this is not a text file"));
  EXPECT_THAT(fault_of({"none.csv"}), HasSubstr("no such file"));
  fs::create_directory(directory_ / "folder");
  EXPECT_THAT(fault_of({"folder"}), HasSubstr("'folder' holds no file"));
}

TEST_F(Load, TellsMissingColumnsAndTheNearestName) {
  const std::string text = fault("sigma_n,tau_R_MPa\n1,2\n3,4\n");
  EXPECT_THAT(text, HasSubstr("there is no column sigma_n_MPa"));
  EXPECT_THAT(text, HasSubstr("sigma_n, tau_R_MPa"));
  EXPECT_THAT(fault("sigma_n_MPa,F_R_N\n1,2\n3,4\n"), HasSubstr("neither tau_R_MPa nor the pair"));
  options.columns["tau_R_MPa"].names = {"Frition"};
  EXPECT_THAT(fault("sigma_n_MPa,Friction\n1,2\n3,4\n"),
              testing::AllOf(HasSubstr("there is no column 'Frition' (wanted for tau_R_MPa)"),
                             HasSubstr("did you mean 'Friction'?")));
}

TEST_F(Load, TellsDuplicateColumnsOnlyWhereTheyAreUsed) {
  const std::string text = "sigma_n_MPa,tau_R_MPa,x,x\n1,2,3,4\n5,6,7,8\n";
  EXPECT_TRUE(read(text).has("x (column 4)"));
  options.columns["psi"].names = {"x"};
  EXPECT_THAT(fault(text), HasSubstr("a.csv:1: error: there are 2 columns 'x': 3, 4"));
  options.columns.clear();
  options.bystanders = std::vector<std::string>{};
  EXPECT_EQ(read(text).columns.size(), 2u);
}

TEST_F(Load, TellsUnitsThatDoNotConvertAndThoseThatDo) {
  options.columns["sigma_n_MPa"].names = {"p"};
  options.columns["sigma_n_MPa"].unit = "kN";
  const std::string text = fault("p,tau_R_MPa\n1,2\n3,4\n");
  EXPECT_THAT(text, HasSubstr("sigma_n_MPa: the unit 'kN' does not convert to MPa"));
  EXPECT_THAT(text, HasSubstr("GPa"));
}

TEST_F(Load, TakesOneRowPerTestWhereEveryTestIsOne) {
  const Dataset data = read("experiment,sigma_n_MPa,tau_R_MPa\na,1,2\nb,3,4\n");
  EXPECT_THAT(data.first_row, testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(data.notes, testing::Contains(HasSubstr("one row per test")));
  EXPECT_THAT(fault("experiment,time_s,sigma_n_MPa,tau_R_MPa\n0,0,1,2\n1,1,3,4\n"),
              HasSubstr("every row is a test of its own, though there is time_s"));
}

TEST_F(Load, TellsSingleRowsBackwardTimeAndLoadsOfZero) {
  EXPECT_THAT(fault("experiment,sigma_n_MPa,tau_R_MPa\na,1,2\na,1,2\nb,3,4\n"),
              HasSubstr("a.csv:4: error: experiment 'b' has one row only"));
  EXPECT_THAT(fault("time_s,sigma_n_MPa,tau_R_MPa\n0,1,2\n2,1,2\n1,3,4\n"),
              HasSubstr("a.csv:4: error: time_s goes back from 2 to 1"));
  EXPECT_THAT(fault("sigma_n_MPa,F_R_N,F_N_N\n1,2,3\n1,2,0\n"),
              HasSubstr("a.csv:3: error: F_N_N is 0"));
  EXPECT_THAT(fault("sigma_n_MPa,F_R_N,F_N_N\n1,2,3\n1,2,-4\n"),
              HasSubstr("a.csv:3: error: F_N_N is -4"));
  EXPECT_THAT(
      fault("sigma_n_MPa,tau_R_MPa\n1,2\n9.99e99,2\n"),
      HasSubstr("a.csv:3: error: sigma_n_MPa is 9.99e+99\n  hint: what a device writes where "
                "it measured nothing?"));
}

TEST_F(Load, TellsWhereASlopeCannotBeTaken) {
  options.columns["v_rel_mm_s"].names = {"x"};
  options.columns["v_rel_mm_s"].slope_rows = 2;
  EXPECT_THAT(fault("time_s,x,sigma_n_MPa,tau_R_MPa\n1,1,1,1\n1,2,1,1\n"),
              HasSubstr("v_rel_mm_s cannot be computed here"));
}

TEST_F(Load, TellsWhereATestHasFewerRowsThanASlopeIsTakenOver) {
  options.columns["v_rel_mm_s"].names = {"x"};
  options.columns["v_rel_mm_s"].slope_rows = 5;
  EXPECT_THAT(read("time_s,x,sigma_n_MPa,tau_R_MPa\n1,1,9,1\n2,2,9,1\n3,3,9,1\n").notes,
              testing::Contains("v_rel_mm_s = slope over 5 rows of its column, over all of 1 of 1 "
                                "tests, which have fewer"));
}

TEST_F(Load, JoinsFilesAndTellsColumnsThatOneLacks) {
  const std::string one = file("one.csv", "sigma_n_MPa,tau_R_MPa,lot\n1,2,b\n3,4,c\n");
  const std::string two = file("two.csv", "tau_R_MPa,sigma_n_MPa,lot\n6,5,a\n8,7,b\n");
  const Dataset data = load_dataset({one, two}, options);
  EXPECT_EQ(data.experiments, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(column(data, "sigma_n_MPa"), (Values{1, 3, 5, 7}));
  EXPECT_EQ(column(data, "lot"), (Values{1, 2, 0, 1}));
  const std::string three = file("three.csv", "tau_R_MPa,sigma_n_MPa\n6,5\n8,7\n");
  EXPECT_THAT(fault_of({one, three}),
              HasSubstr("three.csv: error: there is no column lot, which one.csv has"));
  const std::string named = "experiment,sigma_n_MPa,tau_R_MPa\n7,1,2\n7,3,4\n";
  EXPECT_THAT(fault_of({file("x/one.csv", named), file("x/two.csv", named)}),
              HasSubstr("experiment '7' is in another file as well"));
}

TEST_F(Load, TellsTheFaultsOfEveryFile) {
  const std::string text = fault_of({file("one.csv", "sigma_n_MPa,tau_R_MPa\n1,x\n3,4\n"),
                                     file("two.csv", "sigma_n_MPa,tau_R_MPa\n1,2\ny,4\n")});
  EXPECT_THAT(text, HasSubstr("one.csv:2:3: error"));
  EXPECT_THAT(text, HasSubstr("two.csv:3:1: error"));
}

TEST_F(Load, ReadsHdf5ColumnsAndTellsTheirFaults) {
  const std::size_t rows[] = {2};
  const auto write = [&](double stress, std::size_t others) {
    io::Hdf5Writer out(directory_ / "a.h5");
    out.dataset("sigma_n_MPa", rows, Values{1, stress});
    out.attribute("sigma_n_MPa", "units", "GPa");
    out.dataset("tau_R_MPa", std::span(&others, 1), Values(others, 3.0));
    out.dataset("experiment", std::vector<std::string>{"a", "a"});
    out.close();
  };
  write(2, 2);
  const Dataset data = load_dataset({"a.h5"}, options);
  EXPECT_EQ(column(data, "sigma_n_MPa"), (Values{1000, 2000}));
  EXPECT_EQ(data.experiments, std::vector<std::string>{"a"});
  write(std::nan(""), 2);
  EXPECT_THAT(fault_of({"a.h5"}), HasSubstr("sigma_n_MPa (row 2): NaN stands for no value"));
  options.missing = data::Missing::drop;
  EXPECT_THAT(fault_of({"a.h5"}), HasSubstr("no fault"));
  write(2, 3);
  EXPECT_THAT(fault_of({"a.h5"}), HasSubstr("column 'tau_R_MPa' has 3 rows"));
  EXPECT_THAT(fault_of({"a.h5"}), Not(HasSubstr("no column sigma_n_MPa"))); // this one fits
  fs::resize_file(directory_ / "a.h5", fs::file_size(directory_ / "a.h5") / 2);
  EXPECT_THAT(fault_of({"a.h5"}), HasSubstr("a.h5: error: cannot be opened as HDF5"));
}

} // namespace
} // namespace frictab::load_test
