// Simulations that run faster than their process. Explicit forming runs are scaled in speed (or in
// time) to be affordable, by a factor of 10 to 1000; a law that knows the sliding speed would be
// asked far beyond what was tested. With the option `speed_scale = "property"` the deck says the
// factor n in a property behind those of the states: speeds are divided by n and times multiplied
// by n before anything else sees them. Slip, work per area and pressure are the same in both.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"

namespace frictab::codegen {

// "none", "property"; of the targets for explicit solvers.
ExportOption speed_scale_option();

// The number of that property; 0 where the request asks for none.
std::size_t speed_scale_property(const ExportRequest& request,
                                 const std::vector<SolverInput>& inputs);

// All properties: those of the states and this one.
std::size_t all_properties(const ExportRequest& request, const std::vector<SolverInput>& inputs);

// What stands in its place: in a deck; as a comment line of the source; in recipe.json's list.
// Empty, or nothing is added, where the request asks for none.
std::vector<std::string> speed_scale_placeholder(const ExportRequest& request);
std::vector<std::string> speed_scale_line(const ExportRequest& request,
                                          const std::vector<SolverInput>& inputs);
void add_speed_scale(nlohmann::ordered_json& properties, const ExportRequest& request,
                     const std::vector<SolverInput>& inputs);

} // namespace frictab::codegen
