// Dates, repeats and conditions in the names of files.
#include <gtest/gtest.h>

#include "core/pattern.h"
#include "guess/guess.h"

namespace frictab::file_names_test {
namespace {

using guess::guess_names;

std::vector<std::string> groups(const guess::NamePattern& names) {
  std::vector<std::string> out;
  for (const guess::NamePart& part : names.parts)
    out.push_back(part.group);
  return out;
}

std::string group_of(const guess::NamePattern& names, const std::string& group,
                     const std::string& file) {
  const auto found = Pattern(names.pattern, {}).search(file);
  return found ? found->at(group) : "no match";
}

using Groups = std::vector<std::string>;

TEST(FileNames, DateIsOneGroupWithTheTimeOfDayAfterIt) {
  const auto days = guess_names(
      {"a/2026-03-10_SRV4_T001.txt", "a/2026-04-11_SRV4_T002.txt", "a/2026-04-11_SRV4_T003.txt"});
  EXPECT_EQ(groups(days), (Groups{"date", "experiment"}));
  EXPECT_EQ(group_of(days, "date", "a/2026-03-10_SRV4_T001.txt"), "2026-03-10");
  const auto times =
      guess_names({"bor_20260302_0900.csv", "bor_20260302_1130.csv", "bor_20260303_0900.csv"});
  EXPECT_EQ(groups(times), (Groups{"date"}));
  EXPECT_EQ(group_of(times, "date", "bor_20260302_1130.csv"), "20260302_1130");
  const auto points = guess_names({"10N 10.03.2026.csv", "20N 1.4.2026.csv"});
  EXPECT_EQ(groups(points), (Groups{"x1_N", "date"}));
  EXPECT_EQ(group_of(points, "date", "20N 1.4.2026.csv"), "1.4.2026");
}

TEST(FileNames, FolderMayBeADate) {
  const auto names = guess_names({"10.03.2026/10N.csv", "10.03.2026/20N.csv", "9.4.2026/10N.csv"});
  EXPECT_EQ(groups(names), (Groups{"date", "x1_N"}));
  EXPECT_EQ(group_of(names, "date", "rig/9.4.2026/10N.csv"), "9.4.2026");
}

TEST(FileNames, NumberOfEightDigitsOutsideTheCalendarIsNoDate) {
  EXPECT_EQ(groups(guess_names({"oil_12345678.csv", "oil_22345678.csv"})), (Groups{"name2"}));
  EXPECT_EQ(groups(guess_names({"oil_20261345.csv", "oil_20261346.csv"})), (Groups{"name2"}));
}

TEST(FileNames, NumbersOfSpecimensAtTheEndAreRepeats) {
  std::vector<std::string> files;
  for (const char* const coat : {"ZnNi", "ZnFlake_Top", "ZnFlake"})
    for (int specimen = 1; specimen <= 4; ++specimen)
      files.push_back("M10_" + std::string(coat) + "_C2_" + std::to_string(specimen) + ".csv");
  const auto names = guess_names(files);
  EXPECT_EQ(groups(names), (Groups{"name1", "repeat"}));
  EXPECT_EQ(group_of(names, "name1", files[5]), "M10_ZnFlake_Top_C2");
  EXPECT_EQ(group_of(names, "repeat", files[5]), "2");
}

} // namespace
} // namespace frictab::file_names_test
