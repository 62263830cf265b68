// The kernels compiled several times with different ways to compute: the text is one, the bits must
// be. Each variant is a file that includes kernel_variant.inc.
#pragma once

#include "table/kernel.h"

namespace frictab::test {

struct KernelVariant {
  const char* name;
  double (*linear)(int axes, const ft_axis*, ft_values, const double* u, unsigned* outside);
  double (*cubic)(int axes, const ft_spline_axis*, ft_values, const double* u, unsigned* outside);
  double (*linear_gradient)(int axes, const ft_axis*, ft_values, const double* u, double* by_u,
                            unsigned* outside);
  double (*cubic_gradient)(int axes, const ft_spline_axis*, ft_values, const double* u,
                           double* by_u, unsigned* outside);
};

extern const KernelVariant vector_kernel; // as everywhere else
extern const KernelVariant plain_kernel;  // FT_PLAIN: C99 and nothing more

// With the wider vectors of AVX; nullptr where this processor has none.
const KernelVariant* wide_kernel();

} // namespace frictab::test
