// The canonical quantities of the public interface, one row each.
#include "data/quantity.h"

#include <limits>
#include <vector>

namespace frictab::data {

std::span<const Quantity> quantities() {
  constexpr double any = -std::numeric_limits<double>::infinity();
  constexpr double absolute_zero = -273.15;
  static const std::vector<Quantity> all = {
      {.name = "time_s", .symbol = "t", .unit = "s", .meaning = "time", .lowest = any},
      {.name = "sigma_n_MPa",
       .symbol = "sigma_N",
       .unit = "MPa",
       .meaning = "contact normal stress, compression positive",
       .state = true,
       .log_axis = true,
       .paper_range = {{500, 2750}},
       .argument = true,
       .choice = "contact"},
      {.name = "psi",
       .symbol = "psi",
       .unit = "1",
       .meaning = "surface expansion ratio A1/A0",
       .lowest = 1,
       .state = true,
       .log_axis = true,
       .paper_range = {{1, 20}},
       .argument = true,
       .unknown = 1},
      {.name = "v_rel_mm_s",
       .symbol = "v_rel",
       .unit = "mm/s",
       .meaning = "relative sliding speed",
       .state = true,
       .log_axis = true,
       .paper_range = {{5, 500}},
       .argument = true,
       .choice = "contact"},
      {.name = "T_contact_C",
       .symbol = "T",
       .unit = "degC",
       .meaning = "contact temperature",
       .lowest = absolute_zero,
       .state = true,
       .paper_range = {{20, 200}},
       .argument = true,
       .choice = "temperature",
       .unknown = 20},
      {.name = "T_tool_C",
       .symbol = "T_tool",
       .unit = "degC",
       .meaning = "tool temperature",
       .lowest = absolute_zero,
       .paper_range = {{20, 200}}},
      {.name = "s_mm",
       .symbol = "s_d",
       .unit = "mm",
       .meaning = "sliding distance since first contact",
       .state = true,
       .argument = true,
       .choice = "state",
       .unknown = 0},
      {.name = "sigma_f_MPa",
       .symbol = "sigma_f",
       .unit = "MPa",
       .meaning = "flow stress of the workpiece",
       .state = true,
       .log_axis = true,
       .argument = true},
      {.name = "tau_R_MPa",
       .symbol = "tau_R",
       .unit = "MPa",
       .meaning = "measured frictional shear stress"},
      {.name = "tau_R_error_MPa",
       .symbol = "u_tau",
       .unit = "MPa",
       .meaning = "standard uncertainty of the measured frictional shear stress"},
      {.name = "F_R_N", .symbol = "F_R", .unit = "N", .meaning = "friction force"},
      {.name = "F_N_N", .symbol = "F_N", .unit = "N", .meaning = "normal force"},
  };
  return all;
}

const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : quantities())
    if (quantity.name == name) return &quantity;
  return nullptr;
}

bool is_measured(std::string_view name) {
  return name == "tau_R_MPa" || name == "tau_R_error_MPa" || name == "F_R_N" || name == "F_N_N";
}

} // namespace frictab::data
