// The kernels for any number of axes, as frictab itself calls them; generated code calls the one
// for its number of axes.
#pragma once

#include "table/frictab_kernel.h"
// Needs frictab_kernel.h before it.
#include "table/frictab_cubic.h"

namespace frictab::table {

// Returns the value at u, one coordinate per axis. values: as for ft_values; of a spline, as for
// ft_cubic_N. Bit d of *outside is set where axis d was clamped (outside may be null). Zero axes:
// the first value.
double interpolate(int axes, const ft_axis* axis, const double* values, const double* u,
                   unsigned* outside);
double interpolate(int axes, const ft_spline_axis* axis, const double* values, const double* u,
                   unsigned* outside);

// Returns the same value and computes its derivative by each coordinate.
double interpolate(int axes, const ft_axis* axis, const double* values, const double* u,
                   double* by_u, unsigned* outside);
double interpolate(int axes, const ft_spline_axis* axis, const double* values, const double* u,
                   double* by_u, unsigned* outside);

} // namespace frictab::table
