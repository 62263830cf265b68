// Shortlist, penalised smooths under one noise model, then closed forms.
#include "trace/search/choose_effect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/parallel.h"
#include "core/progress.h"
#include "stats/projection.h"
#include "stats/smooth.h"
#include "trace/columns/shapes.h"
#include "trace/tuning.h"

namespace frictab::trace {

using effects::PlacedEffect;

namespace {

static_assert(tuning::site_costs.size() == sites.size());

// One way to explain the residual, linear in its coefficients.
struct Option {
  Cause cause;
  PlacedEffect effect;
  MatrixXd penalty;
  stats::SmoothFit fit;
  double criterion = 0;
};

using Options = std::vector<Option>;

// Derivatives of tau_R by the amplitudes, per block, not whitened. (Computed when needed: for all
// options together they would exhaust memory.)
MatrixXd basis_of(const Search& search, const PlacedEffect& effect) {
  return search.sensitivities()[site_of(effect)].asDiagonal() *
         amplitude_basis(effect, search.candidates().by_symbol);
}

double clamped_start(double amplitude) {
  return std::clamp(amplitude, -tuning::largest_start_amplitude, tuning::largest_start_amplitude);
}

void start_at(const stats::SmoothFit& fit, PlacedEffect& effect) {
  effect.stiffness = fit.stiffness;
  effects::set_fitted(effect,
                      {fit.coefficients.data(), fit.coefficients.data() + fit.coefficients.size()});
}

Option option_of(const Cause& cause, PlacedEffect effect) {
  const Index count = effects::amplitudes_of(effect);
  const MatrixXd penalty =
      effect.form->penalty ? roughness_of(effect)
                           : tuning::penalty_of_plain_amplitudes * MatrixXd::Identity(count, count);
  return {cause, std::move(effect), penalty, {}, 0};
}

// Fits all options under the same noise model, so that they are comparable.
void fit_options(const Search& search, const stats::NoiseModel& noise, Options& options) {
  const Campaign& campaign = search.campaign();
  const stats::Whitener whitener(noise, search.last().predicted, campaign.blocks,
                                 campaign.nuisance);
  MatrixXd known = search.last().jacobian;
  stats::append_columns(known, search.trained());
  whitener.apply(known);
  known = stats::orthonormal(known);
  MatrixXd residual = search.residual();
  whitener.apply(residual);
  parallel_for(options.size(), [&](std::size_t i) {
    Option& option = options[i];
    MatrixXd basis = basis_of(search, option.effect);
    whitener.apply(basis);
    option.fit = stats::fit_smooth(residual.col(0), basis, option.penalty, known);
    option.criterion = option.fit.criterion +
                       tuning::cause_step_cost * complexity(option.cause, search.candidates());
  });
}

Rival rival_of(const Search& search, const Campaign& campaign, const Option& option,
               const stats::NoiseModel& noise) {
  PlacedEffect effect = option.effect;
  if (effect.form->penalty)
    start_at(option.fit, effect);
  else if (effects::amplitudes_of(effect) == 1 && effect.form->texts == 0)
    effect.parameters[0] = clamped_start(option.fit.coefficients(0));
  return with_effect(campaign, search.last(), std::move(effect), option.cause, noise,
                     NoiseSearch::kept);
}

std::vector<Rival> rivals_of(const Search& search, const Campaign& campaign, const Options& options,
                             const stats::NoiseModel& noise) {
  std::vector<Rival> rivals(options.size());
  const Progress progress("fitting causes", options.size());
  parallel_for(options.size(), [&](std::size_t i) {
    rivals[i] = rival_of(search, campaign, options[i], noise);
    progress.tick();
  });
  return rivals;
}

// Difference of log likelihood in standard errors over tests (Vuong 1989).
double sureness(const Rival& first, const Rival& other) {
  const VectorXd difference = first.log_likelihood - other.log_likelihood;
  const auto n = static_cast<double>(difference.size());
  const double scatter = (difference.array() - difference.mean()).matrix().norm();
  return difference.sum() / std::max(scatter * std::sqrt(n / (n - 1)), tuning::smallest_divisor);
}

// Keeps the first option and those that the selected tests cannot distinguish from it. An option
// that a few hundred tests separate this clearly, all tests separate even more clearly, so it
// cannot be in a set.
void drop_distinguishable(const Search& search, const stats::NoiseModel& noise, Options& options) {
  if (options.size() < 2) return;
  const std::vector<Rival> fits = rivals_of(search, selected(search.campaign()), options, noise);
  Options kept;
  for (std::size_t i = 0; i < options.size(); ++i)
    if (i == 0 || !(sureness(fits.front(), fits[i]) > tuning::distinguishable_std_errors))
      kept.push_back(std::move(options[i]));
  options = std::move(kept);
}

// Name of the form that follows any curve of the cause; text has no curves.
const char* smooth_form(const Cause& cause, const Candidates& candidates) {
  const std::size_t texts = candidates.texts_of(cause);
  if (texts == cause.columns.size()) return plain_form(cause, candidates);
  if (cause.is_joint()) return texts > 0 ? "spline_by_level" : "surface";
  return candidates.first_of(cause).two_values ? plain_form(cause, candidates) : "spline";
}

// Residual of the law without the effect `index`, everything else as fitted: the signal that any
// other form of that effect has to explain.
VectorXd to_explain(const Search& search, const Rival& winner, std::size_t index) {
  const PlacedEffect& effect = winner.effects[index];
  const VectorXd& sensitivity = search.sensitivities()[site_of(effect)];
  const VectorXd change =
      factor_on(effect, search.candidates().by_symbol).array() - 1; // at its site
  return search.campaign().measured - winner.predicted + sensitivity.cwiseProduct(change);
}

// Start values of a form at a site, and the signal that its best grid shape explains (larger is
// better).
struct Start {
  PlacedEffect effect;
  double explained;
};

class FormStarts {
public:
  FormStarts(const Search& search, const Rival& winner, std::size_t index)
      : s_(search), cause_(winner.causes[index]),
        whitener_(winner.noise, winner.predicted, search.blocks(), search.campaign().nuisance) {
    MatrixXd known = search.base().jacobian;
    stats::append_columns(known, search.trained());
    for (std::size_t i = 0; i < winner.effects.size(); ++i) {
      // Empty if, with the effects found since, its site no longer changes tau_R anywhere.
      const VectorXd& sensitivity = search.sensitivities()[site_of(winner.effects[i])];
      if (i != index && sensitivity.size() > 0)
        stats::append_columns(known, basis_of(search, winner.effects[i]));
    }
    whitener_.apply(known);
    known_ = stats::orthonormal(known);
    MatrixXd target = to_explain(search, winner, index);
    whitener_.apply(target);
    target_ = target.col(0) - known_ * (known_.transpose() * target.col(0));
  }

