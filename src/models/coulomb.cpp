// Coulomb: tau_R = mu sigma_N, with mu calibrated or as the mean of mu_meas.
#include "models/symbols.h"

namespace frictab::models {

namespace {

Formula build(const Conventions&) {
  return {expr::Expr::symbol("mu"), state::value() * state::sigma_n()};
}

Law coulomb() {
  Law law;
  law.name = "coulomb";
  law.order = 20;
  law.title = "Coulomb friction";
  law.formula = "tau_R = mu sigma_N";
  law.reference = "Coulomb 1785; the field's standard law at low contact normal stress";
  law.parameters = {{"mu", "1", "friction coefficient", 0.08, 0, 1,
                     "experiments under load, below the shear limit"}};
  law.build = build;
  return law;
}

Law coulomb_mean() {
  Law law = coulomb();
  law.name = "coulomb_mean";
  law.order = 10;
  law.title = "Coulomb friction, mu = mean of the measured coefficients";
  law.calibrated = Calibrated::mean;
  law.reference = "the calibration of the cold-forging benchmark: mean of tau_R/sigma_N";
  return law;
}

const Registered<Law> fitted{coulomb};
const Registered<Law> averaged{coulomb_mean};

} // namespace

} // namespace frictab::models
