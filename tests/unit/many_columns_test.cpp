// What grows with the square of the number of columns, or with columns that are not there, would
// take minutes here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "core/random.h"
#include "core/text.h"
#include "stats/blocks.h"
#include "trace/columns/candidates.h"
#include "unit/load_case.h"

namespace frictab::many_columns_test {
namespace {

using testing::HasSubstr;

class ManyColumns : public test::LoadCase {
protected:
  static constexpr std::size_t columns = 100'000;

  // Two tests of two rows, with as many columns that no law uses.
  static std::string text(const std::string& tests = "AABB") {
    std::string out = "experiment,time_s,sigma_n_MPa,tau_R_MPa";
    for (std::size_t i = 0; i < columns; ++i)
      out += fmt::format(",c{}", i);
    for (std::size_t row = 0; row < tests.size(); ++row) {
      out += fmt::format("\n{},{},500,50", tests[row], row);
      for (std::size_t i = 0; i < columns; ++i)
        out += ",1";
    }
    return out + "\n";
  }
};

TEST_F(ManyColumns, AreRead) {
  const data::Dataset data = read(text());
  EXPECT_EQ(data.columns.size(), columns + 5); // interval and recording: the clock goes on
  EXPECT_EQ(data.rows(), 4u);
}

TEST_F(ManyColumns, OfTwoFilesAreJoined) {
  file("b.csv", text("CCDD"));
  file("a.csv", text());
  const data::Dataset data = data::load_dataset({"a.csv", "b.csv"}, options);
  EXPECT_EQ(data.columns.size(), columns + 5); // interval and recording: the clock goes on
  EXPECT_EQ(data.rows(), 8u);
}

TEST_F(ManyColumns, OfATableOfTestsAreJoined) {
  std::string tests = "experiment", a = "\nA", b = "\nB";
  for (std::size_t i = 0; i < columns; ++i) {
    tests += fmt::format(",d{}", i);
    a += ",1";
    b += ",2";
  }
  options.tests = file("tests.csv", tests + a + b + "\n");
  EXPECT_EQ(read("experiment,time_s,sigma_n_MPa,tau_R_MPa\nA,0,500,50\nA,1,500,50\nB,0,500,50\n"
                 "B,1,500,50\n")
                .columns.size(),
            columns + 3);
}

TEST_F(ManyColumns, OfOneNameAreOneNoteOrOneFault) {
  std::string names = "experiment,time_s,sigma_n_MPa,tau_R_MPa", row = "\nA,0,500,50";
  for (std::size_t i = 0; i < columns; ++i) {
    names += ",extra";
    row += ",1";
  }
  const auto notes = read(names + row + row + "\n").notes;
  EXPECT_THAT(notes, testing::Contains(HasSubstr("'extra' of column 5 comes again and is not read: "
                                                 "number 6, 7, ")));
  EXPECT_LT(join(notes, "").size(), 2000u);
  options.columns["psi"].names = {"extra"};
  const std::string said = fault(names + row + replace_all(row, "50,1", "50,2") + "\n");
  EXPECT_THAT(said, HasSubstr("there are 100000 columns 'extra': 5, 6, 7, "));
  EXPECT_LT(said.size(), 2000u);
}

TEST_F(ManyColumns, WithShortLinesCostWhatTheLinesHold) {
  std::string short_lines = text();
  for (std::size_t i = 0; i < columns; ++i)
    short_lines += "1\n";
  EXPECT_THAT(fault(short_lines), HasSubstr("a.csv:6: error: 1 cells, the header has 100004 (and "
                                            "99,999 more lines)"));
}

TEST_F(ManyColumns, WithoutANameAndACellCostNothing) {
  std::string commas = "experiment,time_s,sigma_n_MPa,tau_R_MPa" + std::string(columns, ',');
  for (std::size_t row = 0; row < columns; ++row)
    commas += fmt::format("\nA,{},500,50", row);
  EXPECT_EQ(read(commas + "\n").columns.size(), 3u);
}

TEST_F(ManyColumns, BelowABlankLineTakeNoMoreMemoryThanTheyHold) {
  std::string with_blank = text();
  with_blank.insert(with_blank.find('\n'), "\n");
  EXPECT_EQ(read(with_blank).rows(), 4u);
}

// Half a million pairs of a thousand columns would hold gigabytes.
TEST_F(ManyColumns, AreNotTracedInPairsOfEachOther) {
  constexpr std::size_t others = 1000;
  std::string text = "experiment,time_s,sigma_n_MPa,tau_R_MPa";
  for (std::size_t i = 0; i < others; ++i)
    text += fmt::format(",c{}", i);
  Random random(1);
  for (std::size_t row = 0; row < 12; ++row) {
    text += fmt::format("\n{},{},{},50", "ABC"[row / 4], row, 500 + 10 * row);
    for (std::size_t i = 0; i < others; ++i)
      text += fmt::format(",{:.6f}", random.uniform());
  }
  const data::Dataset data = read(text + "\n");
  const trace::Candidates found =
      trace::find_candidates(data, data, stats::make_blocks(data),
                             std::vector<double>(data.rows(), 50), {"sigma_n_MPa"}, {});
  EXPECT_GE(found.columns.size(), others);
  EXPECT_LT(trace::all_causes(found).size(), 4 * others);
  EXPECT_THAT(found.notes.back(), testing::EndsWith(trace::not_searched));
}

} // namespace
} // namespace frictab::many_columns_test
