// Joint fits of law, effects and noise; comparison by experiment.
#include "trace/search/rivals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "core/parallel.h"
#include "stats/noise_fit.h"
#include "stats/resampling.h"
#include "trace/columns/shapes.h"
#include "trace/tuning.h"

namespace frictab::trace {

using effects::PlacedEffect;

namespace {

void take_parameters(Rival& rival) {
  for (std::size_t i = 0; i < rival.effects.size(); ++i)
    effects::set_fitted(rival.effects[i],
                        std::span(rival.parameters)
                            .subspan(first_parameter(rival, i),
                                     effects::fitted_parameters(rival.effects[i]).size()));
}

VectorXd by_experiment(const VectorXd& whitened, const stats::Whitener& whitener,
                       const stats::Blocks& blocks) {
  VectorXd value(blocks.experiments());
  for (Index e = 0; e < value.size(); ++e)
    value(e) = -0.5 * (blocks.part(whitened, e).squaredNorm() + whitener.log_det()(e));
  return value;
}

bool on_limit(const std::vector<PlacedEffect>& effects) {
  return contains(effects, effects::ActsOn::m, &PlacedEffect::acts_on);
}

// Penalties of smooth effects and on the law's own parameters.
Penalty penalties(const Campaign& campaign, const Rival& rival) {
  Penalty all{penalty_of(rival), {}};
  const Index own = campaign.own.centre.size();
  const auto of_the_law = [&](const Cause& cause) {
    return std::ranges::any_of(campaign.candidates.of(cause), &CandidateColumn::in_law);
  };
  if (own == 0 || std::ranges::none_of(rival.causes, of_the_law)) return all;
  const Index count = rival.parameters.size();
  if (all.matrix.size() == 0) all.matrix = MatrixXd::Zero(count, count);
  all.centre = VectorXd::Zero(count);
  all.matrix.topLeftCorner(own, own) += campaign.own.matrix;
  all.centre.head(own) = campaign.own.centre;
  return all;
}

// Effective number of parameters: penalised ones count by their remaining freedom.
double freedom_of(const Rival& rival, const stats::Whitener& whitener) {
  const Index count = rival.parameters.size();
  const MatrixXd penalty = penalty_of(rival);
  if (penalty.size() == 0) return static_cast<double>(count);
  MatrixXd jacobian = rival.jacobian;
  whitener.apply(jacobian);
  const MatrixXd normal = jacobian.transpose() * jacobian;
  MatrixXd with = normal + penalty;
  with.diagonal().array() += tuning::freedom_ridge * with.diagonal().maxCoeff();
  return with.ldlt().solve(normal).trace();
}

// Whether the fit is finite and no effect makes friction negative.
bool is_possible(const Rival& rival, const Campaign& campaign) {
  return std::isfinite(rival.total) && std::isfinite(rival.freedom) &&
         std::ranges::all_of(rival.effects, [&](const PlacedEffect& effect) {
           return effect.acts_on == effects::ActsOn::tau ||
                  factor_on(effect, campaign.candidates.by_symbol).minCoeff() > 0;
         });
}

void evaluate(Rival& rival, const Campaign& campaign) {
  const stats::Whitener whitener(rival.noise, rival.predicted, campaign.blocks, campaign.nuisance);
  MatrixXd residual = campaign.measured - rival.predicted;
  whitener.apply(residual);
  rival.log_likelihood = by_experiment(residual.col(0), whitener, campaign.blocks);
  rival.total = rival.log_likelihood.sum();
  rival.freedom = freedom_of(rival, whitener);
  double cost = tuning::parameter_cost * rival.freedom;
  for (const Cause& cause : rival.causes)
    cost += tuning::rival_step_cost * complexity(cause, campaign.candidates);
  for (std::size_t i = 0; i < rival.effects.size(); ++i)
    cost += implausibility(rival.effects[i], campaign.candidates.first_of(rival.causes[i]));
  rival.penalised =
      is_possible(rival, campaign) ? rival.total - cost : -std::numeric_limits<double>::infinity();
}

// Start values of the law's own parameters, followed by m_limit if an effect acts on the limit.
std::vector<double> own_parameters(const Campaign& campaign, const Rival& from) {
  const auto own = static_cast<long>(campaign.law.parameters.size());
  std::vector<double> start(from.parameters.begin(), from.parameters.begin() + own);
  if (on_limit(from.effects)) start.push_back(from.parameters.back());
  return start;
}

// Stopping rule of a fit: loose where a search is repeated for every fold, tight where the result
// is delivered.
FitEnd end_of_fit(const Campaign& campaign, NoiseSearch search) {
  const bool chooses = campaign.quick || search == NoiseSearch::kept;
  // With many tests the cost is so large that a millionth of it is far less than a unit of log
  // likelihood, by which rivals are chosen.
  if (campaign.selection)
    return chooses
               ? FitEnd{campaign.quick ? tuning::coarse_fit_end : tuning::fit_end_with_many_tests,
                        tuning::most_steps_from_selected}
               : FitEnd{tuning::fit_end_of_choice};
  if (campaign.quick || campaign.of_selected) return {tuning::coarse_fit_end};
  return search == NoiseSearch::kept ? FitEnd{tuning::fit_end_of_choice} : FitEnd{};
}

// Fits to the blocks of this campaign. `from_selection`: the start is the end of a fit to selected
// tests, under its noise.
Rival fit_on_blocks(const Campaign& campaign, std::vector<PlacedEffect> effects,
                    std::vector<Cause> causes, std::span<const double> parameters,
                    const stats::NoiseModel& noise, NoiseSearch search,
                    bool from_selection = false) {
  const std::size_t own = campaign.law.parameters.size();
  Rival rival;
  rival.own = own;
  rival.parameters.assign(parameters.begin(), parameters.end());
  rival.effects = std::move(effects);
  rival.causes = std::move(causes);
  rival.noise = noise;
  const models::Law extended = bounded_law(campaign, rival);
  rival.parameters = start_of(extended, parameters, own, rival.effects);
  const BlockColumns& columns = campaign.candidates.by_symbol;
  const LawOnBlocks law(extended, campaign.conventions, columns);
  const Penalty penalty = penalties(campaign, rival);
  const FitEnd end = end_of_fit(campaign, search);
  const auto refit = [&](const LawOnBlocks& with) {
    rival.predicted = with.predict(rival.parameters);
    const stats::Whitener whitener(rival.noise, rival.predicted, campaign.blocks,
                                   campaign.nuisance);
    static_cast<BlockFit&>(rival) =
        fit_blocks(with, campaign.measured, whitener, rival.parameters, penalty, end);
  };
  // First with the limit rounded off, otherwise rows below it have no influence on it.
  if (!from_selection && on_limit(rival.effects)) {
    const double usual = campaign.measured.cwiseAbs().mean();
    for (const double width : tuning::rounding_widths_of_limit)
      refit(LawOnBlocks(extended, campaign.conventions, columns, width * usual));
  }
  refit(law);
  for (const bool first : {true, false}) {
    if (search != NoiseSearch::again || from_selection) break;
    const VectorXd residual = campaign.measured - rival.predicted;
    const stats::NoiseData data{residual, rival.predicted, campaign.blocks, rival.jacobian,
                                campaign.nuisance};
    if (first)
      rival.noise = campaign_noise(campaign, data, &rival.noise);
    else if (!campaign.quick)
      rival.noise = stats::refine_noise(data, rival.noise).noise;
    else
      break;
    refit(law);
  }
  take_parameters(rival);
  rival.weights = rival.noise;
  evaluate(rival, campaign);
  return rival;
}

} // namespace

MatrixXd penalty_of(const Rival& rival) {
  MatrixXd all;
  const Index count = rival.parameters.size();
  for (std::size_t i = 0; i < rival.effects.size(); ++i) {
    const PlacedEffect& effect = rival.effects[i];
    if (!effect.form->penalty || !(effect.stiffness > 0)) continue;
    if (all.size() == 0) all = MatrixXd::Zero(count, count);
    const MatrixXd one = roughness_of(effect);
    const Index first = first_parameter(rival, i);
    all.block(first, first, one.rows(), one.cols()) = effect.stiffness * one;
  }
  return all;
}

void tie_parameters(Campaign& campaign, const Rival& base, double share) {
  const stats::Whitener whitener(base.noise, base.predicted, campaign.blocks);
  MatrixXd jacobian = base.jacobian;
  whitener.apply(jacobian);
  campaign.own = {share * jacobian.transpose() * jacobian,
                  Eigen::Map<const VectorXd>(base.parameters.data(), base.parameters.size())};
}

std::vector<double> start_of(const models::Law& extended, std::span<const double> own,
                             std::size_t count, std::span<const PlacedEffect> effects) {
  std::vector<double> start(own.begin(), own.begin() + count);
  for (const PlacedEffect& effect : effects)
    for (const double value : effects::fitted_values(effect))
      start.push_back(value);
  while (start.size() < extended.parameters.size()) // m_limit
    start.push_back(own.size() > count ? own.back() : extended.parameters[start.size()].start);
  return start;
}

models::Law bounded_law(const Campaign& campaign, const Rival& rival) {
  const std::size_t own = campaign.law.parameters.size();
  models::Law law = effects::extended_law(campaign.law, campaign.conventions,
                                          std::span(rival.parameters).first(own), rival.effects,
                                          campaign.law.name);
  bound_shapes(law, own, rival.effects, campaign.candidates);
  return law;
}

Rival fit_rival(const Campaign& campaign, std::vector<PlacedEffect> effects,
                std::vector<Cause> causes, std::span<const double> parameters,
                const stats::NoiseModel& noise, NoiseSearch search) {
  if (!campaign.selection)
    return fit_on_blocks(campaign, std::move(effects), std::move(causes), parameters, noise,
                         search);
  const Rival part = fit_on_blocks(selected(campaign), std::move(effects), std::move(causes),
                                   parameters, noise, search);
  return fit_on_blocks(campaign, part.effects, part.causes, own_parameters(campaign, part),
                       part.noise, search, true);
}

Rival fit_rival(const Campaign& campaign, const Rival& from, std::vector<PlacedEffect> effects,
                std::vector<Cause> causes, const stats::NoiseModel& noise, NoiseSearch search) {
  return fit_rival(campaign, std::move(effects), std::move(causes), own_parameters(campaign, from),
                   noise, search);
}

Rival with_effect(const Campaign& campaign, const Rival& from, PlacedEffect effect,
                  const Cause& cause, const stats::NoiseModel& noise, NoiseSearch search) {
  std::vector<PlacedEffect> effects = from.effects;
  std::vector<Cause> causes = from.causes;
  effects.push_back(std::move(effect));
  causes.push_back(cause);
  return fit_rival(campaign, from, std::move(effects), std::move(causes), noise, search);
}

stats::NoiseModel campaign_noise(const Campaign& campaign, const stats::NoiseData& data,
                                 const stats::NoiseModel* earlier) {
  const auto fit = [&](const stats::NoiseData& part) {
    if (!earlier) return stats::fit_noise(part).noise;
    return (campaign.quick ? stats::refit_noise_coarsely(part, *earlier)
                           : stats::refit_noise(part, *earlier))
        .noise;
  };
  if (!campaign.selection) return fit(data);
  const auto& rows = campaign.selection->rows;
  const auto some = [&](const MatrixXd& all) {
    return all.cols() == 0 ? MatrixXd{} : MatrixXd(all(rows, Eigen::all));
  };
  const VectorXd residual = data.residual(rows), tau = data.tau(rows);
  const MatrixXd fitted = some(data.fitted), nuisance = some(data.nuisance);
  return fit({residual, tau, campaign.selection->blocks, fitted, nuisance});
}

Campaign selected(const Campaign& campaign) {
  if (!campaign.selection) return campaign;
  const Selection& some = *campaign.selection;
  Campaign part{campaign.law,    campaign.conventions,         some.blocks,
                some.candidates, campaign.measured(some.rows), {},
                campaign.quick};
  part.own = campaign.own;
  part.of_selected = true;
  if (campaign.nuisance.cols() > 0) part.nuisance = campaign.nuisance(some.rows, Eigen::all);
  return part;
}

stats::NoiseModel rows_alike(const stats::NoiseModel& noise) {
  stats::NoiseModel alike;
  alike.scale = noise.scale;
  alike.growth = 0;
  alike.slow = 0;
  alike.white = std::hypot(noise.slow, noise.white, noise.gain);
  return alike;
}

Rival with_weights(const Campaign& campaign, Rival rival, const stats::NoiseModel& weights) {
  const FitEnd end = campaign.selection ? end_of_fit(campaign, NoiseSearch::again) : FitEnd{};
  const LawOnBlocks law(bounded_law(campaign, rival), campaign.conventions,
                        campaign.candidates.by_symbol);
  const stats::Whitener whitener(weights, rival.predicted, campaign.blocks, campaign.nuisance);
  static_cast<BlockFit&>(rival) = fit_blocks(law, campaign.measured, whitener, rival.parameters,
                                             penalties(campaign, rival), end);
  rival.weights = weights;
  take_parameters(rival);
  evaluate(rival, campaign);
  return rival;
}

std::size_t first_parameter(const Rival& rival, std::size_t effect) {
  std::size_t first = rival.own;
  for (std::size_t i = 0; i < effect; ++i)
    first += effects::fitted_parameters(rival.effects[i]).size();
  return first;
}

std::size_t site_of(const PlacedEffect& effect) {
  return std::ranges::find(sites, effect.acts_on) - sites.begin();
}

Rival less_effect(Rival rival, std::size_t index) {
  const bool limit = rival.parameters.size() > first_parameter(rival, rival.effects.size());
  const auto first = rival.parameters.begin() + first_parameter(rival, index);
  rival.parameters.erase(first, first + effects::fitted_parameters(rival.effects[index]).size());
  rival.effects.erase(rival.effects.begin() + index);
  rival.causes.erase(rival.causes.begin() + index);
  if (limit && !on_limit(rival.effects)) rival.parameters.pop_back(); // m_limit, after them
  return rival;
}

Rival without_effect(const Campaign& campaign, const Rival& rival, std::size_t index) {
  Rival less = less_effect(rival, index);
  return fit_rival(campaign, rival, std::move(less.effects), std::move(less.causes), rival.noise,
                   NoiseSearch::again);
}

std::vector<bool> indistinguishable_rivals(const std::vector<Rival>& rivals, std::uint64_t seed) {
  const Index experiments = rivals.front().log_likelihood.size();
  MatrixXd times(tuning::rival_resamples, experiments);
  std::vector<double> counts(experiments);
  for (Index b = 0; b < times.rows(); ++b) {
    stats::resample(seed, b, counts);
    times.row(b) = Eigen::Map<const VectorXd>(counts.data(), experiments);
  }
  std::vector<bool> same;
  for (const Rival& rival : rivals) {
    const VectorXd difference = rivals.front().log_likelihood - rival.log_likelihood;
    const VectorXd drawn = times * difference;
    const auto better = static_cast<double>((drawn.array() > 0).count());
    const double lead = 0.5 * (rival.criterion - rivals.front().criterion);
    same.push_back(better <
                       tuning::confidence_of_bound * static_cast<double>(tuning::rival_resamples) ||
                   lead < tuning::clear_lead_of_criterion);
  }
  return same;
}

} // namespace frictab::trace
