// Extended Coulomb, logarithmic: mu falls or rises with the logarithms of the state.
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

// Arguments of the logarithms are floored far below any tribometer's range, so that a resting or
// ice-cold contact gives a finite coefficient.
Expr scaled_log(const Expr& x, double floor, double reference) {
  return log(maximum(x, floor) / reference);
}

Formula build(const Conventions&) {
  const Expr mu = Expr::symbol("c0") +
                  Expr::symbol("c1") * scaled_log(state::sigma_n(), 1e-3, 1000) +
                  Expr::symbol("c2") * scaled_log(state::psi(), 1, 1) +
                  Expr::symbol("c3") * scaled_log(state::v_rel(), 1e-6, 100) +
                  Expr::symbol("c4") * scaled_log(state::temperature(), 1, 100);
  return {mu, maximum(state::value(), 0.0) * state::sigma_n()};
}

Law log_coulomb() {
  Law law;
  law.name = "log_coulomb";
  law.order = 30;
  law.title = "extended Coulomb, logarithmic";
  law.formula = "tau_R = sigma_N max(0, c0 + c1 ln(sigma_N/1000) + c2 ln psi + c3 ln(v/100) "
                "+ c4 ln(T/100)); v >= 1e-6 mm/s, T >= 1 degC inside the logarithms";
  law.reference = "arguments as in the benchmark's logarithmic extension, which it does not print; "
                  "this form is ours";
  law.parameters = {{"c0", "1", "coefficient at 1000 MPa, psi 1, 100 mm/s, 100 degC", 0.08, -2, 2,
                     "experiments under load, below the shear limit"},
                    {"c1", "1", "change per ln(contact normal stress)", 0, -1, 1,
                     "experiments at several contact normal stresses"},
                    {"c2", "1", "change per ln(surface expansion)", 0, -1, 1,
                     "experiments at several surface expansions"},
                    {"c3", "1", "change per ln(sliding speed)", 0, -1, 1,
                     "experiments at several sliding speeds"},
                    {"c4", "1", "change per ln(contact temperature)", 0, -1, 1,
                     "experiments at several temperatures"}};
  law.log_axes = {{"T_contact_C", true}};
  law.build = build;
  return law;
}

const Registered<Law> registered{log_coulomb};

} // namespace

} // namespace frictab::models
