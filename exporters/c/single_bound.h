// How far the kernel in single precision can be from the function in double precision.
#pragma once

#include <optional>
#include <string>

#include "codegen/exporter.h"

namespace frictab::c_target {

// tau_R of every state inside the ranges: |single - double| <= MPa, the rounding of the arguments
// to float included. What is taken as given of processor and library stands in expr/rounding.h.
struct RoundingBound {
  std::optional<double> MPa;
  std::string why_not;
};

RoundingBound rounding_bound(const codegen::ExportRequest& request);

} // namespace frictab::c_target
