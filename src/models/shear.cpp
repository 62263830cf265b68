// Shear friction (Tresca): tau_R = m k, with m calibrated or as the mean of m_meas.
#include "models/symbols.h"

namespace frictab::models {

namespace {

Formula build(const Conventions& conventions) {
  return {expr::Expr::symbol("m") * shear_yield_stress(conventions), state::value()};
}

Law shear() {
  Law law;
  law.name = "shear";
  law.order = 21;
  law.title = "shear friction (constant friction factor)";
  law.formula = "tau_R = m k";
  law.reference =
      "the field's standard law at high contact normal stress; k by [models] shear_yield";
  law.parameters = {
      {"m", "1", "friction factor", 0.12, 0, 1, "experiments with a flow stress above 0"}};
  law.quantity = PieceQuantity::tau_R;
  law.log_value = true;
  law.build = build;
  return law;
}

Law shear_mean() {
  Law law = shear();
  law.name = "shear_mean";
  law.order = 11;
  law.title = "shear friction, m = mean of the measured friction factors";
  law.calibrated = Calibrated::mean;
  law.reference = "the calibration of the cold-forging benchmark: mean of tau_R/k";
  return law;
}

const Registered<Law> fitted{shear};
const Registered<Law> averaged{shear_mean};

} // namespace

} // namespace frictab::models
