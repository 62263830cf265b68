// Time stamps of tests as rigs and spreadsheets write them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/time_stamps.h"

namespace frictab::time_stamps_test {
namespace {

using data::sort_dates;
using testing::ElementsAre;
using testing::HasSubstr;
using Texts = std::vector<std::string>;

TEST(TestDates, WithTheYearFirstSortAsTime) {
  EXPECT_THAT(sort_dates({"2024-09-01", "2024-10-01", "2024-9-2"}).place, ElementsAre(0, 2, 1));
  EXPECT_THAT(sort_dates({"2024/09/01 8:05", "2024/09/01 14:00"}).place, ElementsAre(0, 1));
  EXPECT_THAT(sort_dates({"2024-09-01T10:00:00+02:00", "2024-09-01T08:30:00Z"}).place,
              ElementsAre(0, 1));
}

TEST(TestDates, WithPointsHaveTheDayFirst) {
  EXPECT_THAT(sort_dates({"01.10.2024", "02.09.2024", "30.08.2024"}).place, ElementsAre(2, 1, 0));
  EXPECT_THAT(sort_dates({"01.02.24", "02.01.24"}).place, ElementsAre(1, 0));
}

TEST(TestDates, AreReadAsTheCalendarAllows) {
  EXPECT_THAT(sort_dates({"1/9/2024", "13/8/2024"}).place, ElementsAre(1, 0)); // day first
  EXPECT_THAT(sort_dates({"9/1/2024", "8/13/2024"}).place, ElementsAre(1, 0)); // month first
  EXPECT_THAT(sort_dates({"09-13-24", "10-01-24"}).place, ElementsAre(0, 1));
  EXPECT_THAT(sort_dates({"9/1/2024 12:30 AM", "9/13/2024", "9/1/2024 1:00 AM"}).place,
              ElementsAre(0, 2, 1));
}

TEST(TestDates, MayHaveMonthsByTheirNames) {
  EXPECT_THAT(sort_dates({"12-Mar-2021 10:05:01.500", "3-Feb-2021", "12-Mar-2021 09:00:00"}).place,
              ElementsAre(2, 0, 1));
  EXPECT_THAT(sort_dates({"2021-Okt-03", "2021-M\u00E4r-12"}).place, ElementsAre(1, 0));
  EXPECT_THAT(sort_dates({"12 March 2021", "3 May 2021"}).place, ElementsAre(0, 1));
  EXPECT_THAT(
      data::seconds_since_first({"12-Mar-2021 10:05:01.500", "12-Mar-2021 10:05:02.250"}).seconds,
      ElementsAre(0, 0.75));
}

TEST(TestDates, InNamesOfFilesSortAsTime) {
  EXPECT_THAT(sort_dates({"20260303_0900", "20260302_1130", "20260302_0900"}).place,
              ElementsAre(2, 1, 0));
  EXPECT_THAT(sort_dates({"01.04.2026_0900", "31.03.2026_1130", "31.03.2026_0900"}).place,
              ElementsAre(2, 1, 0));
  EXPECT_THAT(sort_dates({"01_04_2026", "31_03_2026"}).place, ElementsAre(1, 0));
  EXPECT_THAT(sort_dates({"2026-03-10_14-30-05", "2026-03-10_14-30-04"}).place, ElementsAre(1, 0));
}

TEST(TestDates, ThatAgreeOnTheOrderWhicheverIsTheDayAreTaken) {
  EXPECT_THAT(sort_dates({"01/01/2024", "02/02/2024"}).place, ElementsAre(0, 1));
}

TEST(TestDates, WhoseDayNothingTellsFromTheMonthAreNoOrder) {
  EXPECT_THAT(sort_dates({"01/02/2024", "02/01/2024"}).fault,
              HasSubstr("'01/02/2024' and the others do not show which number is the day"));
}

TEST(TestDates, OfWhichOneIsNoneAreNoOrder) {
  EXPECT_THAT(sort_dates({"2024-09-01", "later"}).fault, HasSubstr("'later' is not a date"));
  EXPECT_THAT(sort_dates({"2024-13-45"}).fault, HasSubstr("not dates"));
}

TEST(TestDates, TextsThatAreNoDatesSortAsTexts) {
  EXPECT_THAT(sort_dates({"run B", "run A", "run C"}).place, ElementsAre(1, 0, 2));
  EXPECT_TRUE(sort_dates(Texts{}).place.empty());
}

} // namespace
} // namespace frictab::time_stamps_test
