// "key=value" lists as the twin's --design and --effect options take them.
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

// Finite number; a fault and NaN otherwise.
double read_number(const KeyValue& item, FaultList& faults);

// Comma separated numbers; a fault for each that is none.
std::vector<double> read_numbers(const KeyValue& item, FaultList& faults);

} // namespace frictab::twin