  std::vector<Start> run() const {
    std::vector<Start> starts;
    const auto shapes = shapes_of(cause_, s_.candidates());
    for (std::size_t p = 0; p < sites.size(); ++p) {
      if (s_.sensitivities()[p].size() == 0) continue;
      add_closed(shapes, p, starts);
      add_smooth(p, starts);
    }
    std::ranges::stable_sort(starts, std::greater{}, &Start::explained);
    return starts;
  }

private:
  void add_closed(const std::vector<GridShape>& shapes, std::size_t site,
                  std::vector<Start>& starts) const {
    std::map<const effects::EffectForm*, Start> best;
    MatrixXd basis(target_.size(), shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i)
      basis.col(i) = shapes[i].direction.cast<double>().cwiseProduct(s_.sensitivities()[site]);
    whitener_.apply(basis);
    basis -= known_ * (known_.transpose() * basis).eval();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const auto column = basis.col(i);
      const double size = column.squaredNorm(), along = column.dot(target_);
      if (!(size > 0)) continue;
      Start start{shapes[i].effect, along * along / size};
      start.effect.acts_on = sites[site];
      start.effect.tau_scale_MPa = s_.tau_scale_MPa();
      if (start.effect.form->texts == 0) start.effect.parameters[0] = clamped_start(along / size);
      const auto [at, is_new] = best.try_emplace(start.effect.form, start);
      if (!is_new && start.explained > at->second.explained) at->second = start;
    }
    for (auto& [form, start] : best)
      starts.push_back(std::move(start));
  }

  // Adds the smooth with the stiffness that the residual requires.
  void add_smooth(std::size_t site, std::vector<Start>& starts) const {
    Option option = option_of(cause_, smooth_effect(s_, cause_, sites[site]));
    if (!option.effect.form->penalty) return; // a text column has one form
    MatrixXd basis = basis_of(s_, option.effect);
    whitener_.apply(basis);
    const stats::SmoothFit fit = stats::fit_smooth(target_, basis, option.penalty, known_);
    Start start{std::move(option.effect), fit.without - fit.criterion};
    start_at(fit, start.effect);
    starts.push_back(std::move(start));
  }

