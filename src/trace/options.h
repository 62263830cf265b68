// Options of the [trace] section of a job.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace frictab::trace {

struct TraceOptions {
  std::vector<std::string> models{"best"}; // best | names | all that were calibrated
  double alpha = 0.02;                     // family-wise level of false alarms
  std::vector<std::string> ignore;         // columns that are not searched
  std::optional<double> repeatability;     // relative scatter between repeated tests
  std::string order;                       // column that gives the order of tests
  // column of tool wear: its effect may be delivered though it follows the order
  std::string tool_distance;
  Place ignore_place, order_place, tool_distance_place;
};

} // namespace frictab::trace
