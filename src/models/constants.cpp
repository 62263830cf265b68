// The constants that the paper takes from the literature: tau_R = mu sigma_N and tau_R = m k.
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

Formula coulomb(const Conventions&) {
  return {Expr::symbol("mu"), state::value() * state::sigma_n()};
}

Formula shear(const Conventions& conventions) {
  return {Expr::symbol("m") * shear_yield_stress(conventions), state::value()};
}

Law constant(int order, const char* name, const char* symbol, double value, const char* source) {
  const bool is_mu = std::string(symbol) == "mu";
  Law law;
  law.name = name;
  law.order = order;
  law.title = is_mu ? "Coulomb constant of the literature" : "shear constant of the literature";
  law.formula = is_mu ? "tau_R = mu sigma_N" : "tau_R = m k";
  law.reference = source;
  law.calibrated = Calibrated::fixed;
  law.parameters = {{symbol, "1", is_mu ? "friction coefficient" : "friction factor", value, 0, 1}};
  law.build = is_mu ? coulomb : shear;
  law.quantity = is_mu ? PieceQuantity::mu : PieceQuantity::tau_R;
  law.log_value = !is_mu;
  return law;
}

const char* const benchmark =
    "standard constant of the cold-forging benchmark of friction models on shear-stress level";

const Registered<Law> coulomb_004{
    [] { return constant(1, "coulomb_0.04", "mu", 0.04, benchmark); }};
const Registered<Law> coulomb_008{
    [] { return constant(2, "coulomb_0.08", "mu", 0.08, benchmark); }};
const Registered<Law> shear_012{[] { return constant(3, "shear_0.12", "m", 0.12, benchmark); }};

} // namespace

} // namespace frictab::models
