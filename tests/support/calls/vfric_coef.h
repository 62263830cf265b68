// One call of VFRIC_COEF: its 16 arguments as arrays of the solver's precision, owned here.
#pragma once

#include <cstddef>
#include <vector>

namespace frictab::calls {

// Real is float or double, as the vaba_param.inc the routine was compiled with says. All arrays are
// sized by `resize` to the dimensions of the argument list and filled with zero.
template <class Real> struct VfricCoefCall {
  int points = 0; // nBlock
  int fields = 0; // nFields
  bool temperatures = false;
  std::vector<Real> properties;

  std::vector<Real> coefficient;                      // out: points
  std::vector<Real> derivative;                       // out: (points, 3)
  std::vector<Real> slip_rate, pressure, temperature; // points
  std::vector<Real> field;                            // (points, fields)

  void resize(int point_count);
  // Runs the routine at this address.
  void run(void* function);
};

extern template struct VfricCoefCall<float>;
extern template struct VfricCoefCall<double>;

} // namespace frictab::calls
