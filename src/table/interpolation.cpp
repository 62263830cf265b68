// Names of the interpolations, as jobs, files and recipes have them.
#include "table/interpolation.h"

#include <algorithm>
#include <array>

namespace frictab {

namespace {

constexpr std::array<const char*, 3> names = {"linear", "cubic", "none"}; // as Interpolation

} // namespace

const char* interpolation_name(Interpolation interpolation) {
  return names[static_cast<std::size_t>(interpolation)];
}

std::optional<Interpolation> find_interpolation(std::string_view name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return std::nullopt;
  return static_cast<Interpolation>(at - names.begin());
}

} // namespace frictab
