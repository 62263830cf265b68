// The interpolation of frictab_core.f, written out for one table: what frictab_kernel.h and
// frictab_cubic.h do where the axes are constants, a Fortran compiler would not find by itself.
#pragma once

#include "codegen/fill.h"
#include "codegen/template.h"

namespace frictab::fortran {

// Adds to the values: data of axes and nodes, how each axis of the list "axes" is searched, and the
// unrolled sum over corners ("steps") with its variables ("names").
void add_interpolation(TemplateValues& values, const Table& table);

} // namespace frictab::fortran
