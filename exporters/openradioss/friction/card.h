// The closed forms of /FRICTION in OpenRadioss: a friction coefficient mu over contact pressure p
// and sliding speed v, by the number Ifric:
//
//   0  mu = Fric
//   1  mu = Fric + C1 p + C2 v + C3 p v + C4 p^2 + C5 v^2
//   2  mu = Fric + C1 exp(C2 v) p^2 + C3 exp(C4 v) p + C5 exp(C6 v)      (Darmstad)
//   3  mu = C1 + (C3 - C1) x (2 - x),          x = v/C5,  up to C5       (Renard)
//      mu = C3 + (C4 - C3) y^2 (3 - 2 y),      y = (v - C5)/(C6 - C5), up to C6
//      mu = C2 - (C2 - C4)/(1 + (C2 - C4)(v - C6)^2),  beyond
//   4  mu = C1 + (Fric - C1) exp(-C2 v)
//
// and never below 1e-30. Sources: help of Altair Radioss 2021, /FRICTION; the engine's own code for
// interfaces of type 7, which adds Fric to 2, where the help has none.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "expr/expr.h"

namespace frictab::openradioss::friction {

// Numbers of a card, in one system of units.
struct Card {
  int ifric = 0;
  std::array<double, 6> c = {}; // C1 to C6
  double fric = 0;

  double& field(const std::string& name); // "C1" to "C6", "Fric"
  double field(const std::string& name) const;
};

inline constexpr double least_mu = 1e-30;

// Computes mu as the solver does.
double mu_by_solver(const Card& card, double pressure, double speed);

// Returns mu as a formula, without its least value; `field` gives a card's field by its name.
expr::Expr mu_formula(int ifric, const expr::Expr& pressure, const expr::Expr& speed,
                      const std::function<expr::Expr(const std::string&)>& field);

} // namespace frictab::openradioss::friction
