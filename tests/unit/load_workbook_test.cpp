// Campaigns in workbooks: which sheets are tests, and in which units.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/workbook.h"
#include "unit/load_case.h"

namespace frictab::load_workbook_test {

namespace {

using data::Dataset;
using data::load_dataset;
using test::number_cell;
using test::text_cell;
using test::xml_rows;
using test::XmlSheet;
using testing::ElementsAre;
using testing::HasSubstr;

// Rows of one test under a title; its stresses tell it apart.
std::string rows_of(int test) {
  return xml_rows(fmt::format("Rig 7\nsigma_n_MPa;tau_R_MPa;Ra\n100;{0};1\n101;{0}.5;1\n", test));
}

class LoadWorkbook : public test::LoadCase {
protected:
  void book(const std::string& name, const std::vector<XmlSheet>& sheets) {
    test::write_workbook(directory_ / name, {sheets});
  }
  Dataset read_book() { return load_dataset({"a.xlsx"}, options); }
};

TEST_F(LoadWorkbook, EverySheetWithFrictionIsATestByItsName) {
  book("a.xlsx", {{"Cover", xml_rows("Order 4711\n")},
                  {"T 1", rows_of(10)},
                  {"T2", rows_of(20)},
                  {"Sums", xml_rows("sigma_n_MPa;mean\n1;2\n3;4\n")},
                  {"old", rows_of(30), "", "hidden"}});
  const Dataset data = read_book();
  EXPECT_THAT(data.experiments, ElementsAre("T 1", "T2"));
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(10, 10.5, 20, 20.5));
  EXPECT_THAT(data.notes, testing::Contains("a.xlsx: 2 sheets read, not read: 'Cover' (no rows "
                                            "under a header), 'Sums' (no column of friction)"));
  EXPECT_THAT(data.sources, ElementsAre("a.xlsx/T 1", "a.xlsx/T2"));
}

TEST_F(LoadWorkbook, SheetsAreChosenByNameByPatternAndByList) {
  book("a.xlsx", {{"A1", rows_of(10)}, {"A2", rows_of(20)}, {"B1", rows_of(30)}});
  options.sheets = {"A2"};
  EXPECT_THAT(column(read_book(), "tau_R_MPa"), ElementsAre(20, 20.5));
  options.sheets = {"A*"};
  EXPECT_THAT(read_book().experiments, ElementsAre("A1", "A2"));
  options.sheets = {"B1", "A1"};
  EXPECT_THAT(read_book().experiments, ElementsAre("A1", "B1")) << "in the order of their tabs";
  options.sheets = {"*"};
  EXPECT_EQ(read_book().experiments.size(), 3u);
  options.sheets = {"C*"};
  EXPECT_THAT(fault_of({"a.xlsx"}), HasSubstr("a.xlsx: error: holds no sheet 'C*'"));
}

TEST_F(LoadWorkbook, RulesChooseSheetsOfTheirFiles) {
  book("a.xlsx", {{"A1", rows_of(10)}, {"A2", rows_of(20)}});
  book("b.xlsx", {{"A1", rows_of(30)}, {"A2", rows_of(40)}});
  data::FileRule rule;
  rule.match = "b.*";
  rule.sheets = {"A2"};
  options.files = {rule};
  EXPECT_THAT(load_dataset({"a.xlsx", "b.xlsx"}, options).experiments,
              ElementsAre("A1", "a/A2", "b/A2"));
}

TEST_F(LoadWorkbook, RulesMatchSheetsByTheirNames) {
  book("a.xlsx", {{"dry 1", rows_of(10)}, {"oil 1", rows_of(20)}});
  data::FileRule rule;
  rule.labels = {{"film", "oil"}};
  for (const char* const match : {"oil*", "a.xlsx/oil*"}) {
    rule.match = match;
    data::FileRule other = rule;
    other.match = "*";
    other.labels = {{"film", "none"}};
    options.files = {rule, other};
    const Dataset data = read_book();
    EXPECT_THAT(data.find("film")->levels, testing::UnorderedElementsAre("none", "oil")) << match;
  }
}

TEST_F(LoadWorkbook, NamesOfSheetsGiveConditions) {
  book("a.xlsx", {{"v5_1", rows_of(10)}, {"v50_1", rows_of(20)}});
  data::FileRule rule;
  rule.match = "*";
  rule.from_name = R"(/v(?<v_rel_mm_s>\d+)_\d+$)";
  options.files = {rule};
  EXPECT_THAT(column(read_book(), "v_rel_mm_s"), ElementsAre(5, 5, 50, 50));
}

TEST_F(LoadWorkbook, FaultsNameSheetRowAndColumn) {
  book("a.xlsx",
       {{"T1", rows_of(10)}, {"T2", xml_rows("sigma_n_MPa;tau_R_MPa\n100;10\n101;bad\n")}});
  EXPECT_THAT(fault_of({"a.xlsx"}), HasSubstr("a.xlsx/T2:3:5: error: tau_R_MPa: 'bad' is not a "
                                              "number"));
}

TEST_F(LoadWorkbook, SheetOfTestsIsJoinedAndIsNoTest) {
  options.columns["experiment"].names = {"Versuch"};
  options.experiment = "file";
  book("a.xlsx", {{"Plan", xml_rows("Versuch;v_rel_mm_s\nT1;5\nT2;50\n")},
                  {"T1", rows_of(10)},
                  {"T2", rows_of(20)}});
  options.tests = "a.xlsx";
  EXPECT_THAT(column(read_book(), "v_rel_mm_s"), ElementsAre(5, 5, 50, 50));
  options.sheets = {"*"};
  EXPECT_EQ(read_book().experiments.size(), 2u) << "the sheet of data.tests is not one of them";
  options.tests_sheet = "Plan";
  EXPECT_EQ(read_book().experiments.size(), 2u);
}

TEST_F(LoadWorkbook, ARowWithoutItsLastCellsIsPadded) {
  options.units_row = true;
  book("a.xlsx", {{"T1", xml_rows("sigma_n_MPa;tau_R_MPa;Ra;Remarks\nMPa;MPa;um\n100;10;1\n"
                                  "101;11;;worn\n102;12\n")}});
  const Dataset data = read_book();
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(10, 11, 12));
  EXPECT_THAT(data.find("Remarks")->levels, ElementsAre("", "worn"));
  EXPECT_THAT(data.notes, testing::Contains("Ra: 2 of 3 rows without a value"));
}

