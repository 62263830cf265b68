// The interpolation of frictab_core.f, written out for one table: what frictab_kernel.h and
// frictab_cubic.h do where the axes are constants, a Fortran compiler would not find by itself.
#pragma once

#include <string>
#include <vector>

#include "codegen/fill.h"
#include "codegen/template.h"

namespace frictab::fortran {

// Adds to the values: data of axes and nodes, how each axis of the list "axes" is searched, and the
// unrolled sum over corners ("steps") with its variables ("names"). With `gradient` also the same
// sum with its derivatives by the axes' coordinates ("slopes"), as frictab_gradient.h has it.
void add_interpolation(TemplateValues& values, const Table& table, bool gradient);

// Statements of ft_linear_gradient_N and ft_cubic_gradient_N, and what they declare.
struct Slopes {
  std::vector<std::string> names, steps;
};
Slopes linear_slopes(const std::vector<long>& stride);
Slopes cubic_slopes(const Table& table, const std::vector<long>& stride);

} // namespace frictab::fortran