  const Search& s_;
  const Cause& cause_;
  stats::Whitener whitener_;
  MatrixXd known_;
  VectorXd target_;
};

std::vector<Rival> fit_forms(const Campaign& campaign, const Rival& winner, std::size_t index,
                             const std::vector<Start>& starts) {
  std::vector<Rival> rivals(starts.size());
  const Progress progress("fitting forms", starts.size());
  parallel_for(starts.size(), [&](std::size_t i) {
    std::vector<PlacedEffect> effects = winner.effects;
    effects[index] = starts[i].effect;
    rivals[i] = fit_rival(campaign, winner, std::move(effects), winner.causes, winner.noise,
                          NoiseSearch::kept);
    if (starts[i].effect.form->penalty) rivals[i].penalised -= tuning::smooth_cost;
    rivals[i].penalised -= tuning::site_costs[site_of(starts[i].effect)];
    progress.tick();
  });
  return rivals;
}

// Keeps the starts whose fits to the selected tests promise most on all tests, and continues from
// those fits. The log likelihood grows with the number of tests, the costs of parameters do not.
void keep_promising(double share, std::size_t index, std::vector<Start>& starts,
                    const std::vector<Rival>& fits) {
  std::vector<std::size_t> order(starts.size());
  std::iota(order.begin(), order.end(), 0);
  const auto promise = [&](std::size_t i) {
    return fits[i].penalised + (1 / share - 1) * fits[i].total;
  };
  std::ranges::stable_sort(order, std::greater{}, promise);
  if (order.size() > tuning::most_forms_on_all_tests) order.resize(tuning::most_forms_on_all_tests);
  std::vector<Start> kept;
  for (const std::size_t i : order) {
    kept.push_back(starts[i]);
    kept.back().effect = fits[i].effects[index];
  }
  starts = std::move(kept);
}

// Puts the best factor first unless an addition to tau_R is not only likelier but errs less too:
// the likelihood counts relative deviations, and two tests at a low pressure that a drift has
// raised can decide it. Measured: otherwise a factor of 1.22 became "+11 to +23 MPa" in 6 of 9
// campaigns of a drifting rig, and in a seventh a pressure without an effect got "+43 MPa".
void prefer_factor(const Search& search, std::size_t index, std::vector<Rival>& rivals) {
  const auto is_added = [&](const Rival& rival) {
    return rival.effects[index].acts_on == effects::ActsOn::tau;
  };
  const auto error_MPa = [&](const Rival& rival) {
    return (search.campaign().measured - rival.predicted).cwiseAbs().mean();
  };
  const auto factor = std::ranges::find_if_not(rivals, is_added);
  if (factor != rivals.end() && error_MPa(*factor) <= error_MPa(rivals.front()))
    std::rotate(rivals.begin(), factor, factor + 1);
}

} // namespace

PlacedEffect plain_effect(const Search& search, const Cause& cause) {
  return start_effect(*effects::find_effect(plain_form(cause, search.candidates())), cause,
                      search.candidates(), sites[searched_site(search.sensitivities())],
                      search.tau_scale_MPa());
}

PlacedEffect smooth_effect(const Search& search, const Cause& cause, effects::ActsOn acts_on) {
  const Candidates& candidates = search.candidates();
  return start_effect(*effects::find_effect(smooth_form(cause, candidates)), cause, candidates,
                      acts_on, search.tau_scale_MPa());
}

std::vector<Rival> choose_cause(const Search& search, const std::vector<Suspect>& suspects) {
  Options options;
  for (const Suspect& suspect : suspects)
    options.push_back(option_of(suspect.cause, suspect.effect));
  // Fits one noise model for all options, with the first one's effect included; otherwise that
  // effect would count as noise.
  const Cause& first = suspects.front().cause;
  const stats::NoiseModel noise =
      with_effect(search.campaign(), search.last(), plain_effect(search, first), first,
                  search.last().noise, NoiseSearch::again)
          .noise;
  fit_options(search, noise, options);
  std::ranges::stable_sort(options, {}, &Option::criterion);
  Options best; // best option of each cause
  for (Option& option : options)
    if (!contains(best, option.cause, &Option::cause) && best.size() < tuning::shortlisted_causes)
      best.push_back(std::move(option));
  if (search.campaign().selection) drop_distinguishable(search, noise, best);
  std::vector<Rival> rivals = rivals_of(search, search.campaign(), best, noise);
  for (std::size_t i = 0; i < best.size(); ++i)
    rivals[i].criterion = best[i].criterion;
  return rivals;
}

std::vector<Rival> choose_form(const Search& search, const Rival& winner, std::size_t index) {
  if (search.sensitivities()[site_of(winner.effects[index])].size() == 0)
    return {winner}; // with the other effects in the law, its site no longer has an influence
  std::vector<Start> starts = FormStarts(search, winner, index).run();
  std::map<effects::ActsOn, std::size_t> tried;
  std::erase_if(starts, [&](const Start& start) {
    return !start.effect.form->penalty &&
           tried[start.effect.acts_on]++ >= tuning::most_forms_at_site;
  });
  std::vector<Rival> rivals = fit_forms(selected(search.campaign()), winner, index, starts);
  if (search.campaign().selection) {
    keep_promising(search.campaign().selection->share, index, starts, rivals);
    rivals = fit_forms(search.campaign(), winner, index, starts);
  }
  rivals.push_back(winner);
  rivals.back().penalised -= tuning::site_costs[site_of(winner.effects[index])];
  if (winner.effects[index].form->penalty) rivals.back().penalised -= tuning::smooth_cost;
  std::ranges::stable_sort(rivals, std::greater{}, &Rival::penalised);
  prefer_factor(search, index, rivals);
  return rivals;
}

} // namespace frictab::trace
