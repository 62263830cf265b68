// "key=value" lists in the form of the twin's --design and --effect options.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace frictab::twin {

struct KeyValue {
  std::string key;
  std::string value;
  std::string option; // "--design", for messages
};

// Splits at `separator` and at the first '='. Unknown, repeated and empty keys become faults and
// are left out.
std::vector<KeyValue> read_pairs(std::string_view text, char separator, const std::string& option,
                                 std::span<const std::string> known, FaultList& faults);

// Reads a finite number; adds a fault and returns NaN for anything else.
double read_number(const KeyValue& item, FaultList& faults);

// Reads comma-separated numbers; adds a fault for each item that is not a number.
std::vector<double> read_numbers(const KeyValue& item, FaultList& faults);

} // namespace frictab::twin
