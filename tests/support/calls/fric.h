// One call of FRIC: its arguments, owned here.
#pragma once

#include <cstddef>
#include <vector>

namespace frictab::calls {

// A contact point of Abaqus/Standard. `resize` sizes the arrays; everything is 0 but what is said.
struct FricCall {
  int directions = 2; // NFDIR: 1 or 2
  int states = 15;    // NSTATV
  int predefined = 0; // NPRED
  int mode = 0;       // LM, in and out
  int step = 1, increment = 1;
  double time_increment = 1;
  double pressure = 0;
  double length = 1;                          // CHRLNGTH
  double step_scale = 1;                      // PNEWDT
  double elastic_energy = 0, dissipation = 0; // SED, SFD
  double temperature[2] = {0, 0};
  double rotation[4] = {1, 0, 0, 1}; // DROT, by columns
  std::vector<double> properties;

  std::vector<double> motion;                 // DGAM
  std::vector<double> tau, by_pressure, slip; // TAU, DDTDDP, DSLIP
  std::vector<double> by_motion;              // DDTDDG, by columns
  std::vector<double> by_temperature;         // DDTDDT, by columns
  std::vector<double> state;                  // STATEV
  std::vector<double> field;                  // PREDEF(2,*)

  void resize();
  // Runs the routine at this address.
  void run(void* function);
};

} // namespace frictab::calls
