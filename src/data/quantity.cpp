// The canonical quantities of the outside contract, one row each.
#include "data/quantity.h"

#include <limits>
#include <vector>

namespace frictab {

std::span<const Quantity> quantities() {
  constexpr double any = -std::numeric_limits<double>::infinity();
  constexpr double absolute_zero = -273.15;
  static const std::vector<Quantity> all = {
      {"time_s", "t", "s", "time", any, false, false, {}},
      {"sigma_n_MPa",
       "sigma_N",
       "MPa",
       "contact normal stress, compression positive",
       0,
       true,
       true,
       {{500, 2750}}},
      {"psi", "psi", "1", "surface expansion ratio A1/A0", 1, true, true, {{1, 20}}},
      {"v_rel_mm_s", "v_rel", "mm/s", "relative sliding speed", 0, true, true, {{5, 500}}},
      {"T_contact_C", "T", "degC", "contact temperature", absolute_zero, true, false, {{20, 200}}},
      {"T_tool_C", "T_tool", "degC", "tool temperature", absolute_zero, false, false, {{20, 200}}},
      {"s_mm", "s_d", "mm", "sliding distance since first contact", 0, true, false, {}},
      {"sigma_f_MPa", "sigma_f", "MPa", "flow stress of the workpiece", 0, true, true, {}},
      {"tau_R_MPa", "tau_R", "MPa", "measured frictional shear stress", 0, false, false, {}},
      {"F_R_N", "F_R", "N", "friction force", 0, false, false, {}},
      {"F_N_N", "F_N", "N", "normal force", 0, false, false, {}},
  };
  return all;
}

const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : quantities())
    if (quantity.name == name) return &quantity;
  return nullptr;
}

bool is_measured(std::string_view name) {
  return name == "tau_R_MPa" || name == "F_R_N" || name == "F_N_N";
}

} // namespace frictab
