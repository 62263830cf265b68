// Shaw: smooth transition from Coulomb to shear friction.
#include "models/symbols.h"

namespace frictab {

namespace {

Formula build(const Conventions& conventions) {
  const Expr limit = Expr::symbol("m") * shear_yield_stress(conventions);
  const Expr n = Expr::symbol("n");
  // u/(1+u^n)^(1/n) = exp(-ln(1+u^-n)/n): written by ln u so that no power overflows for large n.
  const Expr u = state::value() * state::sigma_n() / limit;
  const Expr large = pow(maximum(u, 1.0), -n); // u >= 1: 1/(1+u^-n)^(1/n)
  const Expr small = pow(minimum(u, 1.0), n);  // u <  1: u/(1+u^n)^(1/n)
  const Expr transition =
      where_le(u, 1.0, u / pow(1.0 + small, 1.0 / n), 1.0 / pow(1.0 + large, 1.0 / n));
  return {Expr::symbol("mu"), limit * transition};
}

Law shaw() {
  Law law;
  law.name = "shaw";
  law.order = 23;
  law.title = "Shaw: smooth transition from Coulomb to shear friction";
  law.formula = "tau_R = m k u/(1+u^n)^(1/n), u = mu sigma_N/(m k)";
  law.reference =
      "three regimes after Shaw 1963 (recalled); the closed form with exponent n is ours: "
      "slope mu at 0, plateau m k, n -> infinity is Orowan";
  law.parameters = {{"mu", "1", "friction coefficient at low contact normal stress", 0.1, 0, 2},
                    {"m", "1", "friction factor of the plateau", 0.5, 0.001, 1},
                    {"n", "1", "sharpness of the transition", 2, 0.5, 20}};
  law.build = build;
  return law;
}

const Registered<Law> registered{shaw};

} // namespace

} // namespace frictab
