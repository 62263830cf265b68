// Start of a search: candidates, the law on blocks, its fit without effects; directions that a fit
// has used up.
#include "trace/search/search.h"

#include <set>

#include "core/progress.h"
#include "stats/noise_fit.h"
#include "stats/projection.h"
#include "trace/tuning.h"

namespace frictab::trace {

using expr::Expr;
using models::Model;

namespace {

bool is_trained(const models::Law& law) {
  return models::is_trained(law.calibrated);
}

// Quadratic functions of the inputs of a trained law: they represent the structure that it could
// have absorbed, which its one parameter cannot show.
MatrixXd trained_directions(const std::vector<std::string>& inputs, const BlockColumns& columns,
                            const VectorXd& predicted) {
  std::vector<VectorXd> z;
  for (const std::string& name : inputs) {
    VectorXd u = columns.at(name);
    if (u.minCoeff() > 0 && u.maxCoeff() > tuning::ratio_for_log_of_trained * u.minCoeff())
      u = u.array().log().matrix();
    if (stats::standardise(u)) z.push_back(std::move(u));
  }
  MatrixXd directions(predicted.size(), 0);
  for (std::size_t i = 0; i < z.size(); ++i) {
    stats::append_columns(directions, predicted.cwiseProduct(z[i]));
    for (std::size_t j = i; j < z.size(); ++j)
      stats::append_columns(directions, predicted.cwiseProduct(z[i]).cwiseProduct(z[j]));
  }
  return directions;
}

// Law in which the trained part becomes a column, so that a fit costs as little as for other laws:
// only the scale of the large formula is fitted here.
models::Law with_piece_as_column(const Model& model, const stats::Blocks& blocks,
                                 const data::Dataset& data, BlockColumns& columns) {
  const models::Law& law = *model.law;
  const models::Formula formula = law.build(model.conventions);
  const std::vector<std::string> names = models::inputs(law, model.conventions);
  const expr::Program piece(formula.value, names, models::parameter_names(law));
  std::vector<const double*> rows;
  for (const std::string& name : names)
    rows.push_back(data.values(name).data());
  std::vector<double> value(data.rows());
  piece.evaluate(data.rows(), rows, std::vector<double>(law.parameters.size(), 1.0), value.data());
  columns["trained_piece"] = blocks.mean(value);
  models::Law surrogate = law;
  const models::Formula with{
      Expr::symbol(law.parameters.front().name) * Expr::symbol("trained_piece"), formula.combine};
  surrogate.build = [with](const models::Conventions&) { return with; };
  return surrogate;
}

// Piecewise linear functions with seven knots: they span any form of the quantity.
MatrixXd hat_functions(const VectorXd& x) {
  std::vector<double> sorted(x.data(), x.data() + x.size());
  std::ranges::sort(sorted);
  std::set<double> knots;
  for (int i = 0; i < tuning::knots_of_any_form; ++i)
    knots.insert(sorted[i * (sorted.size() - 1) / (tuning::knots_of_any_form - 1)]);
  MatrixXd columns(x.size(), knots.size());
  Index next = 0;
  for (const double knot : knots)
    columns.col(next++) = (x.array() - knot).max(0.0).matrix();
  columns.col(next - 1) = x; // the last hinge is zero everywhere
  return columns;
}

MatrixXd any_form(const Cause& cause, const Candidates& candidates) {
  const CandidateColumn& x = candidates.first_of(cause);
  if (!cause.is_joint()) return x.levels.empty() ? hat_functions(x.values) : level_columns(x);
  MatrixXd levels = MatrixXd::Ones(x.values.size(), 1);
  VectorXd product = levels.col(0);
  for (const CandidateColumn* one : candidates.of(cause))
    if (one->levels.empty())
      product.array() *= one->values.array() - one->values.mean();
    else
      levels = stats::products(levels, level_columns(*one));
  if (candidates.texts_of(cause) == cause.columns.size()) return levels;
  MatrixXd all;
  for (Index l = 0; l < levels.cols(); ++l)
    stats::append_columns(all, levels.col(l).asDiagonal() * hat_functions(product));
  return all;
}

// Directions that count as fitted: those of all parameters and, for each effect in the law, of any
// form of its quantity (straight lines between seven values). Otherwise the misfit of the chosen
// form would be found as another effect of the same quantity.
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

// Derivatives of tau_R by a factor on mu, on the limit, on both, and by an addition of tau_scale.
// Central differences over +-6 %, so that rows near the limit respond to mu as well as to the
// limit.
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
        std::ranges::find_if(law.parameters,
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

} // namespace

Search::Ground::Ground(const TraceInput& in) : input(in), blocks(stats::make_blocks(in.training)) {
  const Model& model = in.fit.model;
  const std::vector<double> calibrated = calibrate::predict(model, in.training);
  const std::vector<std::string> inputs = models::inputs(*model.law, model.conventions);
  candidates = find_candidates(in.training, in.validation, blocks, calibrated, inputs, in.options);
  surrogate = is_trained(*model.law)
                  ? with_piece_as_column(model, blocks, in.training, candidates.by_symbol)
                  : *model.law;
  const LawOnBlocks law(surrogate, model.conventions, candidates.by_symbol);
  const VectorXd on_blocks = law.predict(model.parameters);
  // A curved law at a block's mean state differs from its mean over the block. That difference is
  // subtracted from the measured means once, as computed with the calibrated law.
  measured = blocks.mean(in.training.values("tau_R_MPa"));
  measured -= blocks.mean(calibrated) - on_blocks;
  if (is_trained(*model.law)) trained = trained_directions(inputs, candidates.by_symbol, on_blocks);
  tau_scale_MPa = measured.cwiseAbs().mean();
  one_factor = one_factor_at_a_time(state_means(candidates, blocks));
}

Search::Search(const TraceInput& in, const stats::NoiseModel* earlier) {
  const Progress progress("columns and noise", 0);
  ground_ = std::make_shared<const Ground>(in);
  const Ground& g = *ground_;
  Campaign campaign{g.surrogate,        in.fit.model.conventions,
                    g.blocks,           g.candidates,
                    g.measured,         {},
                    earlier != nullptr, select_tests(g.blocks, g.candidates, in.seed)};
  const Model& model = in.fit.model;
  const LawOnBlocks law(campaign.law, model.conventions, candidates().by_symbol);
  MatrixXd jacobian;
  const VectorXd predicted = law.predict(model.parameters, &jacobian);
  const VectorXd residual = campaign.measured - predicted;
  const stats::NoiseData data{residual, predicted, blocks(), jacobian, trained()};
  const stats::NoiseModel noise = earlier ? *earlier : campaign_noise(campaign, data);
  base_ = std::make_shared<const Rival>(
      fit_rival(campaign, {}, {}, model.parameters, noise, NoiseSearch::again));
  tie_parameters(campaign, *base_,
                 one_factor() ? tuning::tied_share_by_one_factor
                              : tuning::tied_share_of_information);
  campaign_ = std::make_shared<const Campaign>(std::move(campaign));
  *this = at(*base_);
}

Search Search::at(Rival rival) const {
  Search there = *this;
  there.sensitivities_ = sensitivities_of(*campaign_, rival, tau_scale_MPa());
  there.known_ = fitted_directions(*campaign_, rival, there.sensitivities_);
  stats::append_columns(there.known_, trained());
  there.last_ = std::move(rival);
  return there;
}

Search Search::fitted_again(MatrixXd nuisance) const {
  Search again = *this;
  Campaign campaign = *campaign_;
  campaign.nuisance = std::move(nuisance);
  again.campaign_ = std::make_shared<const Campaign>(std::move(campaign));
  return again.at(fit_rival(again.campaign(), last_.effects, last_.causes, last_.parameters,
                            last_.noise, NoiseSearch::again));
}

Model Search::model_of(const Rival& rival) const {
  Model model;
  model.conventions = input().fit.model.conventions;
  const models::Law& law = *input().fit.model.law;
  model.law = models::unregistered_law(effects::extended_law(
      law, model.conventions, std::span(rival.parameters).first(law.parameters.size()),
      rival.effects, models::traced_name(law.name)));
  model.parameters = rival.parameters;
  return model;
}

stats::Whitener Search::whitener() const {
  return {last_.noise, last_.predicted, blocks(), campaign_->nuisance};
}

bool Search::negligible() const {
  return stats::root_mean_square(residual()) < tuning::exact_law_share_of_tau * tau_scale_MPa();
}

} // namespace frictab::trace
