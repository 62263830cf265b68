// One call of USRFRC: its 58 arguments as arrays of the solver's kinds, owned here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frictab::calls {

// Real, Int: float, int32_t for the solver in single precision, double, int64_t for that in double.
// Arrays are indexed as the routine does: by place in the interface's list of nodes (from 0 here),
// histories by `history_of`, temperatures by the number of the node in the model.
template <class Real, class Int> struct UsrfrcCall {
  Real rate = 1;               // FDT2, 1/time increment
  Real implicit_factor = 1;    // SFACN3
  Int histories = 4;           // NHV
  std::vector<Real> constants; // UA

  std::vector<Int> active;                 // IISV5: places, from 1
  std::vector<Int> history_of;             // ILBSV, from 1
  std::vector<Int> node, segment;          // INSV, LSV; from 1
  std::vector<Int> corner[4];              // IX1..IX4
  std::vector<Real> area, normal;          // AREAS; FNI, compression negative
  std::vector<Real> slip[3], direction[3]; // DX, DY, DZ; RN1, RN2, RN3
  std::vector<Real> s, t;                  // place on the segment, -1 .. 1
  std::vector<Real> stiffness;             // STFK
  std::vector<Real> scale;                 // FRC(2, segments)
  std::vector<Real> before;                // FDAT(5, places); in, out
  std::vector<Real> history;               // UFHIST(NHV, ilbsv); in, out
  std::vector<Int> last_segment;           // ISEG; out
  std::vector<Real> force[3];              // FXIS, FYIS, FZIS; in, out
  std::vector<Real> temperature;           // TEMP, by node

  // All places active; area 1, no pressure, normal along z; a force before of 2^60 along x, so that
  // sliding is what happens; temperatures 0, five nodes each.
  void resize(std::size_t places);
  void run(void* function);
};

extern template struct UsrfrcCall<float, std::int32_t>;
extern template struct UsrfrcCall<double, std::int64_t>;

} // namespace frictab::calls
