// WZL: product of powers of contact normal stress, sliding speed and temperature.
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

Formula build(const Conventions&) {
  const Expr p = maximum(state::sigma_n(), 1.0);
  const Expr v = maximum(state::v_rel(), 10.0);
  const Expr T = maximum(state::temperature(), 20.0);
  // The product of powers as one exponential of logarithms, which do not change while the
  // parameters do.
  const Expr mu = Expr::symbol("C") * exp(Expr::symbol("a") * log(p) + Expr::symbol("b") * log(v) +
                                          Expr::symbol("g") * log(T));
  return {mu, state::value() * state::sigma_n()};
}

Law wzl() {
  Law law;
  law.name = "wzl";
  law.order = 32;
  law.title = "WZL power product";
  law.formula = "tau_R = sigma_N C p^a v^b T^g; p >= 1 MPa, v >= 10 mm/s, T >= 20 degC (clamped)";
  law.reference = "published user routine of WZL, RWTH Aachen (sheet forming, 2017) without its "
                  "lubricant-amount factor; the clamps are its";
  law.parameters = {{"C", "1", "coefficient at p = 1 MPa, v = 1 mm/s, T = 1 degC", 0.0623, 1e-9,
                     100, "experiments under load, below the shear limit"},
                    {"a", "1", "exponent of the contact normal stress", -0.1542, -3, 3,
                     "experiments at several contact normal stresses"},
                    {"b", "1", "exponent of the sliding speed", -0.1192, -3, 3,
                     "experiments at several sliding speeds above 10 mm/s"},
                    {"g", "1", "exponent of the temperature", 0.1017, -3, 3,
                     "experiments at several temperatures above 20 degC"}};
  law.log_value = true;
  law.log_axes = {{"T_contact_C", true}};
  // ln mu bends where a clamp begins; a node there keeps the table exact.
  law.kinks = {{"sigma_n_MPa", {1}}, {"v_rel_mm_s", {10}}, {"T_contact_C", {20}}};
  law.build = build;
  return law;
}

const Registered<Law> registered{wzl};

} // namespace

} // namespace frictab::models
