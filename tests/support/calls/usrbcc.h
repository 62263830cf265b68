// One call of DEFORM-2D's USRBCC: arguments, and states in COMMON blocks.
#pragma once

#include <vector>

namespace frictab::calls {

// The COMMON blocks, as they lie in memory.
struct Ufhcom {
  double environment, surface, sliding_speed, pressure;
};
struct Ufhcom2 {
  double stretch, effective_stress, strain_rate;
};

// For the edge between two nodes; the COMMON blocks are set beforehand.
struct UsrbccCall {
  int mode = 1, type = 2; // IMODE, ITYPE: friction
  int model = 1;
  int freedoms = 2;                 // NURZ
  int first = 1, second = 2;        // NODE1, NODE2
  int user_variables = 0;           // NUSRN
  std::vector<double> nodal;        // USRNOD(NUSRN, nodes)
  double temperature[2] = {20, 20}; // TEMC
  double variable = 777;            // VARIABLE, as it was before

  void run(void* function); // VARIABLE is left in `variable`
};

} // namespace frictab::calls
