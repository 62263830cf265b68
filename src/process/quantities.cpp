// One row per column of a simulation's files.
#include "process/quantities.h"

#include <limits>

#include "core/names.h"

namespace frictab::process {

namespace {

using data::Quantity;

constexpr double any = -std::numeric_limits<double>::infinity();

// A state of the tests as a simulation gives it. An elastically pressed surface has psi just below
// 1, and some solvers report slip speeds with a sign.
Quantity as_simulated(const char* name, double lowest) {
  Quantity quantity = *data::find_quantity(name);
  quantity.lowest = lowest;
  return quantity;
}

} // namespace

std::span<const Quantity> contact_quantities() {
  static const std::vector<Quantity> all = {
      *data::find_quantity("time_s"),
      {.name = "area_mm2",
       .symbol = "A",
       .unit = "mm2",
       .meaning = "contact area now that the facet stands for"},
      {.name = "area_start_mm2",
       .symbol = "A0",
       .unit = "mm2",
       .meaning = "area of the same facet on the undeformed billet"},
      as_simulated("sigma_n_MPa", any),
      as_simulated("psi", 0),
      as_simulated("v_rel_mm_s", any),
      {.name = "slip_1_mm",
       .symbol = "u1",
       .unit = "mm",
       .meaning = "slip so far along the first tangent",
       .lowest = any},
      {.name = "slip_2_mm",
       .symbol = "u2",
       .unit = "mm",
       .meaning = "slip so far along the second tangent",
       .lowest = any},
      *data::find_quantity("T_contact_C"),
      *data::find_quantity("s_mm"),
      *data::find_quantity("sigma_f_MPa"),
      {.name = "plastic_strain",
       .symbol = "eps_p",
       .unit = "1",
       .meaning = "equivalent plastic strain at the surface"},
      as_simulated("tau_R_MPa", any),
      {.name = "tau_1_MPa",
       .symbol = "tau1",
       .unit = "MPa",
       .meaning = "the solver's shear stress along the first tangent",
       .lowest = any},
      {.name = "tau_2_MPa",
       .symbol = "tau2",
       .unit = "MPa",
       .meaning = "the solver's shear stress along the second tangent",
       .lowest = any},
      {.name = "x_mm", .symbol = "x", .unit = "mm", .meaning = "place of the facet", .lowest = any},
      {.name = "y_mm", .symbol = "y", .unit = "mm", .meaning = "place of the facet", .lowest = any},
      {.name = "z_mm", .symbol = "z", .unit = "mm", .meaning = "place of the facet", .lowest = any},
      {.name = "r_mm", .symbol = "r", .unit = "mm", .meaning = "radius of the facet"},
  };
  return all;
}

std::span<const Quantity> tool_quantities() {
  static const std::vector<Quantity> all = {
      *data::find_quantity("time_s"),
      {.name = "force_kN",
       .symbol = "F",
       .unit = "kN",
       .meaning = "force of the tool",
       .lowest = any},
      {.name = "speed_mm_s",
       .symbol = "v",
       .unit = "mm/s",
       .meaning = "speed of the tool along its force",
       .lowest = any},
      {.name = "stroke_mm",
       .symbol = "h",
       .unit = "mm",
       .meaning = "way of the tool",
       .lowest = any},
      {.name = "friction_J",
       .symbol = "W",
       .unit = "J",
       .meaning = "friction work that the solver has summed so far",
       .lowest = any},
  };
  return all;
}

std::span<const Quantity> curve_quantities() {
  static const std::vector<Quantity> all = {
      {.name = "plastic_strain",
       .symbol = "eps_p",
       .unit = "1",
       .meaning = "equivalent plastic strain"},
      *data::find_quantity("sigma_f_MPa"),
  };
  return all;
}

std::vector<std::string> contact_columns() {
  std::vector<std::string> names = all_names(contact_quantities(), &Quantity::name);
  names.insert(names.begin(), facet_column);
  return names;
}

std::vector<std::string> tool_columns() {
  return all_names(tool_quantities(), &Quantity::name);
}

std::vector<std::string> rig_settings() {
  return {setting_names.begin(), setting_names.end()};
}

} // namespace frictab::process
