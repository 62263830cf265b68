// Shaw: smooth transition from Coulomb to shear friction.
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

Formula build(const Conventions& conventions) {
  const Expr m = Expr::symbol("m"), n = Expr::symbol("n"), k = shear_yield_stress(conventions);
  // u/(1+u^n)^(1/n) = min(u,1)/(1+w^n)^(1/n) with w = min(u,1/u) <= 1: no power overflows for
  // large n, and one formula serves both sides of u = 1.
  const Expr slope = state::value() / m, load = state::sigma_n_over(k);
  const Expr u = slope * load;
  const Expr ln_u = log(maximum(slope, 1e-100)) + log(maximum(load, 1e-100));
  const Expr w_n = exp(-n * maximum(ln_u, -ln_u));
  const Expr transition = minimum(u, 1.0) * exp(-1.0 / n * log(1.0 + w_n));
  return {Expr::symbol("mu"), m * (k * transition)};
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
  law.parameters = {{"mu", "1", "friction coefficient at low contact normal stress", 0.1, 0, 2,
                     "experiments at lower sigma_N, where friction still grows with it"},
                    {"m", "1", "friction factor of the plateau", 0.5, 0.001, 1,
                     "experiments at higher sigma_N, where friction has reached m k"},
                    {"n", "1", "sharpness of the transition", 2, 0.5, 20,
                     "experiments with sigma_N around m k/mu (u near 1)"}};
  law.build = build;
  return law;
}

const Registered<Law> registered{shaw};

} // namespace

} // namespace frictab::models
