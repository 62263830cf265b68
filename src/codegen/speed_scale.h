// Simulations that run faster than their process. Explicit forming runs are scaled in speed (or in
// time) to be affordable, by a factor of 10 to 1000; a law that knows the sliding speed would be
// asked far beyond what was tested. With the option `speed_scale = "property"` the deck says the
// factor n in a property behind those of the states: speeds are divided by n and times multiplied
// by n before anything else sees them. Slip, work per area and pressure are the same in both.
#pragma once

#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::codegen {

// "none", "property"; of the targets for explicit solvers.
ExportOption speed_scale_option();

// That property; none where the request asks for none.
FurtherProperties speed_scale(const ExportRequest& request, const std::vector<SolverInput>& inputs);

// For a routine's template: flag scaled, and text scale, the property's number.
void add_speed_scale(TemplateValues& values, const ExportRequest& request,
                     const std::vector<SolverInput>& inputs);

} // namespace frictab::codegen
