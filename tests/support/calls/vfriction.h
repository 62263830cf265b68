// One call of VFRICTION: its 39 arguments as arrays of the solver's precision, owned here.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace frictab::calls {

// Real is float or double, as the vaba_param.inc the routine was compiled with says. All arrays are
// sized by `resize` to the dimensions of the argument list and filled with zero; what no friction
// law asks for (coordinates, velocities, direction cosines, shape functions) is NaN.
template <class Real> struct VfrictionCall {
  int points = 0;     // nBlock
  int directions = 3; // nDir; nFricDir = nDir - 1
  int states = 6;     // nStates
  int fields = 0;     // nFields
  bool rigid = false; // analytical rigid main surface: nBlockAnal = 1
  bool edges = false; // edge-type secondary surface: nNodState = 4, nNodSlv = 2
  bool temperatures = false;
  Real time_increment = 0; // rData(3)
  int step = 1, increment = 1;
  std::vector<int> nodes; // jConSlvUid: (nNodSlv, points)
  std::vector<Real> properties;
  std::string interaction = "FRICTAB"; // surfInt

  std::vector<Real> tangential;                    // out: (nDir-1, points)
  std::vector<Real> state;                         // in, out: (states, columns(), points)
  std::vector<Real> slip;                          // (nDir, points)
  std::vector<Real> stick, normal, area;           // points
  std::vector<Real> previous;                      // (nDir, points)
  std::vector<Real> temperature, temperature_main; // points, definitions()
  std::vector<Real> field, field_main;             // (fields, points), (fields, definitions())

  int columns() const { return edges ? 4 : 1; }          // nNodState
  int definitions() const { return rigid ? 1 : points; } // nBlockAnal
  // Areas are 1, stick unlimited, all nodes number 7.
  void resize(int point_count);
  // Runs the routine at this address.
  void run(void* function);
};

extern template struct VfrictionCall<float>;
extern template struct VfrictionCall<double>;

} // namespace frictab::calls