TEST_F(LoadWorkbook, APlanOfTestsMayLackItsLastCellsAndHaveALegend) {
  options.columns["experiment"].names = {"Versuch"};
  options.experiment = "file";
  book("a.xlsx", {{"Plan", xml_rows("Versuch;v_rel_mm_s;Oil;Bemerkung\nT1;5;MH\nT2;50;RP;new die\n"
                                    "\nLegend: MH = mineral oil\n")},
                  {"T1", rows_of(10)},
                  {"T2", rows_of(20)}});
  options.tests = "a.xlsx";
  const Dataset data = read_book();
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(5, 5, 50, 50));
  EXPECT_THAT(data.notes,
              testing::Contains("a.xlsx: a line below the last row is not read: one text alone"));
}

TEST_F(LoadWorkbook, TitlesBetweenRowsAreAFaultThatNamesSegments) {
  const std::string rows =
      "sigma_n_MPa;tau_R_MPa;Ra\n1 Green mu\n100;10;1\n2 Fade test\n101;11;1\n";
  book("a.xlsx", {{"T1", xml_rows(rows)}});
  EXPECT_THAT(fault_of({"a.xlsx"}),
              testing::AllOf(HasSubstr("1 cells, the header has 3 (and 1 more line)"),
                             HasSubstr("Cut the rows at them with data.segments")));
  options.segments = {R"(^\d+ (?<title>\w+))", "", {"job.toml", 3, 1}};
  EXPECT_THAT(read_book().find("title")->levels, ElementsAre("Fade", "Green"))
      << "without the quotes that cells with blanks have as text";
}

TEST_F(LoadWorkbook, APairOfCellsAfterAnEmptyOneIsAnotherCondition) {
  options.above = {"Tool no.", "Lubricant"};
  book("a.xlsx", {{"T1", xml_rows("Tool no.;GS-14;;Lubricant;Zn, soap\nsigma_n_MPa;tau_R_MPa\n"
                                  "100;10\n101;11\n")}});
  const Dataset data = read_book();
  EXPECT_THAT(data.find("Tool no.")->levels, ElementsAre("GS-14"));
  EXPECT_THAT(data.find("Lubricant")->levels, ElementsAre("Zn, soap"));
}

TEST_F(LoadWorkbook, SecondWorkbookIsATableOfTests) {
  options.columns["experiment"].names = {"Versuch"};
  options.experiment = "file";
  book("a.xlsx", {{"T1", rows_of(10)}, {"T2", rows_of(20)}});
  book("plan.xlsx", {{"Info", xml_rows("Rig\n")},
                     {"Plan", xml_rows("Versuch;v_rel_mm_s\nT1;5\nT2;50\n")},
                     {"Copy", xml_rows("Versuch;v_rel_mm_s\nT1;5\nT2;50\n")}});
  options.tests = "plan.xlsx";
  EXPECT_THAT(
      fault_of({"a.xlsx"}),
      testing::AllOf(HasSubstr("plan.xlsx: error: 2 of its sheets may be the table of tests"),
                     HasSubstr("data.tests_sheet names it")));
  options.tests_sheet = "Plan";
  EXPECT_THAT(column(read_book(), "v_rel_mm_s"), ElementsAre(5, 5, 50, 50));
}

