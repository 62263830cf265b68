// States and tables that the tests of several routines share.
#pragma once

#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::test {

// psi, sigma_f: what the tests pass as properties.
inline constexpr double psi = 2.5, flow = 480;

inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline const table::Table& four_axis() {
  static const table::Table table = four_axis_table();
  return table;
}

// tau_R by that table, in MPa.
inline double four_axis_tau(double pressure, double speed, double temperature,
                            double expansion = psi, double flow_stress = flow) {
  static const table::TableFunction table(four_axis());
  const double state[] = {pressure, expansion, speed, temperature, flow_stress};
  return table(state);
}

// Peak pressure and friction work as states of the law.
inline table::Table peak_and_work_table() {
  table::Table table;
  table.model = "histories";
  for (const auto& [name, unit, high] :
       {std::tuple{"peak_sigma_n", "MPa", 2000.0}, {"friction_work", "MPa mm", 500.0}}) {
    table::TableAxis axis;
    axis.name = name;
    axis.unit = unit;
    axis.nodes = {0, high};
    table.axes.push_back(axis);
  }
  table.value = {0.05, 0.09, 0.2, 0.3};
  table.combine = expr::Expr::symbol("value") * expr::Expr::symbol("sigma_n_MPa");
  return table;
}

// The sliding distance by both of its names: that of a law, and that of a traced effect.
inline table::Table two_slips_table() {
  table::Table table = constant_table();
  table.combine = expr::Expr::symbol("sigma_n_MPa") *
                  (expr::Expr::symbol("value") + expr::Expr(2e-3) * expr::Expr::symbol("s_mm") +
                   expr::Expr(3e-3) * expr::Expr::symbol("sliding_distance"));
  return table;
}

} // namespace frictab::test
