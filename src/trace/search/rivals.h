// Rivals: a law with some effects, fitted to the blocks of a campaign under a noise model.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "stats/noise_fit.h"
#include "trace/columns/candidates.h"
#include "trace/search/law_on_blocks.h"
#include "trace/search/selection.h"

namespace frictab::trace {

// Sites of a law, the parts of it that an effect may change (PlacedEffect::acts_on); other code
// refers to them by their index in this list. mu and the limit together are a site only where a law
// has a limit of its own, because worse lubrication acts both below and at saturation.
inline constexpr std::array<effects::ActsOn, 4> sites = {
    effects::ActsOn::mu, effects::ActsOn::m, effects::ActsOn::tau, effects::ActsOn::mu_m};
inline constexpr std::size_t on_mu = 0, on_both = 3;

// Derivative of tau_R by an effect's factor, per block, at each site; of size 0 where the law has
// no such site.
using Sensitivities = std::array<VectorXd, sites.size()>;

// Site at which effects are searched: mu, with the limit where a law has its own.
inline std::size_t searched_site(const Sensitivities& all) {
  return all[on_both].size() > 0 ? on_both : on_mu;
}

// Data and settings that all fits of a campaign share.
struct Campaign {
  const models::Law& law; // the traced law
  models::Conventions conventions;
  const stats::Blocks& blocks;
  const Candidates& candidates;
  VectorXd measured;  // per block; minus the error of evaluating the law at block means
  MatrixXd nuisance;  // per block: directions that may not explain anything
  bool quick = false; // the noise is fitted only as accurately as weights need
  // For more than 200 tests: the tests with which fits start, and to which the noise is fitted.
  std::shared_ptr<const Selection> selection = nullptr;
  bool of_selected = false; // this campaign consists of selected tests
  // Penalty that ties the law's own parameters to those of the fit without effects, in fits where
  // an effect follows an input of the law (tie_parameters).
  Penalty own = {};
};
// Returns the campaign of its selected tests; itself where it has no selection.
Campaign selected(const Campaign& campaign);

// The law with some effects, fitted together with the noise; `parameters` are those of the extended
// law.
struct Rival : BlockFit {
  std::vector<effects::PlacedEffect> effects; // with fitted parameters
  std::vector<Cause> causes;                  // one per effect
  std::size_t own = 0; // number of the law's own parameters, which come first
  stats::NoiseModel noise;
  stats::NoiseModel weights; // weights of the fit: the noise model, or equal for all rows
  VectorXd log_likelihood;   // per experiment
  double total = 0;
  double freedom = 0; // effective number of parameters; stiff smooths have fewer than knots
  // Total minus the costs of parameters, complexity and implausibility; -infinity where friction
  // would be negative.
  double penalised = 0;
  double criterion = 0; // from choose_cause: -2 log restricted likelihood; smaller is better
};

// kept: fits under the given noise, so that rivals are comparable | again: fits parameters and
// noise twice in alternation
enum class NoiseSearch { kept, again };

// Fits all parameters by generalised least squares. `parameters`: start values of the law's own,
// followed by m_limit if it has one. For a campaign with a selection, parameters and noise are
// first fitted to the selected tests; then the parameters, starting there and under that noise, to
// all tests.
Rival fit_rival(const Campaign& campaign, std::vector<effects::PlacedEffect> effects,
                std::vector<Cause> causes, std::span<const double> parameters,
                const stats::NoiseModel& noise, NoiseSearch search);

// Fits `from` with more effects, or with one changed, starting at its own parameters.
Rival fit_rival(const Campaign& campaign, const Rival& from,
                std::vector<effects::PlacedEffect> effects, std::vector<Cause> causes,
                const stats::NoiseModel& noise, NoiseSearch search);

// Fits `from` with one more effect.
Rival with_effect(const Campaign& campaign, const Rival& from, effects::PlacedEffect effect,
                  const Cause& cause, const stats::NoiseModel& noise, NoiseSearch search);

// Fits the noise of a residual of the campaign's law, to the selected tests where it has a
// selection: from scratch, or from an earlier fit of a residual that has changed since.
stats::NoiseModel campaign_noise(const Campaign& campaign, const stats::NoiseData& data,
                                 const stats::NoiseModel* earlier = nullptr);

// Penalty matrix of the smooth effects over all parameters, which a fit adds to its normal
// equations. Empty if no effect is penalised.
MatrixXd penalty_of(const Rival& rival);

// Ties the law's own parameters p to those of this rival, p0, in further fits in which an effect
// follows an input of the law. Such an effect can take the place of a parameter; the tests then
// determine only their combination, and the parameter would lose what it predicts for other states.
// The penalty is (p - p0)' share J' V^-1 J (p - p0): `share` times the information of the tests
// about p, where J is the Jacobian and V the noise covariance of the rival. A search uses a share
// of 0.1, too little to override what the tests can separate, and 1 (all of the information) where
// tests change one state at a time.
void tie_parameters(Campaign& campaign, const Rival& base, double share);

// Removes the effect `index` without refitting.
Rival less_effect(Rival rival, std::size_t index);
// Removes the effect and refits the rest.
Rival without_effect(const Campaign& campaign, const Rival& rival, std::size_t index);

// Fits the parameters of the same law under other weights.
Rival with_weights(const Campaign& campaign, Rival rival, const stats::NoiseModel& weights);

// Returns weights equal for all rows: ordinary least squares. Where the law is right, the noise
// model's weights predict better; where it is wrong, they may rely on the few rows that are least
// correlated with others.
stats::NoiseModel rows_alike(const stats::NoiseModel& noise);

// Index of the first parameter of an effect among those of the law.
std::size_t first_parameter(const Rival& rival, std::size_t effect);

// Returns the index in `sites` of the effect's site.
std::size_t site_of(const effects::PlacedEffect& effect);

// Assembles start values of the law with effects: the law's `count` own, each effect's and, where
// the law has it, m_limit, which is the last of `own` if that has more than `count`.
std::vector<double> start_of(const models::Law& extended, std::span<const double> own,
                             std::size_t count, std::span<const effects::PlacedEffect> effects);

// Builds the law with effects, with shape parameters limited to the range that the data can
// determine.
models::Law bounded_law(const Campaign& campaign, const Rival& rival);

// Marks the rivals that these experiments cannot distinguish from the first (Vuong 1989, by
// resampling whole experiments): not worse with 95 % confidence, or within 2 of its log restricted
// likelihood.
std::vector<bool> indistinguishable_rivals(const std::vector<Rival>& rivals, std::uint64_t seed);

} // namespace frictab::trace
