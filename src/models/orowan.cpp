// Orowan: Coulomb up to the shear friction stress.
#include "models/orowan_optimum.h"
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;

namespace {

Formula build(const Conventions& conventions) {
  // The kink stays outside the tabulated piece: it is combined exactly after interpolation.
  return {Expr::symbol("mu"), minimum(state::value() * state::sigma_n(),
                                      Expr::symbol("m") * shear_yield_stress(conventions))};
}

std::vector<std::vector<double>> starts(const Conventions& conventions, const TrainingRows& rows) {
  const auto sigma_f = rows.at("sigma_f_MPa");
  std::vector<double> k(sigma_f.begin(), sigma_f.end());
  for (double& x : k)
    x *= conventions.k_over_sigma_f;
  std::vector<std::vector<double>> points;
  OrowanRows of{rows.at("sigma_n_MPa"), k, rows.at("tau_R_MPa")};
  if (const auto weights = rows.find(row_weights); weights != rows.end())
    of.weights = weights->second;
  for (const auto& [mu, m] : orowan_optimum(of, 12))
    points.push_back({mu, m});
  return points;
}

Law orowan() {
  Law law;
  law.name = "orowan";
  law.order = 22;
  law.title = "Orowan: Coulomb friction limited by shear friction";
  law.formula = "tau_R = min(mu sigma_N, m k)";
  law.reference = "Orowan 1943 (m = 1 in the original); form recalled, standard in the field";
  law.parameters = {{"mu", "1", "friction coefficient", 0.08, 0, 1,
                     "experiments at lower sigma_N/k, where friction still grows with sigma_N"},
                    {"m", "1", "friction factor of the limit", 0.3, 0, 1,
                     "experiments at higher sigma_N/k, where friction has reached m k"}};
  law.build = build;
  law.starts = starts;
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

} // namespace frictab::models
