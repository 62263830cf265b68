// Calls UFRIC as Marc does, once per contact point.
#pragma once

#include "codegen/exporter.h"

namespace frictab::marc_ufric {

// One call. The arrays have the sizes of the dimension that the source was generated for.
struct UfricCall {
  double normal = 0;       // FN
  double slip[2] = {0, 0}; // VREL; 2-D uses the first
  double temperature[2] = {0, 0};
  double flow_stress = 0; // YIEL
  int touched_body = 1;   // NSURF

  double run(void* function) const; // FRIC
};

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::marc_ufric
