// Forms of text that rigs write: no header, equal names, steps, clocks, marks for no value.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/load_case.h"

namespace frictab::load_text_forms_test {

namespace {

using data::Dataset;
using testing::ElementsAre;
using testing::HasSubstr;

class LoadTextForms : public test::LoadCase {};

void take_by_number(data::DataOptions& options) {
  options.columns["sigma_n_MPa"].number = 1;
  options.columns["tau_R_MPa"].number = 2;
}

// ---- no header ----

TEST_F(LoadTextForms, FileWithoutAHeaderIsReadByNumber) {
  take_by_number(options);
  const std::string text = "0.05 1 2\n100;20;7\n101;21;8\n";
  options.skip_rows = 1;
  options.delimiter = ';';
  for (const std::optional<bool> header : {std::optional<bool>(), std::optional<bool>(false)}) {
    options.header = header;
    const Dataset data = read(text);
    EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(100, 101));
    EXPECT_THAT(column(data, "column_3"), ElementsAre(7, 8)) << "others are recorded";
  }
  options.header = true;
  EXPECT_THAT(fault(text), HasSubstr("data.header = false takes columns by number"));
}

TEST_F(LoadTextForms, HeaderIsNotGuessedAwayWhereNamesAreWanted) {
  take_by_number(options);
  options.columns["tau_R_MPa"] = {};
  options.columns["tau_R_MPa"].names = {"tau"};
  EXPECT_THAT(fault("100;20\n101;21\n"), HasSubstr("2 of the 2 column names in this line are "
                                                   "numbers"));
}

TEST_F(LoadTextForms, FaultOfAFileWithoutAHeaderNamesTheLine) {
  take_by_number(options);
  EXPECT_THAT(fault("100;20\n101;bad\n"), HasSubstr("a.csv:2:5: error: tau_R_MPa: 'bad'"));
  EXPECT_THAT(fault("100;20\n101\n"), HasSubstr("a.csv:2: error: 1 cells, the first row has 2"));
}

// ---- names ----

TEST_F(LoadTextForms, EqualNamesAreTakenByNumber) {
  options.columns["sigma_n_MPa"].names = {"p"};
  options.columns["tau_R_MPa"].number = 2;
  const std::string text = "t,tau,p,t,tau\n0,10,100,0,7\n1,11,101,1,8\n";
  const Dataset data = read(text);
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(10, 11));
  EXPECT_THAT(column(data, "tau (column 5)"), ElementsAre(7, 8));
  EXPECT_THAT(data.notes,
              testing::Contains("'t' of column 1 comes again and is not read: number 4"));
  options.columns["tau_R_MPa"] = {};
  options.columns["tau_R_MPa"].names = {"tau"};
  EXPECT_THAT(fault(text), testing::AllOf(HasSubstr("there are 2 columns 'tau': 2, 5"),
                                          HasSubstr("{ column = 2 }")));
}

TEST_F(LoadTextForms, NamesThatRepeatWithEqualCellsAreOneColumn) {
  options.columns["time_s"].names = {"t"};
  EXPECT_THAT(column(read("t,sigma_n_MPa,t,tau_R_MPa\n0,100,0,10\n1,101,1,11\n"), "time_s"),
              ElementsAre(0, 1));
}

TEST_F(LoadTextForms, HeaderIsFoundByNamesInFormulas) {
  options.units_row = true;
  options.columns["sigma_n_MPa"].formula = "Load_mean/2";
  options.columns["tau_R_MPa"].formula = "Drag_mean/100";
  const Dataset data =
      read("Date:;2020-01-01 10:00\nSamples:;40\n;Load mean;Drag mean\nms;N;%\n0;10;20\n1;12;22\n");
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(5, 6));
}

TEST_F(LoadTextForms, TwoLinesOfNamesAreJoined) {
  options.header_rows = 2;
  options.columns["sigma_n_MPa"].names = {"Stress normal"};
  options.columns["tau_R_MPa"].names = {"Stress shear"};
  const std::string text =
      "Stress;Stress;Time\nnormal [kPa];shear [kPa];\n1000;100;0\n1100;110;1\n";
  EXPECT_THAT(column(read(text), "sigma_n_MPa"), ElementsAre(1, 1.1));
  options.experiment = "interval";
  EXPECT_EQ(read(text + text).experiments.size(), 2u) << "both lines come again";
}

// ---- segments ----

