// Joint fits of law, effects and noise; short lists; comparison by experiment.
#include "trace/rivals.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/resampling.h"
#include "core/parallel.h"
#include "trace/plausibility.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double per_parameter = 2.5;  // of log likelihood, that a parameter has to earn
constexpr double per_complexity = 1.5; // and a step away from a recorded column
constexpr std::size_t short_list = 12;
constexpr double close_rivals =
    60; // of log likelihood behind the best, that may still be caught up

void take_parameters(Rival& rival, std::size_t own) {
  std::size_t next = own;
  for (PlacedEffect& effect : rival.effects) {
    const std::size_t count = fitted_parameters(effect).size();
    set_fitted(effect, std::span(rival.parameters).subspan(next, count));
    next += count;
  }
}

VectorXd by_experiment(const VectorXd& whitened, const Whitener& whitener,
                       std::span<const std::size_t> first) {
  VectorXd value(static_cast<Index>(first.size() - 1));
  for (Index e = 0; e < value.size(); ++e) {
    const auto begin = static_cast<Index>(first[static_cast<std::size_t>(e)]);
    const auto end = static_cast<Index>(first[static_cast<std::size_t>(e) + 1]);
    value(e) = -0.5 * (whitened.segment(begin, end - begin).squaredNorm() + whitener.log_det()(e));
  }
  return value;
}

bool on_limit(const std::vector<PlacedEffect>& effects) {
  return std::any_of(effects.begin(), effects.end(),
                     [](const PlacedEffect& e) { return e.acts_on == "m"; });
}

void judge(Rival& rival, const Campaign& campaign) {
  const Whitener whitener(rival.noise, rival.predicted, campaign.blocks.first, campaign.nuisance);
  MatrixXd residual = campaign.measured - rival.predicted;
  whitener.apply(residual);
  rival.log_likelihood = by_experiment(residual.col(0), whitener, campaign.blocks.first);
  rival.total = rival.log_likelihood.sum();
  double cost = per_parameter * static_cast<double>(rival.parameters.size());
  for (const Cause& cause : rival.causes)
    cost += per_complexity * complexity(cause, campaign.candidates);
  for (std::size_t i = 0; i < rival.effects.size(); ++i)
    cost += implausibility(rival.effects[i], campaign.candidates.columns[rival.causes[i].column]);
  rival.penalised = rival.total - cost;
}

} // namespace

std::vector<double> start_of(const Law& extended, std::span<const double> own, std::size_t count,
                             std::span<const PlacedEffect> effects) {
  std::vector<double> start(own.begin(), own.begin() + static_cast<long>(count));
  for (const PlacedEffect& effect : effects)
    for (const double value : fitted_values(effect))
      start.push_back(value);
  while (start.size() < extended.parameters.size()) // m_limit
    start.push_back(own.size() > count ? own.back() : extended.parameters[start.size()].start);
  return start;
}

Law bounded_law(const Campaign& campaign, const Rival& rival) {
  const std::size_t own = campaign.law.parameters.size();
  Law law = extended_law(campaign.law, campaign.conventions, std::span(rival.parameters).first(own),
                         rival.effects, campaign.law.name);
  bound_shapes(law, own, rival.effects, campaign.candidates);
  return law;
}

Rival fit_rival(const Campaign& campaign, std::vector<PlacedEffect> effects,
                std::vector<Cause> causes, std::span<const double> parameters,
                const NoiseModel& noise, NoiseSearch search) {
  const std::size_t own = campaign.law.parameters.size();
  Rival rival;
  rival.parameters.assign(parameters.begin(), parameters.end());
  rival.effects = std::move(effects);
  rival.causes = std::move(causes);
  rival.noise = noise;
  const Law extended = bounded_law(campaign, rival);
  rival.parameters = start_of(extended, parameters, own, rival.effects);
  const BlockColumns& columns = campaign.candidates.by_symbol;
  const LawOnBlocks law(extended, campaign.conventions, columns);
  const auto refit = [&](const LawOnBlocks& with) {
    rival.predicted = with.predict(rival.parameters);
    const Whitener whitener(rival.noise, rival.predicted, campaign.blocks.first, campaign.nuisance);
    BlockFit fit = fit_blocks(with, campaign.measured, whitener, rival.parameters);
    rival.parameters = std::move(fit.parameters);
    rival.predicted = std::move(fit.predicted);
    rival.jacobian = std::move(fit.jacobian);
  };
  if (on_limit(rival.effects)) // a limit that no row has reached yet would never be seen
    for (const double width : {15.0, 5.0})
      refit(LawOnBlocks(extended, campaign.conventions, columns, width));
  refit(law);
  const VectorXd residual = campaign.measured - rival.predicted;
  const auto& first = campaign.blocks.first;
  rival.noise =
      search == NoiseSearch::near
          ? fit_noise(residual, rival.predicted, first, {}, noise, 80, campaign.nuisance).noise
          : fit_noise_anew(residual, rival.predicted, first, noise,
                           search == NoiseSearch::quick ? 40 : 300, campaign.nuisance)
                .noise;
  refit(law);
  take_parameters(rival, own);
  rival.weights = rival.noise;
  judge(rival, campaign);
  return rival;
}

