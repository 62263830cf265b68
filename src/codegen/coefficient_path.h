// Account of routines that return a coefficient of one contact point and remember nothing.
#pragma once

#include <array>
#include <optional>

#include "codegen/driven_path.h"

namespace frictab::codegen {

// How a solver hands its numbers to such a routine, beyond the pressure.
struct CoefficientRoutine {
  fortran::Coefficient result = fortran::Coefficient::coulomb;
  std::string name = {};         // of the result: "FRIC"
  std::size_t points = 4;        // per call
  bool signed_pressure = false;  // its magnitude is the pressure
  bool nan_speed_is_nan = false; // even for a law that does not take the speed
  // There are calls without temperatures, or a temperature of exactly 0 stands for none.
  bool may_lack_temperature = false, zero_is_no_temperature = false;
  bool keeps_result_without_pressure = false;
  std::size_t factor_property = 0; // number of the property that divides the speed; 0: none
  // Two axes in the surface, to which the components of the speed refer, and its normal, for a
  // driver that gives the speed in global axes.
  std::optional<std::array<Axis, 3>> surface = {};
};

// Drives ftincr with par: whether there are temperatures. v: pressure, speed, slip, temperature,
// flow stress, direction of the speed (2 components). out: the result, and the sum of the
// magnitudes of all else that was written.
void follow_coefficient(DrivenPath& path, const CoefficientRoutine& routine);

} // namespace frictab::codegen
