// Wanheim and Bay: the general friction model with the real contact area from slip-line theory.
#include <numbers>

#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

Formula build(const Conventions& conventions) {
  // f = 1 (full sticking) is where slopes become infinite: it is approached to 1e-12.
  const Expr f = Expr::symbol("f") * (1 - 1e-12);
  const Expr q = state::sigma_n_over(state::sigma_f());
  // t1: tau/k at the proportional limit q1; C1 there; tau -> f k for large q. With root =
  // sqrt(1-f): f - t1 = root t1, so that nothing is divided by f - t1, which is 0 for f = 1.
  // Slip lines give the limit as p/k: as p/sigma_f it follows the k that the job means.
  const Expr root = sqrt(1.0 - f);
  const Expr t1 = 1.0 - root;
  const Expr q1 = (1.0 + std::numbers::pi / 2 + acos(f) + root * sqrt(1.0 + f)) /
                  (flow_stress_ratio(conventions.shear_yield) * (1.0 + root));
  const Expr line = t1 / q1 * q;
  // Below q1 the exponent is held at 1/2, so that the branch not taken stays finite, and smooth
  // near q1: there its distance from the line is of second order, which bounds of drift live on.
  const Expr beyond = minimum(1.0 / root - 1.0 / (q1 * root) * q, 0.5); // (1 - q/q1)/root
  const Expr curve = t1 * (1.0 + root) - t1 * root * exp(beyond);
  const Expr tau = shear_yield_stress(conventions) * where_le(q, q1, line, curve);
  return {tau, state::value()};
}

Law wanheim_bay() {
  Law law;
  law.name = "wanheim_bay";
  law.order = 24;
  law.title = "Wanheim-Bay general friction model";
  law.formula = "q = sigma_N/sigma_f; tau_R/k = t1 q/q1 for q <= q1, "
                "t1 + (f-t1)(1-exp((1-q/q1) t1/(f-t1))) beyond; t1 = 1-sqrt(1-f), "
                "q1 = k/sigma_f (1+pi/2+acos f+sqrt(1-f^2))/(1+sqrt(1-f))";
  law.reference = "Wanheim and Bay 1976; recalled, its initial slope agrees to 4 digits with the "
                  "published equivalent mu = f/(1+pi/2+acos f+sqrt(1-f^2))";
  law.parameters = {
      {"f", "1", "friction factor", 0.3, 1e-4, 1, "experiments under load, below the shear limit"}};
  law.quantity = PieceQuantity::tau_R;
  law.log_value = true;
  law.build = build;
  // 0: q1 for k = sigma_f/sqrt(3), whatever k the job meant.
  law.revision = [](const Conventions& c) { return c.shear_yield == ShearYield::mises ? 0 : 1; };
  return law;
}

const Registered<Law> registered{wanheim_bay};

} // namespace

} // namespace frictab::models
