// The interpolation, written out for one table: a Fortran compiler would not do by itself what
// frictab_kernel.h and frictab_cubic.h do for constant axes.
#pragma once

#include <string>
#include <vector>

#include "codegen/exporter.h"
#include "codegen/fortran_parts.h"

namespace frictab::codegen::fortran {

// Returns the function ftintp(u), one coordinate per axis; with `gradient` also the subroutine
// ftintg, which returns the derivatives as well. As an external unit, ftintg contains the numbers
// for both and takes a flag; in a module the two are separate. The text is empty if nothing is
// interpolated. `values` are baked_values.
Piece interpolation(const ExportRequest& request, const std::vector<double>& values, bool gradient,
                    Units units);

// Statements of ft_linear_gradient_N and ft_cubic_gradient_N, and their declarations.
struct Slopes {
  std::vector<std::string> names, steps;
};
Slopes linear_slopes(const std::vector<long>& stride);
Slopes cubic_slopes(const table::Table& table, const std::vector<long>& stride);

} // namespace frictab::codegen::fortran
