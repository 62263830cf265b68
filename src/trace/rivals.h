// A law with some effects in it, fitted to the blocks of a campaign under a noise model.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trace/candidates.h"
#include "trace/law_on_blocks.h"
#include "trace/noise_fit.h"
#include "trace/selection.h"

namespace frictab::trace {

// The sites of a law: the parts of it that an effect may change (PlacedEffect::acts_on), and whose
// index in this list stands for them. mu and the limit together are a site only where a law has a
// limit of its own: what lubricates worse does so before and behind saturation.
inline constexpr std::array<effects::ActsOn, 4> sites = {
    effects::ActsOn::mu, effects::ActsOn::m, effects::ActsOn::tau, effects::ActsOn::mu_m};
inline constexpr std::size_t on_mu = 0, on_both = 3;

// What tau_R changes, per block, where an effect's factor changes by 1, at each site.
using Sensitivities =
    std::array<Eigen::VectorXd, sites.size()>; // of size 0 where the law has no such site

// The campaign as every fit sees it.
struct Campaign {
  const models::Law& law; // the one that is traced
  models::Conventions conventions;
  const Blocks& blocks;
  const Candidates& candidates;
  Eigen::VectorXd measured; // per block; minus what averaging over a block does to the law
  Eigen::MatrixXd nuisance; // per block: what may not explain anything
  bool quick = false;       // noise is fitted no closer than weights can show
  // Of more than 200 tests: where fits start, and what the noise is fitted to.
  std::shared_ptr<const Selection> selection = nullptr;
  bool of_selected = false; // this one is of selected tests
  // How far the law's own parameters may go from those without effects where one follows an input
  // of the law: it can take the place of a parameter; what the tests cannot tell then, and other
  // states would show, stays as it was.
  Penalty own = {};
};
// The campaign of its selected tests; itself where there are none.
Campaign selected(const Campaign& campaign);

// The law with some effects, fitted together with the noise.
struct Rival {
  std::vector<effects::PlacedEffect> effects; // parameters fitted
  std::vector<Cause> causes;                  // one per effect
  std::vector<double> parameters;             // of the extended law
  std::size_t own = 0;                        // of them the law's own, in front
  NoiseModel noise;
  NoiseModel weights; // of the fit: the noise model, or alike for all rows
  Eigen::VectorXd predicted;
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd log_likelihood; // per experiment
  double total = 0;
  double freedom = 0; // effective number of parameters; stiff smooths have fewer than knots
  // Minus what parameters and complexity cost; -infinity where friction would be negative.
  double penalised = 0;
  double criterion = 0; // of choose_cause, -2 log restricted likelihood: smaller is better
};

// kept: under the noise given, so that rivals are compared alike | again: fitted, twice in turn
// with the parameters.
enum class NoiseSearch { kept, again };

// All parameters by generalised least squares. `parameters`: start of the law's own (and m_limit,
// if any, behind them). Of a campaign with a selection, parameters and noise are fitted to that
// first; from there the parameters, under that noise, to all tests.
Rival fit_rival(const Campaign& campaign, std::vector<effects::PlacedEffect> effects,
                std::vector<Cause> causes, std::span<const double> parameters,
                const NoiseModel& noise, NoiseSearch search);

// `rival` with more effects, or with one changed: its own parameters as the start.
Rival fit_rival(const Campaign& campaign, const Rival& from,
                std::vector<effects::PlacedEffect> effects, std::vector<Cause> causes,
                const NoiseModel& noise, NoiseSearch search);

// Noise of a residual of the campaign's law, fitted to the selected tests where there are any: from
// scratch, and of a residual that has changed, from an earlier fit.
NoiseModel fit_noise(const Campaign& campaign, const NoiseData& data);
NoiseModel refit_noise(const Campaign& campaign, const NoiseData& data, const NoiseModel& earlier);

// Of the smooth effects, over all parameters: what a fit adds to its normal equations. Empty where
// there are none.
Eigen::MatrixXd penalty_of(const Rival& rival);

// Ties the law's own parameters to those of this rival in all further fits with effects, with this
// share of the information that the tests have of them.
void tie_parameters(Campaign& campaign, const Rival& base, double share);

// Without its effect `index`, not fitted again.
Rival less_effect(Rival rival, std::size_t index);
// The same, all refitted.
Rival without_effect(const Campaign& campaign, const Rival& rival, std::size_t index);

// The same law with its parameters fitted under other weights.
Rival with_weights(const Campaign& campaign, Rival rival, const NoiseModel& weights);

// All rows alike: ordinary least squares. Where the law is right, the noise model's weights predict
// better; where it is not, they may lean on the few rows that are least correlated with others.
NoiseModel rows_alike(const NoiseModel& noise);

// Index in `sites` of where the effect acts.
std::size_t site_of(const effects::PlacedEffect& effect);

// Values to start from of the law with effects: the law's `count` own, each effect's, and behind
// them m_limit, which is the last of `own` where that has more than `count`.
std::vector<double> start_of(const models::Law& extended, std::span<const double> own,
                             std::size_t count, std::span<const effects::PlacedEffect> effects);

// Bound to its columns; shapes bounded by what the data can tell.
models::Law bounded_law(const Campaign& campaign, const Rival& rival);

// Which rivals these experiments cannot tell from the first (Vuong 1989, by resampling whole
// experiments): not worse with 95 %, or within 2 of its log likelihood.
std::vector<bool> not_told_apart(const std::vector<Rival>& rivals, std::uint64_t seed);

} // namespace frictab::trace