TEST_F(LoadTextForms, SegmentsAreIntervalsWithTheirGroups) {
  options.segments = {R"(^Step (?<step>\d+): (?<oil>\w+))", "^End", {"job.toml", 3, 1}};
  options.experiment = "interval";
  const std::string text =
      "Machine 7\nsigma_n_MPa;tau_R_MPa\nStep 1: dry\n100;10\n101;11\nEnd of step\n"
      "mean;10.5\n\nStep 2: oil\nsigma_n_MPa;tau_R_MPa\n102;12\n103;13\nEnd\nbye\n";
  const Dataset data = read(text);
  EXPECT_THAT(data.experiments, ElementsAre("a 1", "a 2"));
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(10, 11, 12, 13));
  EXPECT_THAT(column(data, "step"), ElementsAre(1, 1, 2, 2));
  EXPECT_THAT(data.find("oil")->levels, ElementsAre("dry", "oil"));
  EXPECT_THAT(data.notes,
              testing::IsSupersetOf({"runs of rows between lines of data.segments: 2",
                                     "lines outside these runs, not read: 2",
                                     "lines outside these runs that hold numbers, as rows do: 1"}));
}

TEST_F(LoadTextForms, SegmentThatBeginsAboveTheHeaderHoldsTheFirstRows) {
  options.segments = {R"(^Load (?<F_N_N>[\d.]+))", "", {"job.toml", 3, 1}};
  options.constants["sigma_n_MPa"] = 5;
  options.experiment = "interval";
  const Dataset data = read("Load 20\nF_R_N\n2\n2.1\nLoad 40\nF_R_N\n4\n4.4\n");
  EXPECT_THAT(column(data, "F_N_N"), ElementsAre(20, 20, 40, 40));
  EXPECT_EQ(data.experiments.size(), 2u);
}

TEST_F(LoadTextForms, ASegmentThatNeverBeginsLeavesNoRows) {
  options.segments = {"^Step", "", {"job.toml", 3, 1}};
  EXPECT_THAT(fault("sigma_n_MPa;tau_R_MPa\n100;10\n"), HasSubstr("no rows"));
}

// ---- merged cells ----

TEST_F(LoadTextForms, EmptyCellsBelowAFilledOneHaveItsValueWhereTheJobSaysSo) {
  const std::string text =
      "Oil;sigma_n_MPa;tau_R_MPa;t / degC\nA;100;10;20\n;101;11;\nB;102;12;30\n"
      ";103;13;\n";
  options.fill_down = {"Oil", "t"};
  const Dataset data = read(text);
  EXPECT_THAT(data.find("Oil")->levels, ElementsAre("A", "B"));
  EXPECT_THAT(column(data, "t / degC"), ElementsAre(20, 20, 30, 30));
  EXPECT_THAT(data.notes,
              testing::Contains("Oil: empty cells with the value above (data.fill_down): 2"));
  options.fill_down = {};
  EXPECT_EQ(read(text).find("Oil")->levels.size(), 3u) << "never without the key";
}

// ---- marks for no value ----

TEST_F(LoadTextForms, ASegmentThatBeginsBelowTheUnitsHoldsItsRows) {
  options.segments = {R"(^\d+ (?<title>\w+))", "", {"job.toml", 3, 1}};
  options.units_row = true;
  const Dataset data =
      read("sigma_n_MPa,tau_R_MPa\nMPa,MPa\n1 Green\n100,10\n2 Fade\n101,11\n102,12\n");
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(10, 11, 12));
  EXPECT_THAT(data.notes, testing::Contains("runs of rows between lines of data.segments: 2"));
  EXPECT_THAT(data.notes, testing::Not(testing::Contains(HasSubstr("outside these runs"))));
}

TEST_F(LoadTextForms, ZeroValuesBelowTheUnitsAreNoRow) {
  options.units_row = true;
  const Dataset data = read("time_s;sigma_n_MPa;tau_R_MPa\ns;MPa;MPa\nSR=50 Hz;CH 1;CH 2\n"
                            "Nullwert;0.0;-12.3\n0;100;10\n1;101;11\n");
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(10, 11));
  EXPECT_THAT(data.notes, testing::Contains("lines of words below the units, not read: 2"));
  EXPECT_THAT(fault("time_s;sigma_n_MPa;tau_R_MPa\ns;MPa;MPa\nNaN;100;10\n1;101;11\n2;102;12\n"),
              HasSubstr("NaN"))
      << "a lost value is reported";
}

// ---- lines above the rows ----

TEST_F(LoadTextForms, ConditionsAboveTheRowsMayStandBetweenCommas) {
  options.above = {"Temperature"};
  options.columns["F_N_N"].names = {"Sled weight"};
  options.constants["sigma_n_MPa"] = 5;
  for (const std::string sled : {"Sled weight,1.961,N", R"("Sled weight","1.961","N")"}) {
    const Dataset data =
        read(sled + "\n# Temperature,23.0,C\nDate,\"3/4/2026 2:01:15 PM\"\nF_R_N\n1\n2\n");
    EXPECT_THAT(column(data, "F_N_N"), ElementsAre(1.961, 1.961));
    EXPECT_THAT(column(data, "Temperature"), ElementsAre(23, 23));
  }
}

