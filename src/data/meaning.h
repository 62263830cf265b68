// Meaning of a law's input: a canonical quantity, a history along the experiment, or a recorded
// column.
#pragma once

#include <limits>
#include <string>

namespace frictab::data {

struct Meaning {
  std::string unit = "1";
  std::string text = "as recorded";
  double lowest = -std::numeric_limits<double>::infinity(); // smallest admissible value
  bool log_axis = false;                                    // default coordinate of its axis
  bool state = false; // canonical: laws of the registry may use it
};

Meaning meaning_of(const std::string& name);

} // namespace frictab::data
