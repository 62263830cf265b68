// What a data file holds and nothing reads is told, or refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stats/blocks.h"
#include "trace/columns/candidates.h"
#include "unit/load_case.h"

namespace frictab::told_data_test {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

class ToldData : public test::LoadCase {};

const std::string rows = "time_s,sigma_n_MPa,tau_R_MPa,psi\n0,500,50,1\n1,600,55,2\n";

TEST_F(ToldData, AConstantThatGoesBeforeAColumnIsToldWithItsRows) {
  options.constants["psi"] = 2.5;
  const data::Dataset data = read(rows);
  EXPECT_EQ(column(data, "psi"), (std::vector<double>{2.5, 2.5}));
  EXPECT_THAT(data.notes, Contains("psi is 2.5 in all 2 rows, as the job says: the file's own "
                                   "column 'psi' is not read"));
}

TEST_F(ToldData, AConstantWithoutAColumnNeedsNoNote) {
  options.constants["sigma_f_MPa"] = 400;
  for (const std::string& note : read(rows).notes)
    EXPECT_THAT(note, Not(HasSubstr("sigma_f_MPa"))) << note;
}

TEST_F(ToldData, AColumnCalledAsAQuantityButForCaseIsAFaultThatNamesBoth) {
  EXPECT_THAT(fault("time_s,sigma_n_MPa,tau_R_MPa,TAU_R_MPA\n0,500,50,50\n1,600,55,55\n"),
              AllOf(HasSubstr("a.csv:1: error: column 'TAU_R_MPA' differs from tau_R_MPa only in "
                              "upper and lower case, which is there as well"),
                    HasSubstr("[data.columns] tau_R_MPa = \"TAU_R_MPA\"")));
  EXPECT_THAT(fault("time_s,sigma_n_MPa,tau_R_MPa,Psi [-]\n0,500,50,1\n1,600,55,1\n"),
              HasSubstr("column 'Psi [-]' differs from psi only in upper and lower case\n"));
}

TEST_F(ToldData, AColumnOfOtherCaseThatIsMappedOrLeftOutIsNoFault) {
  const std::string text = "time_s,sigma_n_MPa,TAU_R_MPA,PSI\n0,500,50,1\n1,600,55,2\n";
  options.columns["tau_R_MPa"].names = {"TAU_R_MPA"};
  options.bystanders = std::vector<std::string>{};
  EXPECT_EQ(column(read(text), "tau_R_MPa"), (std::vector<double>{50, 55}));
}

TEST_F(ToldData, ColumnsWithoutANameAreToldWhereTheyHoldAnything) {
  const data::Dataset data =
      read(",time_s,sigma_n_MPa,,tau_R_MPa,,\n0,0,500,x,50,,\n1,1,600,y,55,,\n");
  EXPECT_THAT(data.notes, Contains("2 columns without a name are not read: number 1, 4"));
  for (const std::string& note :
       read("time_s,sigma_n_MPa,tau_R_MPa,,\n0,500,50,,\n1,6,5,,\n").notes)
    EXPECT_THAT(note, Not(HasSubstr("without a name"))) << note;
}

TEST_F(ToldData, AColumnWithoutANameCanBeTakenByItsNumber) {
  options.columns["psi"].number = 4;
  EXPECT_EQ(column(read("time_s,sigma_n_MPa,tau_R_MPa,\n0,500,50,1\n1,600,55,2\n"), "psi"),
            (std::vector<double>{1, 2}));
  EXPECT_THAT(fault("time_s,sigma_n_MPa,tau_R_MPa,\n0,500,50\n1,600,55,2\n"),
              HasSubstr("psi: the cell is empty"));
}

TEST_F(ToldData, AColumnOfAFewRemarksIsText) {
  const data::Dataset data =
      read("time_s,sigma_n_MPa,tau_R_MPa,remark\n0,5,1,\n1,6,2,\n2,7,3,slips\n"
           "3,7,3,\n4,7,3,NA\n5,7,3,\n6,7,3,\n");
  EXPECT_THAT(data.find("remark")->levels, ElementsAre("", "NA", "slips"));
  EXPECT_THAT(data.notes, Contains("remark: 6 of 7 rows without a value: a level of their own"));
  EXPECT_THAT(fault("time_s,sigma_n_MPa,tau_R_MPa,x\n0,5,1,\n1,6,2,2\n2,7,3,slips\n3,7,3,3\n"
                    "4,7,3,4\n5,7,3,5\n"),
              HasSubstr("x: 'slips' is not a number, as most of the column is"));
}

TEST_F(ToldData, AColumnThatIsEmptyInOneFileIsOfTheKindOfTheOthers) {
  const std::string head = "time_s,sigma_n_MPa,tau_R_MPa,tool,room\n";
  const std::string empty = file("empty.csv", head + "0,5,1,,\n1,6,2,,\n");
  const std::string full = file("full.csv", head + "0,5,1,b,20\n1,6,2,a,21\n");
  for (const auto& files : {std::vector{empty, full}, std::vector{full, empty}}) {
    const data::Dataset data = data::load_dataset(files, options);
    EXPECT_THAT(data.find("tool")->levels, ElementsAre("", "a", "b"));
    EXPECT_TRUE(data.find("room")->levels.empty());
    const std::size_t first = 0; // tests are sorted by name
    EXPECT_EQ(data.values("tool")[first], 0);
    EXPECT_EQ(data.values("tool")[first + 1], 0);
  }
}

TEST_F(ToldData, CountsOfSeveralFilesAreOneOverAllTheirRows) {
  const std::string head = "time_s,sigma_n_MPa,tau_R_MPa,room\n";
  const std::vector<std::string> files = {file("a.csv", head + "0,5,1,\n1,6,2,20\n"),
                                          file("b.csv", head + "0,5,1,\n1,6,2,21\n"),
                                          file("c.csv", head + "0,5,1,22\n1,6,2,21\n")};
  EXPECT_THAT(data::load_dataset(files, options).notes,
              Contains("room: 2 of 6 rows without a value"));
  options.condense = {1};
  EXPECT_THAT(data::load_dataset(files, options).notes,
              Contains("room: 2 of 6 rows without a value"));
}

TEST_F(ToldData, EmptyCellsOfATextColumnAreALevelAndCounted) {
  EXPECT_THAT(read("time_s,sigma_n_MPa,tau_R_MPa,tool\n0,5,1,a\n1,6,2,\n2,7,3,b\n").notes,
              Contains("tool: 1 of 3 rows without a value: a level of their own"));
}

TEST_F(ToldData, EmptyCellsOfAnotherColumnAreCountedAndTracingLeavesItOut) {
  const data::Dataset data = read("experiment,time_s,sigma_n_MPa,tau_R_MPa,extra,room_C\n"
                                  "A,0,500,50,,20\nA,1,600,55,2,21\nB,0,500,50,3,22\n"
                                  "B,1,600,55,4,23\n");
  EXPECT_THAT(data.notes, Contains("extra: 1 of 4 rows without a value"));
  const stats::Blocks blocks = stats::make_blocks(data);
  const std::vector<double> predicted(data.rows(), 50);
  const trace::Candidates found =
      trace::find_candidates(data, data, blocks, predicted, {"sigma_n_MPa"}, {});
  EXPECT_THAT(found.notes, Contains("extra: 1 of 4 rows without a value: not searched"))
      << "the same tests are counted once";
  for (const trace::CandidateColumn& one : found.columns)
    EXPECT_NE(one.name, "extra");
}

} // namespace
} // namespace frictab::told_data_test
