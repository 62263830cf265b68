// Names of the interpolations in jobs, files and recipes.
#include "table/interpolation.h"

#include <algorithm>
#include <array>

namespace frictab::table {

namespace {

constexpr std::array<const char*, 3> interpolation_names = {"linear", "cubic",
                                                            // in the order of Interpolation
                                                            "none"};

} // namespace

const char* interpolation_name(Interpolation interpolation) {
  return interpolation_names[static_cast<std::size_t>(interpolation)];
}

std::optional<Interpolation> find_interpolation(std::string_view name) {
  const auto at = std::ranges::find(interpolation_names, name);
  if (at == interpolation_names.end()) return std::nullopt;
  return static_cast<Interpolation>(at - interpolation_names.begin());
}

} // namespace frictab::table
