// What an input of a law is: a canonical quantity, a history along the experiment, or a column as
// it was recorded.
#pragma once

#include <limits>
#include <string>

namespace frictab::data {

struct Meaning {
  std::string unit = "1";
  std::string text = "as recorded";
  double lowest = -std::numeric_limits<double>::infinity(); // smallest value that makes sense
  bool log_axis = false;                                    // default coordinate of its axis
  bool state = false; // canonical: laws of the registry may use it
};

Meaning meaning_of(const std::string& name);

} // namespace frictab::data
