// Sensitivities by finite differences; splines of fitted effects.
#include "trace/search/directions.h"

#include <algorithm>
#include <set>

#include "stats/projection.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Piecewise linear functions with seven knots: they span any form of the quantity.
MatrixXd hat_functions(const VectorXd& x) {
  std::vector<double> sorted(x.data(), x.data() + x.size());
  std::sort(sorted.begin(), sorted.end());
  std::set<double> knots;
  for (int i = 0; i < tuning::knots_of_any_form; ++i)
    knots.insert(sorted[static_cast<std::size_t>(i) * (sorted.size() - 1) /
                        (tuning::knots_of_any_form - 1)]);
  MatrixXd columns(x.size(), static_cast<Index>(knots.size()));
  Index next = 0;
  for (const double knot : knots)
    columns.col(next++) = (x.array() - knot).max(0.0).matrix();
  columns.col(next - 1) = x; // the last hinge is zero everywhere
  return columns;
}

MatrixXd level_functions(const VectorXd& x, std::size_t levels) {
  MatrixXd columns(x.size(), static_cast<Index>(levels));
  for (std::size_t level = 0; level < levels; ++level)
    columns.col(static_cast<Index>(level)) =
        (x.array() == static_cast<double>(level)).cast<double>().matrix();
  return columns;
}

MatrixXd any_form(const Cause& cause, const Candidates& candidates) {
  const CandidateColumn& x = candidates.columns[cause.columns[0]];
  if (!cause.is_joint())
    return x.levels.empty() ? hat_functions(x.values) : level_functions(x.values, x.levels.size());
  MatrixXd levels = MatrixXd::Ones(x.values.size(), 1);
  VectorXd product = levels.col(0);
  for (const std::size_t c : cause.columns) {
    const CandidateColumn& one = candidates.columns[c];
    if (one.levels.empty())
      product.array() *= one.values.array() - one.values.mean();
    else
      levels = level_functions(one.values, one.levels.size());
  }
  MatrixXd all;
  for (Index l = 0; l < levels.cols(); ++l)
    stats::append_columns(all, levels.col(l).asDiagonal() * hat_functions(product));
  return all;
}

} // namespace

MatrixXd fitted_directions(const Campaign& campaign, const Rival& rival,
                           const Sensitivities& sensitivities) {
  MatrixXd all = rival.jacobian;
  for (std::size_t i = 0; i < rival.effects.size(); ++i) {
    const VectorXd& sensitivity = sensitivities[site_of(rival.effects[i])];
    if (sensitivity.size() == 0) continue;
    stats::append_columns(all, sensitivity.asDiagonal() *
                                   any_form(rival.causes[i], campaign.candidates));
  }
  return all;
}

Sensitivities sensitivities_of(const Campaign& campaign, const Rival& rival, double tau_scale_MPa) {
  const std::size_t own = campaign.law.parameters.size();
  BlockColumns columns = campaign.candidates.by_symbol;
  columns["everywhere"] = VectorXd::Ones(campaign.measured.size());
  const auto change = [&](effects::ActsOn acts_on) {
    effects::PlacedEffect everywhere;
    everywhere.form = effects::find_effect("linear");
    everywhere.inputs = {{"everywhere", {}, 0, 1}};
    everywhere.acts_on = acts_on;
    everywhere.parameters = {0, 0, 1}; // 1 + a x, x = 1
    std::vector<effects::PlacedEffect> effects = rival.effects;
    effects.push_back(everywhere);
    const models::Law law =
        effects::extended_law(campaign.law, campaign.conventions,
                              std::span(rival.parameters).first(own), effects, "sensitivity");
    const LawOnBlocks on(law, campaign.conventions, columns);
    std::vector<double> at = start_of(law, rival.parameters, own, effects);
    const auto amplitude = static_cast<std::size_t>(
        std::find_if(law.parameters.begin(), law.parameters.end(),
                     [&](const models::Parameter& p) {
                       return p.name == "e" + std::to_string(effects.size()) + "_a";
                     }) -
        law.parameters.begin());
    at[amplitude] = tuning::factor_step;
    const VectorXd up = on.predict(at);
    at[amplitude] = -tuning::factor_step;
    return VectorXd((up - on.predict(at)) / (2 * tuning::factor_step));
  };
  Sensitivities all;
  all[on_mu] = change(effects::ActsOn::mu);
  if (effects::has_limit(campaign.law, campaign.conventions)) {
    all[1] = change(effects::ActsOn::m);
    if (all[1].squaredNorm() < tuning::felt_share_of_squares * all[0].squaredNorm())
      all[1].resize(0);
  }
  if (effects::has_own_limit(campaign.law, campaign.conventions))
    all[on_both] = change(effects::ActsOn::mu_m);
  all[2] = VectorXd::Constant(campaign.measured.size(), tau_scale_MPa);
  return all;
}

} // namespace frictab::trace
