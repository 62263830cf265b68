// Number formats of spreadsheets: the kind of value that a cell shows.
#pragma once

#include <string>

#include "io/workbook.h"

namespace frictab::io {

// Kind of a custom format code: "0.0 \"kN\"" number, "0%" percent, "[h]:mm:ss" time, "d.m.yy" date.
// Source: ECMA-376 part 1, 18.8.30 and 18.8.31.
CellKind kind_of_format(const std::string& code);
CellKind kind_of_built_in_format(int id);

// A serial number of days as ISO text, with milliseconds if it has any.
std::string date_text(double days, bool since_1904);
// A share of days in seconds, free of the rounding of days: 0.05 from 5.787037037037037e-07.
double seconds_of_days(double days);

} // namespace frictab::io
