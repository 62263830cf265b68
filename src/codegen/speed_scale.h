// Simulations that run faster than their process. Explicit forming runs are scaled in speed (or in
// time) to be affordable, by a factor of 10 to 1000; a law of the sliding speed would then be
// evaluated far beyond the tested speeds. With the option `speed_scale = "property"` the deck has
// the factor n in a property after those of the states: the routine first divides speeds by n and
// multiplies times by n. Slip, work per area and pressure are the same in both.
#pragma once

#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::codegen {

// Option with values "none", "property"; of the targets for explicit solvers.
ExportOption speed_scale_option();

// Returns this property; empty if the request does not use it.
FurtherProperties speed_scale(const ExportRequest& request, const std::vector<SolverInput>& inputs);

// Returns the number of that property; 0 if the request does not use it.
std::size_t speed_scale_property(const ExportRequest& request,
                                 const std::vector<SolverInput>& inputs);

// Adds values for a routine's template: flag scaled, and text scale, the property's number.
void add_speed_scale(TemplateValues& values, const ExportRequest& request,
                     const std::vector<SolverInput>& inputs);

} // namespace frictab::codegen
