// Levanov: shear friction that saturates with the contact normal stress.
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

Formula build(const Conventions& conventions) {
  const Expr saturation = 1.0 - exp(-1.25 * state::sigma_n_over(state::sigma_f()));
  return {Expr::symbol("m") * shear_yield_stress(conventions) * saturation, state::value()};
}

Law levanov() {
  Law law;
  law.name = "levanov";
  law.order = 25;
  law.title = "Levanov: shear friction saturating with contact normal stress";
  law.formula = "tau_R = m k (1 - exp(-1.25 sigma_N/sigma_f))";
  law.reference = "Levanov 1976; recalled; initial mu = 1.25 m/sqrt(3)";
  law.parameters = {
      {"m", "1", "friction factor", 0.2, 0, 1, "experiments under load, below the shear limit"}};
  law.quantity = PieceQuantity::tau_R;
  law.log_value = true;
  law.build = build;
  return law;
}

const Registered<Law> registered{levanov};

} // namespace

} // namespace frictab::models
