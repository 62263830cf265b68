// The angle of sliding, direction_deg, of a law that was tested in several directions of a surface,
// from the slip that a solver gives as a vector.
//
//   angle = atan2(across, along) in degrees, 0 at rest, modulo a half or a whole turn
//
// `along` and `across` are components of the slip. A solver with local axes gives them along its
// first and second tangent. For one with a slip r in global axes they follow from the normal n of
// the main surface and a reference direction d, which is laid on the surface:
//
//   along = (d - (d n) n) r,   across = (d x n) r
//
// This angle is counter-clockwise for who looks at the secondary surface from outside, along n.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "table/table.h"

namespace frictab::codegen {

inline constexpr std::string_view direction_name = "direction_deg";

using Axis = std::array<double, 3>; // of length 1, in the model's global axes

// The interval of one turn in which routines give the angle, with the tested range in its middle.
// Friction forwards and backwards along a line is the same, and the turn is 180 degrees, unless
// tests cover more than that.
struct Turn {
  double low = 0, period = 180; // degrees

  double high() const { return low + period; }
  // True if a routine gives this angle with any rounding of its slip. Rounding decides between
  // both ends of the interval, except if the slip lies along an axis.
  bool represents(double degrees, const Axis& reference) const;
};
Turn turn_of(const table::Table& table);

namespace fortran {

// Returns the function ftfold(along, across), and with `reference` also ftturn(slip, normal) for
// vectors in global axes, both in degrees within the turn.
std::string direction_functions(const Turn& turn, const std::optional<Axis>& reference);

} // namespace fortran

} // namespace frictab::codegen
