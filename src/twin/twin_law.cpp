// Laws as truths of the synthetic campaign.
#include "twin/twin_law.h"

#include <algorithm>

#include "calibrate/law_problem.h"
#include "data/quantity.h"
#include "effects/extended_law.h"
#include "job/literature.h"

namespace frictab::twin {

using expr::Expr;

namespace {

// Placeholder for all effects at one site (mu, limit or added); its column is their factor.
const effects::EffectForm& planted_form() {
  static const effects::EffectForm form = [] {
    effects::EffectForm all;
    all.name = "planted";
    all.formula = "x";
    all.factor = Expr::symbol("x");
    return all;
  }();
  return form;
}

effects::PlacedEffect planted_on(effects::ActsOn acts_on) {
  effects::PlacedEffect effect;
  effect.form = &planted_form();
  effect.inputs = {{std::string("planted_") + effects::acts_on_name(acts_on), {}, -1e300, 1e300}};
  effect.acts_on = acts_on;
  return effect;
}

// Compiles the law: columns are its states and the three factors, scalars are its own parameters.
expr::Program program_of(const models::Law& law, const models::Conventions& conventions) {
  const std::vector<double> start = models::start_values(law.parameters);
  const std::vector<effects::PlacedEffect> effects = {planted_on(effects::ActsOn::mu),
                                                      planted_on(effects::ActsOn::m),
                                                      planted_on(effects::ActsOn::tau)};
  const models::Law extended = effects::extended_law(law, conventions, start, effects, law.name);
  std::map<std::string, Expr> neutral; // the limit is k for a law that has none
  for (std::size_t p = start.size(); p < extended.parameters.size(); ++p)
    neutral.emplace(extended.parameters[p].name, extended.parameters[p].start);
  return {substitute(models::tau_formula(extended, conventions), neutral),
          models::inputs(extended, conventions), models::parameter_names(law)};
}

// The columns of a program. `shifted` is the storage of the column that is computed.
struct Rows {
  std::vector<double> shifted;
  std::vector<const double*> columns;
};

Rows rows_of(const expr::Program& program, const data::Dataset& data, const TauPieces& pieces) {
  Rows rows;
  for (const double shift : pieces.shift)
    rows.shifted.push_back(1.0 + shift);
  const std::map<std::string, const double*> planted = {{"planted_mu", pieces.tau0.data()},
                                                        {"planted_m", pieces.limit.data()},
                                                        {"planted_tau", rows.shifted.data()}};
  for (const std::string& name : program.columns()) {
    const auto found = planted.find(name);
    rows.columns.push_back(found != planted.end() ? found->second : data.values(name).data());
  }
  return rows;
}

} // namespace

LawTruth::LawTruth(const models::Law& law, const data::Dataset& physics)
    : law_(law), parameters_(calibrate::LawProblem(law, conventions_, physics)
                                 .fit(calibrate::Loss::l2, 0)
                                 .result.parameters),
      program_(program_of(law, conventions_)) {}

bool LawTruth::has_limit() const {
  return effects::has_limit(law_, conventions_);
}

std::vector<double> LawTruth::tau(const data::Dataset& data, const TauPieces& pieces,
                                  std::span<const double> parameters) const {
  const Rows rows = rows_of(program_, data, pieces);
  std::vector<double> tau(data.rows());
  program_.evaluate(tau.size(), rows.columns, parameters, tau.data());
  return tau;
}

std::vector<double> LawTruth::recalibrated(const data::Dataset& data, const TauPieces& pieces,
                                           std::span<const double> measured,
                                           std::size_t steps) const {
  const Rows rows = rows_of(program_, data, pieces);
  const expr::BoundProgram bound(program_, data.rows(), rows.columns);
  return calibrate::fit_from({bound, measured, law_.parameters}, {calibrate::Loss::l2, 0},
                             parameters_,
                             {.tolerance = 1e-8, .most_steps = steps, .first_damping = 1e-6})
      .parameters;
}

std::vector<std::string> truth_names() {
  std::vector<std::string> names;
  for (const std::string& name : job::literature().names()) {
    const models::Law& law = *job::literature().find(name);
    const std::vector<std::string> inputs = models::inputs(law, {});
    const bool of_states = std::ranges::all_of(
        inputs, [](const std::string& input) { return data::find_quantity(input); });
    if (law.calibrated == models::Calibrated::fit && of_states) names.push_back(name);
  }
  return names;
}

} // namespace frictab::twin
