// The value of a missing number.
#pragma once

#include <limits>

namespace frictab {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

} // namespace frictab
