// One call of Marc's UFRIC.
#pragma once

namespace frictab::calls {

// The arrays have the sizes of the dimension that the source was generated for.
struct UfricCall {
  double normal = 0;       // FN
  double slip[2] = {0, 0}; // VREL; 2-D uses the first
  double temperature[2] = {0, 0};
  double flow_stress = 0; // YIEL
  int touched_body = 1;   // NSURF

  double run(void* function) const; // FRIC
};

} // namespace frictab::calls
