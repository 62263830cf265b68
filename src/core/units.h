// Unit conversion for mapped columns and for the unit systems of generated routines.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frictab {

// canonical = factor * value + offset
struct Conversion {
  double factor = 1;
  double offset = 0;
  double operator()(double value) const { return factor * value + offset; }
};

// nullopt if either unit is unknown or their dimensions differ.
std::optional<Conversion> convert(std::string_view from, std::string_view to);

// Units that convert to `unit`, for messages.
std::vector<std::string> units_like(std::string_view unit);

} // namespace frictab
