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

struct ShearYieldRow {
  const char* name; // in job files, calibrations and tables
  double k_over_sigma_f;
  double sigma_f_over_k; // stored too, because the inverse of k/sigma_f is rounded
};
inline constexpr ShearYieldRow shear_yield_rows[] = { // in the order of ShearYield
    {"mises", 0.57735026918962584, std::numbers::sqrt3},
    {"tresca", 0.5, 2},
    {"flow_stress", 1, 1}};

constexpr const char* shear_yield_name(ShearYield convention) {
  return shear_yield_rows[static_cast<int>(convention)].name;
}

constexpr std::optional<ShearYield> find_shear_yield(std::string_view name) {
  for (const ShearYield convention : shear_yields)
    if (name == shear_yield_name(convention)) return convention;
  return std::nullopt;
}

constexpr double shear_yield_ratio(ShearYield convention) {
  return shear_yield_rows[static_cast<int>(convention)].k_over_sigma_f;
}

constexpr double flow_stress_ratio(ShearYield convention) {
  return shear_yield_rows[static_cast<int>(convention)].sigma_f_over_k;
}

} // namespace frictab::models
