// Dates and times of tests, in the formats of rigs and spreadsheets.
#pragma once

#include <string>
#include <vector>

namespace frictab::trace {

struct TestDates {
  // position of each text in order of time, from 0; equal for equal times
  std::vector<double> place;
  std::string fault; // reason why the texts cannot be ordered, quoting one of them; else empty
};

// Orders texts by date and time. Dates have the year first (2024-09-01, 2024/9/1), points
// (01.09.2024), or the day or the month first (13/9/2024, 09-13-24), and may be followed by a time
// of day (14:05, T14:05:10Z, 2:05 PM). The field that is the day is inferred from all texts
// together: readings with invalid dates are ruled out, and the remaining readings must agree on the
// order. Texts without any date are ordered as they sort.
TestDates sort_dates(const std::vector<std::string>& texts);

} // namespace frictab::trace
