// Laws of the registry as truths of the synthetic campaign.
#include "twin/twin_law.h"

#include "calibrate/law_problem.h"
#include "effects/extended_law.h"

namespace frictab {

namespace {

// Stands for all effects at one site (mu, limit or added): its column is their factor.
const EffectForm& planted_form() {
  static const EffectForm form = [] {
    EffectForm all;
    all.name = "planted";
    all.formula = "x";
    all.factor = [] { return Expr::symbol("x"); };
    return all;
  }();
  return form;
}

PlacedEffect planted_on(ActsOn acts_on) {
  PlacedEffect effect;
  effect.form = &planted_form();
  effect.inputs = {{std::string("planted_") + acts_on_name(acts_on), {}, -1e300, 1e300}};
  effect.acts_on = acts_on;
  return effect;
}

// Columns are the law's states and the three factors, scalars the law's own parameters.
Program program_of(const Law& law, const Conventions& conventions) {
  std::vector<double> start;
  for (const Parameter& parameter : law.parameters)
    start.push_back(parameter.start);
  const std::vector<PlacedEffect> effects = {planted_on(ActsOn::mu), planted_on(ActsOn::m),
                                             planted_on(ActsOn::tau)};
  const Law extended = extended_law(law, conventions, start, effects, law.name);
  std::map<std::string, Expr> neutral; // the limit that the law did not have is k
  for (std::size_t p = start.size(); p < extended.parameters.size(); ++p)
    neutral.emplace(extended.parameters[p].name, extended.parameters[p].start);
  return {substitute(tau_formula(extended, conventions), neutral), inputs(extended, conventions),
          parameter_names(law)};
}

// Behind `columns` stands the storage of the one that is computed.
struct Rows {
  std::vector<double> shifted;
  std::vector<const double*> columns;
};

Rows rows_of(const Program& program, const Dataset& data, const TauPieces& pieces) {
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

LawTruth::LawTruth(const Law& law, const Dataset& physics)
    : law_(law),
      parameters_(LawProblem(law, conventions_, physics).fit(Loss::l2, 0).result.parameters),
      program_(program_of(law, conventions_)) {}

bool LawTruth::has_limit() const {
  return frictab::has_limit(law_, conventions_);
}

std::vector<double> LawTruth::tau(const Dataset& data, const TauPieces& pieces,
                                  std::span<const double> parameters) const {
  const Rows rows = rows_of(program_, data, pieces);
  std::vector<double> tau(data.rows());
  program_.evaluate(tau.size(), rows.columns, parameters, tau.data());
  return tau;
}

std::vector<double> LawTruth::recalibrated(const Dataset& data, const TauPieces& pieces,
                                           std::span<const double> measured,
                                           std::size_t steps) const {
  const Rows rows = rows_of(program_, data, pieces);
  const BoundProgram bound(program_, data.rows(), rows.columns);
  return fit_from({bound, measured, law_.parameters}, {Loss::l2, 0}, parameters_,
                  {.tolerance = 1e-8, .damping = 1e-6, .iterations = steps})
      .parameters;
}

std::vector<std::string> truth_names() {
  std::vector<std::string> names;
  for (const Law& law : all_laws())
    if (law.calibrated == Calibrated::fit) names.push_back(law.name);
  return names;
}

} // namespace frictab
