// Rule by which a table computes values between its nodes.
#pragma once

#include <optional>
#include <string_view>

namespace frictab::table {

enum class Interpolation {
  linear, // in the axes' coordinates (table/frictab_kernel.h)
  cubic,  // the spline of table/spline.h
  none    // no nodes: the direct form; never in a job or a file
};
// Interpolations that have nodes, as jobs and files name them.
inline constexpr Interpolation grid_interpolations[] = {Interpolation::linear,
                                                        Interpolation::cubic};

// Name in jobs, files and recipes.
constexpr const char* interpolation_name(Interpolation interpolation) {
  constexpr const char* names[] = {"linear", "cubic", "none"}; // in the order of Interpolation
  return names[static_cast<int>(interpolation)];
}

constexpr std::optional<Interpolation> find_interpolation(std::string_view name) {
  for (const Interpolation one : {Interpolation::linear, Interpolation::cubic, Interpolation::none})
    if (name == interpolation_name(one)) return one;
  return std::nullopt;
}

} // namespace frictab::table
