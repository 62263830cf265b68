// The interpolation, written out for one table: what frictab_kernel.h and
// frictab_cubic.h do where the axes are constants, a Fortran compiler would not find by itself.
#pragma once

#include <string>
#include <vector>

#include "codegen/exporter.h"
#include "codegen/fortran_parts.h"

namespace frictab::codegen::fortran {

// `values` are baked_values. The function ftintp(u), one coordinate per axis; with `gradient` also
// the subroutine ftintg, which gives the derivatives as well: on its own it holds the numbers for
// both and takes a flag, in a module the two are apart. No text where there is nothing to
// interpolate.
Piece interpolation(const ExportRequest& request, const std::vector<double>& values, bool gradient,
                    Units units);

// Statements of ft_linear_gradient_N and ft_cubic_gradient_N, and what they declare.
struct Slopes {
  std::vector<std::string> names, steps;
};
Slopes linear_slopes(const std::vector<long>& stride);
Slopes cubic_slopes(const table::Table& table, const std::vector<long>& stride);

} // namespace frictab::codegen::fortran
