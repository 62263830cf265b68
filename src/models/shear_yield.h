// Conventions of the shear yield stress k; papers on friction use different ones.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string_view>

namespace frictab::models {

enum class ShearYield {
  mises,      // k = sigma_f/sqrt(3)
  tresca,     // k = sigma_f/2
  flow_stress // k = sigma_f
};

inline constexpr std::array shear_yields{ShearYield::mises, ShearYield::tresca,
                                         ShearYield::flow_stress};

// Name of a convention in job files, calibrations and tables.
constexpr const char* shear_yield_name(ShearYield convention) {
  switch (convention) {
  case ShearYield::tresca:
    return "tresca";
  case ShearYield::flow_stress:
    return "flow_stress";
  default:
    return "mises";
  }
}

constexpr std::optional<ShearYield> find_shear_yield(std::string_view name) {
  for (const ShearYield convention : shear_yields)
    if (name == shear_yield_name(convention)) return convention;
  return std::nullopt;
}

// Returns k/sigma_f.
constexpr double shear_yield_ratio(ShearYield convention) {
  switch (convention) {
  case ShearYield::tresca:
    return 0.5;
  case ShearYield::flow_stress:
    return 1;
  default:
    return 0.57735026918962584; // 1/sqrt(3)
  }
}

// Returns sigma_f/k directly, because the inverse of k/sigma_f is rounded.
constexpr double flow_stress_ratio(ShearYield convention) {
  switch (convention) {
  case ShearYield::tresca:
    return 2;
  case ShearYield::flow_stress:
    return 1;
  default:
    return std::numbers::sqrt3;
  }
}

} // namespace frictab::models