TEST_F(LoadTextForms, AConditionIsFoundUnderItsWholeNameBesideAColumn) {
  options.above = {"Normal stress (kPa)"};
  options.constants["sigma_n_MPa"] = 5;
  const Dataset data =
      read("Normal stress (kPa): 50\n\nNormal stress [kPa];tau_R_MPa\n49;1\n51;2\n");
  EXPECT_THAT(column(data, "Normal stress (kPa)"), ElementsAre(50, 50));
}

TEST_F(LoadTextForms, AWordOfAFormulaInTheFirstLineIsNotTheHeader) {
  options.columns["v_rel_mm_s"].formula = "2*15*Frequency";
  const Dataset data = read("Some Ltd\tTE 77 High Frequency Machine\nFrequency (Hz):\t5\n"
                            "sigma_n_MPa\ttau_R_MPa\n100\t10\n101\t11\n");
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(150, 150));
}

// ---- no value ----

TEST_F(LoadTextForms, DroppedRowsLeaveTheSlopesOfOthersAlone) {
  options.missing = data::Missing::drop;
  options.missing_values = {"Nullwert"};
  options.columns["v_rel_mm_s"].names = {"x"};
  options.columns["v_rel_mm_s"].slope_rows = 3;
  const Dataset data = read("time_s,x,sigma_n_MPa,tau_R_MPa\nNullwert,0,100,10\n0,0,100,10\n"
                            "1,5,100,10\n2,10,100,10\n3,15,100,10\n");
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(5, 5, 5, 5));
  ASSERT_EQ(data.dropped.size(), 1u);
  EXPECT_EQ(data.dropped[0].rows, 1u);
}

TEST_F(LoadTextForms, MarksForNoValueAreEmptyCells) {
  options.missing_values = {"OVER", "-9999"};
  options.missing = data::Missing::drop;
  const Dataset data =
      read("sigma_n_MPa,tau_R_MPa,Ra\n100,10,1\n101,OVER,1\n-9999.0,11,1\n102,12,-9999\n");
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(100, 102));
  EXPECT_TRUE(std::isnan(column(data, "Ra")[1]));
  EXPECT_THAT(data.notes, testing::Contains(HasSubstr(
                              "tau_R_MPa: 1 of 4 cells are empty by data.missing_values")));
  options.missing_values = {"-9999"};
  EXPECT_THAT(fault("sigma_n_MPa,tau_R_MPa\n100,10\n101,OVER\n"),
              HasSubstr("'OVER' is not a number"));
}

// ---- clocks ----

TEST_F(LoadTextForms, ClockTimesAreSecondsSinceTheFirst) {
  const std::string rows = ";100;10\n";
  const auto times = [&](const std::string& a, const std::string& b) {
    const Dataset data = read("time_s;sigma_n_MPa;tau_R_MPa\n" + a + rows + b + rows);
    return column(data, "time_s")[1];
  };
  EXPECT_EQ(times("14:03:05,120", "14:03:06,240"), 1.12);
  EXPECT_EQ(times("23:59:59", "00:00:01"), 2) << "past midnight";
  EXPECT_EQ(times("0:59.5", "1:00.25"), 0.75);
  EXPECT_EQ(times("2026-03-02 14:03:05.5", "2026-03-02 14:03:06"), 0.5);
  EXPECT_EQ(times("02.03.2026 23:59:59", "03.03.2026 00:00:01"), 2);
  EXPECT_EQ(times("3/2/2026 1:00:00 PM", "3/2/2026 1:00:01 PM"), 1);
}

TEST_F(LoadTextForms, MillisecondsInAColumnOfTheirOwnBelongToTheClock) {
  const Dataset data = read("time_s;ms;sigma_n_MPa;tau_R_MPa\n10:00:01;900;100;10\n"
                            "10:00:01;950;100;10\n10:00:02;0;100;10\n");
  EXPECT_THAT(column(data, "time_s"),
              ElementsAre(0, testing::DoubleNear(0.05, 1e-9), testing::DoubleNear(0.1, 1e-9)));
}

TEST_F(LoadTextForms, ALineOfSumsBelowNumberedTestsIsAFault) {
  options.experiment = "Test";
  const std::string text =
      "Test;sigma_n_MPa;tau_R_MPa\n1;100;10\n2;101;11\n3;102;12\n\nMean;101;11\n";
  EXPECT_THAT(fault(text), testing::AllOf(HasSubstr("a.csv:6: error: 'Mean' sums up the tests"),
                                          HasSubstr("data.skip_footer = 1")));
  options.skip_footer = 1;
  EXPECT_EQ(read(text).experiments.size(), 3u);
}

TEST_F(LoadTextForms, ATextAmongClockTimesIsAFaultInItsPlace) {
  EXPECT_THAT(fault("time_s;sigma_n_MPa;tau_R_MPa\n14:03:05;100;10\nlater;101;11\n"),
              HasSubstr("a.csv:3:1: error: time_s: 'later' is not a time, as others are"));
}

} // namespace

} // namespace frictab::load_text_forms_test
