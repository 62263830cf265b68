// The kernel of target `c` in single precision.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"
#include "single_bound.h"

namespace frictab::c_target {

inline constexpr const char* single_variant = "f32";

// Throws InputError where single precision or a source cannot hold the table.
void check_single(const codegen::ExportRequest& request);

// Adds frictab_tau_R_f32.h and .c.
void add_single(codegen::SourceBundle& files, const codegen::ExportRequest& request,
                const std::vector<codegen::InputArgument>& inputs, const RoundingBound& bound);

// What recipe.json says of it.
nlohmann::ordered_json single_recipe(const codegen::ExportRequest& request,
                                     const std::vector<codegen::InputArgument>& inputs,
                                     const RoundingBound& bound);

} // namespace frictab::c_target
