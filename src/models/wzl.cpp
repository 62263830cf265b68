// WZL: product of powers of contact normal stress, sliding speed and temperature.
#include <cmath>

#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

// Those of log_coulomb, amid what tribometers reach. At 1 MPa, 1 mm/s and 1 degC, to which the
// published coefficient refers, no test runs: it cannot be told from the exponents there, and its
// error says nothing.
constexpr double p0_MPa = 1000, v0_mm_s = 100, T0_C = 100;

constexpr double published_C = 0.0623, published_a = -0.1542, published_b = -0.1192,
                 published_g = 0.1017;

double published_C_at_reference() {
  return published_C * std::pow(p0_MPa, published_a) * std::pow(v0_mm_s, published_b) *
         std::pow(T0_C, published_g);
}

Formula build(const Conventions&) {
  const Expr p = maximum(state::sigma_n(), 1.0) / p0_MPa;
  const Expr v = maximum(state::v_rel(), 10.0) / v0_mm_s;
  const Expr T = maximum(state::temperature(), 20.0) / T0_C;
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
  law.formula = "tau_R = sigma_N C (p/1000)^a (v/100)^b (T/100)^g; p >= 1 MPa, v >= 10 mm/s, "
                "T >= 20 degC (clamped)";
  law.reference = "published user routine of WZL, RWTH Aachen (sheet forming, 2017) without its "
                  "lubricant-amount factor; the clamps are its. Published: C = 0.0623 at 1 MPa, "
                  "1 mm/s, 1 degC, a = -0.1542, b = -0.1192, g = 0.1017; C is 0.0198 at the "
                  "reference, which is ours";
  law.parameters = {
      {"C", "1", "coefficient at p = 1000 MPa, v = 100 mm/s, T = 100 degC",
       published_C_at_reference(), 1e-9, 100, "experiments under load, below the shear limit"},
      {"a", "1", "exponent of the contact normal stress; below -1 tau_R would fall with it",
       published_a, -1, 3, "experiments at several contact normal stresses"},
      {"b", "1", "exponent of the sliding speed", published_b, -3, 3,
       "experiments at several sliding speeds above 10 mm/s"},
      {"g", "1", "exponent of the temperature", published_g, -3, 3,
       "experiments at several temperatures above 20 degC"}};
  law.log_value = true;
  law.log_axes = {{"T_contact_C", true}};
  // ln mu bends where a clamp begins; a node there keeps the table exact.
  law.kinks = {{"sigma_n_MPa", {1}}, {"v_rel_mm_s", {10}}, {"T_contact_C", {20}}};
  law.build = build;
  law.revision = [](const Conventions&) { return 1; }; // 0: C at 1 MPa, 1 mm/s, 1 degC
  return law;
}

const Registered<Law> registered{wzl};

} // namespace

} // namespace frictab::models
