// One call of FRIC_COEF: its 16 arguments, owned here, in either argument list.
#pragma once

#include <cstddef>
#include <vector>

namespace frictab::calls {

// All arrays are sized by `resize` and filled with 0; columns hold one number per point.
struct CoefCall {
  bool release_2024 = true;
  int points = 0; // nBlock
  int states = 0; // iData(i_ifc_nStateV); only 2024
  int fields = 0; // nFields
  bool temperatures = false;
  int step = 1, increment = 1;
  double time_increment = 1;
  std::vector<double> properties;

  std::vector<double> coefficient; // out: (points,2), or (points) in 2020
  std::vector<double> derivative;  // out: (points,20,2), or (points,3)
  std::vector<double> slip;        // slipData(points,6), or slipRate(points)
  std::vector<double> pressure, temperature;
  std::vector<double> field; // (points, fields)
  std::vector<double> state; // what follows in rData

  void resize(int point_count);
  // Runs the routine at this address.
  void run(void* function);
};

} // namespace frictab::calls
