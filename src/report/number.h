// Numbers as people read them in the report: few digits, thousands separators, the same every run.
#pragma once

#include <cstddef>
#include <string>

namespace frictab {

// `digits` significant digits: 0.0712, 12.3, 1,230, 2.1e-13; "n/a" where not finite.
std::string number(double value, int digits = 3);

// A stress or an error in MPa so that a column of them lines up: 9.35, 123.4, 2,750. Small ones
// keep three significant digits.
std::string stress(double value);

// "0.0712 ± 0.0008": the error to two significant digits, the value to the same place. "0.0712"
// alone where the error is zero; "± n/a" where it is not finite.
std::string with_error(double value, double error);

// 3 of 400 -> "0.75 %"; "n/a" of none.
std::string percent(std::size_t part, std::size_t whole);

} // namespace frictab
