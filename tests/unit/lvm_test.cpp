// LabVIEW measurement files in the variants of NI's specification.
#include <gmock/gmock.h>

#include "core/random.h"
#include "io/lvm.h"
#include "unit/load_case.h"

namespace frictab::lvm_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Lines of a file's header, with CRLF; | stands for the separator.
std::string lines(std::string text, const std::string& separator = "\t") {
  std::string out;
  for (const char c : text)
    out += c == '|' ? separator : c == '\n' ? "\r\n" : std::string(1, c);
  return out;
}

std::string header(const std::string& x_columns = "One", const std::string& decimal = ".") {
  return "LabVIEW Measurement|\nWriter_Version|2\nReader_Version|2\nSeparator|Tab\n"
         "Decimal_Separator|" +
         decimal + "\nMulti_Headings|Yes\nX_Columns|" + x_columns +
         "\nTime_Pref|Relative\nOperator|lab\n***End_of_Header***|\n|\n";
}

std::string segment(const std::string& rows, const std::string& x0 = "0",
                    const std::string& names = "X_Value|Force|Speed|Comment") {
  return "Channels|2|||\nSamples|2|2||\nY_Unit_Label|N|mm/s|\nX_Dimension|Time|Time|\nX0|" + x0 +
         "|" + x0 + "|\nDelta_X|0.5|0.5|\n***End_of_Header***|||\n" + names + "\n" + rows;
}

