// Extended Coulomb, multiplicative and exponential in temperature.
#include "models/symbols.h"

namespace frictab {

namespace {

Formula build(const Conventions&) {
  const Expr mu = Expr::symbol("mu0") *
                  pow(maximum(state::sigma_n(), 1e-3) / 1000.0, Expr::symbol("a")) *
                  exp(Expr::symbol("b") * (state::temperature() - 20.0));
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
  law.parameters = {{"mu0", "1", "coefficient at 1000 MPa and 20 degC", 0.08, 1e-6, 2},
                    {"a", "1", "exponent of the contact normal stress", 0, -3, 3},
                    {"b", "1/K", "relative change per kelvin", 0, -0.1, 0.1}};
  law.log_value = true;
  law.build = build;
  return law;
}

const Registered<Law> registered{exp_coulomb};

} // namespace

} // namespace frictab
