// [trace] of a job.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace frictab::trace {

struct TraceOptions {
  std::vector<std::string> models{"best"}; // best | names | all that were calibrated
  double alpha = 0.02;                     // family-wise error of a false alarm
  std::vector<std::string> ignore;         // columns that cannot be a cause
  std::optional<double> repeatability;     // relative scatter between repeated tests
  std::string order;                       // column that gives the order of tests
  std::string tool_distance; // column of wear: may be shipped though it follows the order
  Place ignore_place, order_place, tool_distance_place;
};

} // namespace frictab::trace