class Lvm : public testing::Test {
protected:
  io::CsvTable parse(const std::string& text) { return io::parse_lvm(text, "a.lvm", {}, faults_); }
  std::string fault(const std::string& text) {
    try {
      parse(text);
      faults_.throw_if_any();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  FaultList faults_;
};

std::vector<std::string> names(const io::CsvTable& table) {
  std::vector<std::string> all;
  for (const io::CsvColumn& column : table.columns)
    all.push_back(column.name + "[" + column.unit + "]");
  return all;
}

TEST_F(Lvm, OneColumnOfXIsReadWithUnitsAndTrueLines) {
  const io::CsvTable table = parse(lines(header() + segment("0|10|5\n0.5|11|6\n")));
  EXPECT_TRUE(faults_.empty());
  EXPECT_THAT(names(table), ElementsAre("X_Value[s]", "Force[N]", "Speed[mm/s]"));
  EXPECT_THAT(table.columns[0].numbers, ElementsAre(0, 0.5));
  EXPECT_THAT(table.columns[2].numbers, ElementsAre(5, 6));
  EXPECT_THAT(table.line, ElementsAre(20, 21));
  EXPECT_THAT(table.notes, IsEmpty());
}

TEST_F(Lvm, TheDecimalCommaOfTheHeaderCounts) {
  const io::CsvTable table =
      parse(lines(header("One", ",") + segment("0,0|10,5|5\n0,5|11|6,25\n")));
  EXPECT_THAT(table.columns[1].numbers, ElementsAre(10.5, 11));
  EXPECT_THAT(table.columns[2].numbers, ElementsAre(5, 6.25));
}

TEST_F(Lvm, CommasMaySeparate) {
  std::string text = header() + segment("0|10|5\n0.5|11|6\n");
  text.replace(text.find("Separator|Tab"), 13, "Separator|Comma");
  EXPECT_THAT(parse(lines(text, ",")).columns[1].numbers, ElementsAre(10, 11));
}

TEST_F(Lvm, CommentsAreATextColumn) {
  const io::CsvTable table = parse(lines(header() + segment("0|10|5\n0.5|11|6|oil added\n")));
  ASSERT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[3].name, "Comment");
  EXPECT_EQ(table.columns[3].texts.back().text, "oil added");
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Lvm, WithoutColumnsOfXTimeIsComputedPerSegment) {
  const std::string without_x = "|10|5\n|11|6\n";
  const io::CsvTable table =
      parse(lines(header("No") + segment(without_x, "1.5") + "\n" + segment(without_x, "9")));
  EXPECT_TRUE(faults_.empty());
  EXPECT_THAT(names(table), ElementsAre("X_Value[s]", "Force[N]", "Speed[mm/s]"));
  EXPECT_THAT(table.columns[0].numbers, ElementsAre(1.5, 2, 9, 9.5));
  EXPECT_THAT(table.columns[0].texts, IsEmpty());
  const io::CsvTable bare =
      parse(lines(header("No") + segment("10|5\n11|6\n", "1", "Force|Speed|Comment")));
  EXPECT_THAT(names(bare), ElementsAre("X_Value[s]", "Force[N]", "Speed[mm/s]"));
  EXPECT_THAT(bare.columns[0].numbers, ElementsAre(1, 1.5));
}

TEST_F(Lvm, SegmentsAreIntervalsOfOneRecording) {
  const io::CsvTable table =
      parse(lines(header() + segment("0|10|5\n0.5|11|6\n") + "\n" + segment("7|12|5\n7.5|13|6\n")));
  EXPECT_TRUE(faults_.empty());
  EXPECT_THAT(table.interval, ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(table.columns[0].numbers, ElementsAre(0, 0.5, 7, 7.5));
  EXPECT_THAT(table.line, ElementsAre(20, 21, 31, 32));
}

TEST_F(Lvm, SegmentsOfOtherChannelsOrUnitsAreAFault) {
  const std::string first = header() + segment("0|10|5\n0.5|11|6\n") + "\n";
  EXPECT_THAT(fault(lines(first + segment("0|1|2\n", "0", "X_Value|Force|Torque|Comment"))),
              HasSubstr("a.lvm:30: error: segment 2 has the columns X_Value, Force, Torque"));
  std::string other = segment("0|1|2\n");
  other.replace(other.find("|N|"), 3, "|kN|");
  EXPECT_THAT(fault(lines(first + other)), HasSubstr("segment 2 has the units kN, mm/s"));
}

TEST_F(Lvm, EqualColumnsOfXAreOneAndOthersAreNumbered) {
  const auto multi = [&](const std::string& second) {
    return parse(lines(header("Multi") +
                       "Channels|2||||\nSamples|2||2||\nY_Unit_Label|N||mm/s||\n"
                       "X_Dimension|Time||Time||\nX0|0||0||\nDelta_X|1||1||\n"
                       "***End_of_Header***||||\nX_Value|Force|X_Value|Speed|Comment\n"
                       "0|10|" +
                       second + "|5\n1|11|1|6\n"));
  };
  const io::CsvTable equal = multi("0");
  EXPECT_THAT(names(equal), ElementsAre("X_Value[s]", "Force[N]", "Speed[mm/s]"));
  EXPECT_THAT(equal.notes, Contains(HasSubstr("1 more columns X_Value are equal")));
  EXPECT_THAT(names(multi("0.5")),
              ElementsAre("X_Value[s]", "Force[N]", "X_Value(2)[s]", "Speed[mm/s]"));
}

TEST_F(Lvm, SpecialBlocksAndMissingSamplesAreNoted) {
  const io::CsvTable table = parse(lines(
      header() + "***Start_Special***\nanything|1\n***End_Special***\n" + segment("0|10|5\n")));
  EXPECT_THAT(table.columns[1].numbers, ElementsAre(10));
  EXPECT_THAT(table.notes, Contains("segment 1 has 1 rows, its header counts 2 samples"));
  EXPECT_NE(std::ranges::find(table.above, "anything", &io::CsvAbove::name), table.above.end());
  EXPECT_THAT(table.notes,
              Contains("1 blocks ***Start_Special***: only lines of a name and a value are read"));
}

TEST_F(Lvm, DamageIsReportedWithItsLine) {
  EXPECT_THAT(fault("LabVIEW Measurement\t\nSeparator\tTab\n"),
              HasSubstr("a.lvm:1: error: the header has no line ***End_of_Header***"));
  EXPECT_THAT(fault(lines(header() + segment("0|10|5\n0.5|11\n"))),
              HasSubstr("a.lvm:21: error: 2 cells, the header has 4"));
  EXPECT_THAT(fault(lines(header())), HasSubstr("a.lvm:"));
  EXPECT_THAT(fault(lines(header() + segment(""))), HasSubstr("a.lvm"));
}

TEST_F(Lvm, EveryTruncationAndDamageGivesAFaultOrATable) {
  const std::string text =
      lines(header() + segment("0|10|5\n0.5|11|6|note\n") + "\n" + segment("7|12|5\n7.5|13|6\n"));
  for (std::size_t size = 19; size < text.size(); ++size)
    EXPECT_NO_THROW(fault(text.substr(0, size))) << size;
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = text;
    for (std::size_t k = 1 + random.below(4); k > 0; --k)
      damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
    EXPECT_NO_THROW(fault(damaged)) << damaged;
  }
}

TEST_F(Lvm, TagsOfTheHeaderThatDescribeTheTestAreConditions) {
  const io::CsvTable table = parse(lines(header() + segment("0|10|5\n0.5|11|6\n")));
  ASSERT_EQ(table.above.size(), 1u);
  EXPECT_EQ(table.above[0].name, "Operator");
  EXPECT_EQ(table.above[0].value, "lab");
}

class LoadLvm : public test::LoadCase {};

TEST_F(LoadLvm, AJobNeedsNoDialectAndTheExtensionDoesNotMatter) {
  options.columns["tau_R_MPa"].names = {"Shear"};
  options.columns["sigma_n_MPa"].names = {"Stress"};
  options.columns["time_s"].names = {"X_Value"};
  std::string text = header("One", ",") +
                     "Channels|2|||\nSamples|3|3||\nY_Unit_Label|kPa|MPa|\n"
                     "X_Dimension|Time|Time|\nX0|0|0|\nDelta_X|1|1|\n***End_of_Header***|||\n"
                     "X_Value|Shear|Stress|Comment\n0|1000,5|5\n0,5|2000|5\n1|1500|6\n";
  const data::Dataset data = data::load_dataset({file("a.txt", lines(text))}, options);
  EXPECT_THAT(column(data, "tau_R_MPa"), ElementsAre(1.0005, 2, 1.5));
  EXPECT_THAT(column(data, "time_s"), ElementsAre(0, 0.5, 1));
}

} // namespace
} // namespace frictab::lvm_test