TEST_F(LoadWorkbook, PercentAndTimesHaveTheUnitsOfTheirCells) {
  const std::string rows =
      test::xml_row(1, {text_cell("time_s"), text_cell("psi [%]"), text_cell("sigma_n_MPa"),
                        text_cell("tau_R_MPa")}) +
      test::xml_row(2, {number_cell("5.787037037037037e-07", 1), number_cell("1.5", 2),
                        number_cell("100"), number_cell("10")}) +
      test::xml_row(3, {number_cell("1.157407407407407e-06", 1), number_cell("1.6", 2),
                        number_cell("101"), number_cell("11")});
  test::write_workbook(directory_ / "a.xlsx", {{{"1", rows}}, {"mm:ss.0", "0%"}});
  const Dataset data = read_book();
  EXPECT_THAT(column(data, "time_s"), ElementsAre(0.05, 0.1));
  EXPECT_THAT(column(data, "psi"), ElementsAre(1.5, 1.6));
  EXPECT_THAT(data.notes, testing::IsSupersetOf({"time_s: shown as times, taken in s",
                                                 "psi [%]: shown in percent, taken as fractions"}));
}

TEST_F(LoadWorkbook, DatesAreTimesOfRows) {
  const std::string rows =
      test::xml_row(1, {text_cell("time_s"), text_cell("sigma_n_MPa"), text_cell("tau_R_MPa")}) +
      test::xml_row(2, {number_cell("46083.5", 1), number_cell("100"), number_cell("10")}) +
      test::xml_row(3, {number_cell("46083.50001", 1), number_cell("101"), number_cell("11")});
  test::write_workbook(directory_ / "a.xlsx", {{{"1", rows}}, {"dd.mm.yyyy hh:mm:ss"}});
  EXPECT_THAT(column(read_book(), "time_s"), ElementsAre(0, 0.864));
}

TEST_F(LoadWorkbook, ColumnThatMixesKindsIsAFault) {
  const std::string rows =
      test::xml_row(1, {text_cell("time_s"), text_cell("sigma_n_MPa"), text_cell("tau_R_MPa")}) +
      test::xml_row(2, {number_cell("0.1", 1), number_cell("100"), number_cell("10")}) +
      test::xml_row(3, {number_cell("12"), number_cell("101"), number_cell("11")});
  test::write_workbook(directory_ / "a.xlsx", {{{"1", rows}}, {"mm:ss.0"}});
  EXPECT_THAT(fault_of({"a.xlsx"}), HasSubstr("a.xlsx:3: error: column 'time_s' mixes number "
                                              "formats"));
}

TEST_F(LoadWorkbook, TwoLinesOfNamesWithMergedCellsAreJoined) {
  const std::string rows =
      xml_rows("Kraft;;Spannung [MPa]\nNormal [kN];Reib [N];\n1;100;50\n1.1;110;"
               "51\n");
  book("a.xlsx",
       {{"1", rows,
         "<mergeCells><mergeCell ref=\"A1:B1\"/><mergeCell ref=\"C1:C2\"/></mergeCells>"}});
  options.header_rows = 2;
  options.columns["F_N_N"].names = {"Kraft Normal"};
  options.columns["F_R_N"].names = {"Kraft Reib"};
  options.columns["sigma_n_MPa"].names = {"Spannung"};
  const Dataset data = read_book();
  EXPECT_THAT(column(data, "F_N_N"), ElementsAre(1000, 1100));
  EXPECT_THAT(column(data, "sigma_n_MPa"), ElementsAre(50, 51));
}

TEST_F(LoadWorkbook, ATextWithTheNameOfAWorkbookIsRefused) {
  file("b.xlsx", "sigma_n_MPa,tau_R_MPa\n1,2\n");
  EXPECT_THAT(fault_of({"b.xlsx"}),
              HasSubstr("b.xlsx: error: has the name of a workbook and is none"));
  file("c.xls", "sigma_n_MPa\ttau_R_MPa\n100\t20\n101\t21\n");
  EXPECT_EQ(load_dataset({"c.xls"}, options).rows(), 2u) << "rigs call texts so";
}

} // namespace

} // namespace frictab::load_workbook_test
