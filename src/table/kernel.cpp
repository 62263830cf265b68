// Chooses the kernel by the number of axes.
#include "table/kernel.h"

#include "table/frictab_gradient.h"
// Needs the header above before it.
#include "table/frictab_cubic_gradient.h"

namespace frictab::table {

namespace {

double first(const double* values, unsigned* outside) {
  if (outside) *outside = 0;
  return values[0];
}

} // namespace

// Inside a case the compiler knows the number of axes.
#define FT_CASE(kernel, N, ...)                                                                    \
  case N:                                                                                          \
    return kernel##_##N(axis, {values, nullptr}, __VA_ARGS__);
#define FT_BY_AXES(kernel, ...)                                                                    \
  switch (axes) {                                                                                  \
    FT_CASE(kernel, 1, __VA_ARGS__)                                                                \
    FT_CASE(kernel, 2, __VA_ARGS__)                                                                \
    FT_CASE(kernel, 3, __VA_ARGS__)                                                                \
    FT_CASE(kernel, 4, __VA_ARGS__)                                                                \
    FT_CASE(kernel, 5, __VA_ARGS__)                                                                \
    FT_CASE(kernel, 6, __VA_ARGS__)                                                                \
    FT_CASE(kernel, 7, __VA_ARGS__)                                                                \
    FT_CASE(kernel, 8, __VA_ARGS__)                                                                \
  default:                                                                                         \
    return first(values, outside);                                                                 \
  }

double interpolate(int axes, const ft_axis* axis, const double* values, const double* u,
                   unsigned* outside) {
  FT_BY_AXES(ft_linear, u, outside)
}
double interpolate(int axes, const ft_spline_axis* axis, const double* values, const double* u,
                   unsigned* outside) {
  FT_BY_AXES(ft_cubic, u, outside)
}
double interpolate(int axes, const ft_axis* axis, const double* values, const double* u,
                   double* by_u, unsigned* outside) {
  FT_BY_AXES(ft_linear_gradient, u, by_u, outside)
}
double interpolate(int axes, const ft_spline_axis* axis, const double* values, const double* u,
                   double* by_u, unsigned* outside) {
  FT_BY_AXES(ft_cubic_gradient, u, by_u, outside)
}

} // namespace frictab::table
