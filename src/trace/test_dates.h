// When tests were made, as rigs and spreadsheets write it.
#pragma once

#include <string>
#include <vector>

namespace frictab::trace {

struct TestDates {
  std::vector<double> place; // of each text in the order of time, from 0; alike where times are
  std::string fault;         // why there is no order, with a text that shows it; else empty
};

// Dates with the year first (2024-09-01, 2024/9/1), with points (01.09.2024), or with the day or
// the month first (13/9/2024, 09-13-24), a time of day behind them (14:05, T14:05:10Z, 2:05 PM).
// Which field is the day follows from all texts together: what no calendar has is ruled out, and
// readings that are left have to agree on the order. Texts none of which is a date: as they are
// sorted.
TestDates sort_dates(const std::vector<std::string>& texts);

} // namespace frictab::trace
