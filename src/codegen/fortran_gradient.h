// tau_R with its derivatives, in fixed form.
#pragma once

#include "codegen/exporter.h"
#include "codegen/fortran_parts.h"

namespace frictab::codegen::fortran {

// The subroutine ftgrad of Core, and the helpers that it calls. `core`: what the values of
// frictab_core.f say about coordinates and value.
Piece gradient_unit(const ExportRequest& request, const TemplateValues& core, Units units);

} // namespace frictab::codegen::fortran
