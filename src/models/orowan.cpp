// Orowan: Coulomb up to the shear friction stress.
#include "models/symbols.h"

namespace frictab {

namespace {

Formula build(const Conventions& conventions) {
  // The kink stays outside the tabulated piece: it is combined exactly after interpolation.
  return {Expr::symbol("mu"), minimum(state::value() * state::sigma_n(),
                                      Expr::symbol("m") * shear_yield_stress(conventions))};
}

Law orowan() {
  Law law;
  law.name = "orowan";
  law.order = 22;
  law.title = "Orowan: Coulomb friction limited by shear friction";
  law.formula = "tau_R = min(mu sigma_N, m k)";
  law.reference = "Orowan 1943 (m = 1 in the original); form recalled, standard in the field";
  law.parameters = {{"mu", "1", "friction coefficient", 0.08, 0, 1},
                    {"m", "1", "friction factor of the limit", 0.3, 0, 1}};
  law.build = build;
  return law;
}

Law orowan_mean() {
  Law law = orowan();
  law.name = "orowan_mean";
  law.order = 12;
  law.title = "Orowan, mu and m = means of the measured ones";
  law.calibrated = Calibrated::mean;
  law.reference =
      "the calibration of the cold-forging benchmark: means of tau_R/sigma_N and of tau_R/k";
  return law;
}

const Registered<Law> fitted{orowan};
const Registered<Law> averaged{orowan_mean};

} // namespace

} // namespace frictab
