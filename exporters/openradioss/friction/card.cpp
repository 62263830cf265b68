// Evaluates the closed forms, once as the solver does and once as formulas.
#include "card.h"

#include <algorithm>
#include <cmath>

namespace frictab::openradioss::friction {

using expr::Expr;

double& Card::field(const std::string& name) {
  return name == "Fric" ? fric : c.at(static_cast<std::size_t>(name.at(1) - '1'));
}

double Card::field(const std::string& name) const {
  return name == "Fric" ? fric : c.at(static_cast<std::size_t>(name.at(1) - '1'));
}

namespace {

double renard(const std::array<double, 6>& c, double v) {
  if (v <= c[4]) {
    const double x = v / c[4];
    return c[0] + (c[2] - c[0]) * x * (2 - x);
  }
  if (v < c[5]) {
    const double y = (v - c[4]) / (c[5] - c[4]);
    return c[2] + (c[3] - c[2]) * (3 - 2 * y) * y * y;
  }
  const double difference = c[1] - c[3];
  return c[1] - difference / (1 + difference * (v - c[5]) * (v - c[5]));
}

double unlimited(const Card& card, double p, double v) {
  const std::array<double, 6>& c = card.c;
  switch (card.ifric) {
  case 1:
    return card.fric + (c[0] + c[3] * p) * p + (c[1] + c[2] * p) * v + c[4] * v * v;
  case 2:
    return card.fric + c[0] * std::exp(c[1] * v) * p * p + c[2] * std::exp(c[3] * v) * p +
           c[4] * std::exp(c[5] * v);
  case 3:
    return renard(c, v);
  case 4:
    return c[0] + (card.fric - c[0]) * std::exp(-c[1] * v);
  default:
    return card.fric;
  }
}

} // namespace

double mu_by_solver(const Card& card, double pressure, double speed) {
  const double mu = unlimited(card, pressure, speed);
  return mu < least_mu ? least_mu : mu; // not a number stays what it is
}

Expr mu_formula(int ifric, const Expr& p, const Expr& v,
                const std::function<Expr(const std::string&)>& field) {
  const auto c = [&](int number) { return field("C" + std::to_string(number)); };
  if (ifric == 0) return field("Fric");
  if (ifric == 1)
    return field("Fric") + c(1) * p + c(2) * v + c(3) * p * v + c(4) * p * p + c(5) * v * v;
  if (ifric == 2)
    return field("Fric") + c(1) * exp(c(2) * v) * p * p + c(3) * exp(c(4) * v) * p +
           c(5) * exp(c(6) * v);
  if (ifric == 4) return c(1) + (field("Fric") - c(1)) * exp(-(c(2) * v));
  const Expr x = v / c(5), y = (v - c(5)) / (c(6) - c(5)), step = c(2) - c(4), past = v - c(6);
  return where_le(v, c(5), c(1) + (c(3) - c(1)) * x * (2.0 - x),
                  where_le(v, c(6), c(3) + (c(4) - c(3)) * y * y * (3.0 - 2.0 * y),
                           c(2) - step / (1.0 + step * past * past)));
}

} // namespace frictab::openradioss::friction
