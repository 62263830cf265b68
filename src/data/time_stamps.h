// Dates and times of tests and rows, in the formats of rigs and spreadsheets.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace frictab::data {

struct TestDates {
  // position of each text in order of time, from 0; equal for equal times
  std::vector<double> place;
  std::string fault; // reason why the texts cannot be ordered, quoting one of them; else empty
};

// Orders texts by date and time. Dates have the year first (2024-09-01, 2024/9/1), points
// (01.09.2024), or the day or the month first (13/9/2024, 09-13-24), and may be followed by a time
// of day (14:05, T14:05:10Z, 2:05 PM, _1405 in names of files). The field that is the day is
// inferred from all texts together: readings with invalid dates are ruled out, and the remaining
// readings must agree on the order. Texts without any date are ordered as they sort.
TestDates sort_dates(const std::vector<std::string>& texts);

// True for dates with a time of day, and for times alone: 14:03:05,120, 2:05:10 PM, 3:12.5 (minutes
// and seconds).
bool looks_like_time(const std::string& text);

struct RowTimes {
  std::vector<double> seconds; // since the first text
  std::string fault;           // reason why they are not known; else empty
  std::size_t at = 0;          // index of the text at fault
};

// Times of rows in their order. A time of day that falls back by more than half a day is of the
// next day.
RowTimes seconds_since_first(const std::vector<std::string>& texts);

} // namespace frictab::data