NoiseModel rows_alike(const NoiseModel& noise) {
  NoiseModel alike;
  alike.scale = noise.scale;
  alike.slow = 0;
  alike.rho = 0;
  alike.white = std::hypot(noise.slow, noise.white);
  return alike;
}

Rival with_weights(const Campaign& campaign, Rival rival, const NoiseModel& weights) {
  const LawOnBlocks law(bounded_law(campaign, rival), campaign.conventions,
                        campaign.candidates.by_symbol);
  const Whitener whitener(weights, rival.predicted, campaign.blocks.first, campaign.nuisance);
  BlockFit fit = fit_blocks(law, campaign.measured, whitener, rival.parameters);
  rival.parameters = std::move(fit.parameters);
  rival.predicted = std::move(fit.predicted);
  rival.jacobian = std::move(fit.jacobian);
  rival.weights = weights;
  take_parameters(rival, campaign.law.parameters.size());
  judge(rival, campaign);
  return rival;
}

std::size_t place_of(const PlacedEffect& effect) {
  return static_cast<std::size_t>(std::find(places.begin(), places.end(), effect.acts_on) -
                                  places.begin());
}

Rival without_effect(const Campaign& campaign, const Rival& rival, std::size_t index) {
  std::vector<PlacedEffect> effects = rival.effects;
  std::vector<Cause> causes = rival.causes;
  effects.erase(effects.begin() + static_cast<long>(index));
  causes.erase(causes.begin() + static_cast<long>(index));
  return fit_rival(campaign, std::move(effects), std::move(causes),
                   std::span(rival.parameters).first(campaign.law.parameters.size()), rival.noise,
                   NoiseSearch::thorough);
}

namespace {

struct Trial {
  PlacedEffect effect;
  Cause cause;
};

// A shape of the grid, with the amplitude that the screening suggests.
Trial trial_of(const Direction& direction, const std::vector<Cause>& causes,
               const std::vector<std::vector<GridShape>>& shapes, double tau_scale_MPa) {
  Trial trial{shapes[direction.cause][direction.shape].effect, causes[direction.cause]};
  trial.effect.acts_on = places[direction.place];
  trial.effect.tau_scale_MPa = tau_scale_MPa;
  if (!trial.effect.form->categorical)
    trial.effect.parameters[0] =
        std::clamp(static_cast<double>(direction.statistic / direction.size), -0.5, 0.5);
  return trial;
}

void sort_best_first(std::vector<Rival>& rivals) {
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.penalised > b.penalised; });
}

std::vector<Rival> fit_all(const Campaign& campaign, const Rival& current, const NoiseModel& noise,
                           const std::vector<Trial>& trials, NoiseSearch search) {
  std::vector<Rival> rivals(trials.size());
  parallel_for(trials.size(), [&](std::size_t i) {
    std::vector<PlacedEffect> effects = current.effects;
    std::vector<Cause> causes = current.causes;
    effects.push_back(trials[i].effect);
    causes.push_back(trials[i].cause);
    std::vector<double> own(current.parameters.begin(),
                            current.parameters.begin() +
                                static_cast<long>(campaign.law.parameters.size()));
    if (on_limit(current.effects)) own.push_back(current.parameters.back());
    rivals[i] = fit_rival(campaign, effects, causes, own, noise, search);
  });
  sort_best_first(rivals);
  return rivals;
}

// Those that are near the best once more, from its noise, so that they are compared under noise
// that is fitted alike, the best as well. (Searches from far away stop at different distances from
// their ends.)
void compare_closely(const Campaign& campaign, std::vector<Rival>& rivals) {
  const auto again = [&](const Rival& r, const NoiseModel& noise, NoiseSearch search) {
    return fit_rival(campaign, r.effects, r.causes, r.parameters, noise, search);
  };
  rivals.front() = again(rivals.front(), rivals.front().noise, NoiseSearch::thorough);
  const NoiseModel noise = rivals.front().noise;
  const double least = rivals.front().penalised - close_rivals;
  parallel_for(rivals.size(), [&](std::size_t i) {
    if (rivals[i].penalised > least || i < 4)
      rivals[i] = again(rivals[i], noise, NoiseSearch::near);
  });
  sort_best_first(rivals);
}

