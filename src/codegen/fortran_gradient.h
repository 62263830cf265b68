// tau_R with its derivatives, in fixed form.
#pragma once

#include "codegen/exporter.h"
#include "codegen/fortran_parts.h"

namespace frictab::codegen::fortran {

// Returns the subroutine ftgrad of Core, and the helpers that it calls. `core`: the values of
// frictab_core.f for coordinates and value.
Piece gradient_unit(const ExportRequest& request, const TemplateValues& core, Units units);

} // namespace frictab::codegen::fortran
