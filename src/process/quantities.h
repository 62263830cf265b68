// The columns of a simulation's files: contact states, one row per facet (or node) in contact and
// increment; and the tool, one row per increment.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "data/quantity.h"

namespace frictab::process {

// The states of data/quantity.h, the areas of the facet now and on the undeformed billet, the slip
// of the facet along two directions, its place, its plastic strain, and the solver's shear stress.
std::span<const data::Quantity> contact_quantities();
// Time, force, speed and stroke of the tool, and the friction work that the solver has summed.
std::span<const data::Quantity> tool_quantities();
// Plastic strain and flow stress of a material.
std::span<const data::Quantity> curve_quantities();

std::vector<std::string> contact_columns(); // with the facet's name
std::vector<std::string> tool_columns();
// Settings of a rig.
inline constexpr std::array setting_names{"sigma_n_MPa", "psi", "v_rel_mm_s", "T_tool_C"};
std::vector<std::string> rig_settings();

// Name of the column with the names of facets.
inline constexpr const char* facet_column = "facet";

} // namespace frictab::process
