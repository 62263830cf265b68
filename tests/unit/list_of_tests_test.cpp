// Tables of tests as people write them: units, legends, names of files, a dialect of their own.
#include <gmock/gmock.h>

#include "data/test_table.h"
#include "support/workbook.h"
#include "unit/load_case.h"

namespace frictab::list_of_tests_test {
namespace {

using data::Dataset;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class ListOfTests : public test::LoadCase {
protected:
  static constexpr const char* rows = "time_s,tau_R_MPa,sigma_n_MPa\n0,1,5\n1,2,5\n";

  // Three tests with this table of tests.
  Dataset with_list(const std::string& list, const std::string& text) {
    options.tests = list.ends_with(".xlsx") ? list : file(list, text);
    options.columns["experiment"].names = {"Test"};
    options.experiment = "file";
    for (const char* const name : {"a_01.csv", "a_02.csv", "a_03.csv"})
      file(name, rows);
    return data::load_dataset({"a_01.csv", "a_02.csv", "a_03.csv"}, options);
  }
};

TEST_F(ListOfTests, LegendBelowTheRowsIsPassedOver) {
  for (const char* const legend :
       {"\nLegend\nA,mineral oil\n", "\nA,mineral oil,,\nB,\"rape seed, raw\",,\n",
        "Legend: A is oil,,,\nA,B,,\n", "\nall at 23 degC\n"}) {
    const Dataset data = with_list(
        "plan.csv",
        std::string("Test,Oil,Load,Remark\na_01,A,5,\na_02,A,7,\na_03,B,9,late\n") + legend);
    EXPECT_THAT(column(data, "Load"), ElementsAre(5, 5, 7, 7, 9, 9)) << legend;
    EXPECT_THAT(data.notes, Contains(HasSubstr("not read"))) << legend;
  }
}

TEST_F(ListOfTests, LegendOfAWorkbookIsPassedOverAndMergedCellsAreFilled) {
  test::write_workbook(
      directory_ / "plan.xlsx",
      test::XmlWorkbook{{test::XmlSheet{
          "Plan",
          test::xml_rows("Test;Pin;Load\na_01;Cu;5\na_02;;7\na_03;Fe;9\n\nLegend\nCu;bronze\n"),
          "<mergeCells><mergeCell ref=\"B2:B3\"/></mergeCells>"}}});
  const Dataset data = with_list("plan.xlsx", "");
  EXPECT_THAT(column(data, "Load"), ElementsAre(5, 5, 7, 7, 9, 9));
  EXPECT_THAT(data.find("Pin")->levels, ElementsAre("Cu", "Fe"));
}

TEST_F(ListOfTests, TestBelowAnEmptyLineStaysATest) {
  const Dataset data = with_list("plan.csv", "Test,Oil,Load\na_01,A,5\na_02,A,7\n\na_03,B,9\n");
  EXPECT_THAT(column(data, "Load"), ElementsAre(5, 5, 7, 7, 9, 9));
}

TEST_F(ListOfTests, UnitsBelowTheNamesAreTaken) {
  options.columns["v_rel_mm_s"].names = {"Speed"};
  const Dataset data =
      with_list("plan.csv", "Test,Speed,Oil\n,m/s,\na_01,0.1,A\na_02,0.1,B\na_03,0.2,B\n");
  EXPECT_THAT(column(data, "v_rel_mm_s"), ElementsAre(100, 100, 100, 100, 200, 200));
}

TEST_F(ListOfTests, NamesOfFilesAreThoseOfTheirTests) {
  const Dataset data =
      with_list("plan.csv", "Test,Load\nrig/a_1.csv,5\nC:\\rig\\A_2.csv,7\na_03.csv,9\n");
  EXPECT_THAT(column(data, "Load"), ElementsAre(5, 5, 7, 7, 9, 9));
  EXPECT_THAT(data.notes, Contains("plan.csv: tests are found by the names of their files"));
  EXPECT_EQ(data::test_key("BoR/bor_007.csv"), "bor_7");
  EXPECT_EQ(data::test_key("v1.5"), "v1.5");
  EXPECT_EQ(data::test_key("T_100"), "t_100");
  EXPECT_EQ(data::test_key("0"), "0");
}

TEST_F(ListOfTests, RuleThatNamesTheTableGivesItsDialect) {
  options.files.emplace_back();
  options.files[0].match = "plan.csv";
  options.files[0].decimal = ',';
  options.files[0].skip_rows = 1;
  const Dataset data =
      with_list("plan.csv", "Test;plan\nTest;Load\na_01;5,5\na_02;7,5\na_03;9,5\n");
  EXPECT_THAT(column(data, "Load"), ElementsAre(5.5, 5.5, 7.5, 7.5, 9.5, 9.5));
}

} // namespace
} // namespace frictab::list_of_tests_test