// Per cause its directions, largest statistic first; causes by their best.
std::vector<std::vector<Direction>> by_cause(const ScreenResult& screened, std::size_t count) {
  std::vector<std::vector<Direction>> lists(count);
  for (const Direction& direction : screened.directions)
    lists[direction.cause].push_back(direction);
  const auto larger = [](const Direction& a, const Direction& b) {
    return std::abs(a.statistic) > std::abs(b.statistic);
  };
  for (auto& list : lists)
    std::stable_sort(list.begin(), list.end(), larger);
  std::erase_if(lists, [](const auto& list) { return list.empty(); });
  std::stable_sort(lists.begin(), lists.end(),
                   [&](const auto& a, const auto& b) { return larger(a.front(), b.front()); });
  return lists;
}

// The best shapes of a cause: two whatever their place, and the best of every other place.
std::vector<Direction> best_shapes(const std::vector<Direction>& list,
                                   const std::vector<std::vector<GridShape>>& shapes) {
  std::vector<Direction> best;
  std::set<std::pair<std::string, std::size_t>> kinds;
  std::set<std::size_t> seen;
  for (const Direction& direction : list) {
    const std::string& form = shapes[direction.cause][direction.shape].effect.form->name;
    const bool new_place = !seen.count(direction.place);
    if ((kinds.size() >= 2 && !new_place) || !kinds.insert({form, direction.place}).second)
      continue;
    seen.insert(direction.place);
    best.push_back(direction);
  }
  return best;
}

} // namespace

std::vector<Rival> find_rivals(const Campaign& campaign, const Rival& current,
                               const std::vector<Cause>& causes,
                               const std::vector<std::vector<GridShape>>& shapes,
                               const ScreenResult& screened, double tau_scale_MPa) {
  auto lists = by_cause(screened, causes.size());
  const float least = 0.6f * std::abs(lists.front().front().statistic);
  std::vector<Trial> trials;
  std::size_t taken = 0;
  for (const auto& list : lists) {
    if (taken++ >= short_list || std::abs(list.front().statistic) < least) break;
    for (const Direction& direction : best_shapes(list, shapes))
      trials.push_back(trial_of(direction, causes, shapes, tau_scale_MPa));
  }
  std::vector<Rival> rivals = fit_all(campaign, current, current.noise, trials, NoiseSearch::quick);
  compare_closely(campaign, rivals);
  return rivals;
}

std::vector<Rival> find_forms(const Campaign& campaign, const Rival& current, const Rival& winner,
                              const std::vector<Cause>& causes,
                              const std::vector<std::vector<GridShape>>& shapes,
                              const ScreenResult& screened) {
  const Cause cause = winner.causes.back();
  const PlacedEffect& won = winner.effects.back();
  if (won.form->categorical || cause.pair()) return {winner};
  const auto index =
      static_cast<std::size_t>(std::find(causes.begin(), causes.end(), cause) - causes.begin());
  std::vector<Trial> trials;
  for (const EffectForm& form : all_effects()) {
    if (!form_fits(form, cause, campaign.candidates)) continue;
    Trial trial{start_effect(form, cause, campaign.candidates, won.acts_on, won.tau_scale_MPa),
                cause};
    const Direction* best = nullptr;
    for (const Direction& d : screened.directions)
      if (d.cause == index && places[d.place] == won.acts_on &&
          shapes[index][d.shape].effect.form == &form &&
          (!best || std::abs(d.statistic) > std::abs(best->statistic)))
        best = &d;
    if (best) trial = trial_of(*best, causes, shapes, won.tau_scale_MPa);
    trials.push_back(std::move(trial));
  }
  std::vector<Rival> rivals = fit_all(campaign, current, winner.noise, trials, NoiseSearch::near);
  rivals.push_back(winner); // whose grid start may have been the better one
  const double spline_margin = 1.3 * per_parameter;
  for (Rival& rival : rivals)
    if (amplitudes_of(rival.effects.back()) > 1)
      rival.penalised -=
          0.3 * per_parameter * static_cast<double>(amplitudes_of(rival.effects.back())) +
          spline_margin;
  sort_best_first(rivals);
  return rivals;
}

std::vector<bool> not_told_apart(const std::vector<Rival>& rivals, std::uint64_t seed) {
  constexpr std::size_t resamples = 500;
  const Index experiments = rivals.front().log_likelihood.size();
  MatrixXd times(static_cast<Index>(resamples), experiments);
  std::vector<double> counts(static_cast<std::size_t>(experiments));
  for (Index b = 0; b < times.rows(); ++b) {
    resample(seed, static_cast<std::size_t>(b), counts);
    times.row(b) = Eigen::Map<const VectorXd>(counts.data(), experiments);
  }
  std::vector<bool> same;
  for (const Rival& rival : rivals) {
    const VectorXd difference = rivals.front().log_likelihood - rival.log_likelihood;
    const VectorXd drawn = times * difference;
    const auto better = static_cast<double>((drawn.array() > 0).count());
    const double lead = rivals.front().penalised - rival.penalised;
    same.push_back(better < 0.95 * static_cast<double>(resamples) || lead < 2);
  }
  return same;
}

} // namespace frictab
