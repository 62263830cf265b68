// Extended Coulomb, multiplicative and exponential in temperature.
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

Formula build(const Conventions&) {
  // (sigma_N/1000)^a as exp(a ln(sigma_N/1000)): one exponential in all, and logarithms that do not
  // change while the parameters do.
  const Expr ln_stress = log(maximum(state::sigma_n(), 1e-3) / 1000.0);
  const Expr mu = Expr::symbol("mu0") * exp(Expr::symbol("a") * ln_stress +
                                            Expr::symbol("b") * (state::temperature() - 20.0));
  return {mu, state::value() * state::sigma_n()};
}

Law exp_coulomb() {
  Law law;
  law.name = "exp_coulomb";
  law.order = 31;
  law.title = "extended Coulomb, multiplicative-exponential";
  law.formula = "tau_R = sigma_N mu0 (sigma_N/1000)^a exp(b (T-20))";
  law.reference = "arguments as in the benchmark's multiplicative-exponential extension, which it "
                  "does not print; this form is ours";
  law.parameters = {{"mu0", "1", "coefficient at 1000 MPa and 20 degC", 0.08, 1e-6, 2,
                     "experiments under load, below the shear limit"},
                    {"a", "1",
                     "exponent of the contact normal stress; below -1 tau_R would fall with it", 0,
                     -1, 3, "experiments at several contact normal stresses"},
                    {"b", "1/K", "relative change per kelvin", 0, -0.1, 0.1,
                     "experiments at several temperatures"}};
  law.log_value = true;
  law.build = build;
  return law;
}

const Registered<Law> registered{exp_coulomb};

} // namespace

} // namespace frictab::models
