// Sandwich by test; certainty of each effect, in standard errors from "no effect".
#include "trace/judge/rows_alike.h"

#include <cmath>
#include <numeric>

#include "effects/extended_law.h"
#include "trace/columns/shapes.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// Contribution of each test to the sandwich, from whitened residuals. (Nuisance columns are
// projected out of all tests together; the share of a single test in them is ignored.)
std::vector<calibrate::ExperimentSums> sums_by_test(const Campaign& campaign, const Rival& rival) {
  const stats::Whitener whitener(rival.weights, rival.predicted, campaign.blocks,
                                 campaign.nuisance);
  MatrixXd jacobian = rival.jacobian;
  MatrixXd residual = campaign.measured - rival.predicted;
  whitener.apply(jacobian);
  whitener.apply(residual);
  std::vector<calibrate::ExperimentSums> sums;
  for (std::size_t e = 0; e < campaign.blocks.experiments(); ++e) {
    const auto rows = campaign.blocks.rows_of(jacobian, e);
    sums.push_back(
        {rows.transpose() * campaign.blocks.part(residual.col(0), e), rows.transpose() * rows});
  }
  return sums;
}

double largest_ratio(const VectorXd& sizes, const VectorXd& errors) {
  double most = 0;
  for (Index i = 0; i < sizes.size(); ++i) {
    if (std::isnan(errors(i))) return HUGE_VAL; // not known: the effect stays
    if (sizes(i) != 0) most = std::max(most, std::abs(sizes(i)) / errors(i));
  }
  return most;
}

// Largest distance of the factor from 1, or from its own mean, at any block, in standard errors.
// The mean is needed because a constant factor may be attributed to the law's parameters as well,
// and then has a large error.
double certainty(const Campaign& campaign, const effects::PlacedEffect& effect,
                 const MatrixXd& covariance) {
  FactorOnRows on = factor_on_rows(effect, inputs_on(effect, campaign.candidates.by_symbol),
                                   campaign.blocks.count());
  const double from_none = largest_ratio(on.factor.array() - 1, std_errors(on.slope, covariance));
  on.factor.array() -= on.factor.mean();
  on.slope.rowwise() -= on.slope.colwise().mean().eval();
  return std::max(from_none, largest_ratio(on.factor, std_errors(on.slope, covariance)));
}

struct LeastCertain {
  std::size_t effect = 0;
  double certainty = HUGE_VAL;
};

LeastCertain least_certain(const Campaign& campaign, const Rival& rival) {
  LeastCertain found;
  const MatrixXd covariance = uncertainty_of(campaign, rival).covariance;
  for (std::size_t i = 0; i < rival.effects.size(); ++i) {
    const std::size_t first = first_parameter(rival, i),
                      count = effects::fitted_parameters(rival.effects[i]).size();
    const double one =
        certainty(campaign, rival.effects[i], covariance.block(first, first, count, count));
    if (one < found.certainty) found = {i, one};
  }
  return found;
}

} // namespace

calibrate::Uncertainty uncertainty_of(const Campaign& campaign, const Rival& rival) {
  return calibrate::cluster_sandwich(bounded_law(campaign, rival).parameters, rival.parameters,
                                     sums_by_test(campaign, rival), penalty_of(rival));
}

FittedAlike fit_rows_alike(const Campaign& campaign, const Rival& rival) {
  const auto alike = [&](const Rival& one) {
    return with_weights(campaign, one, rows_alike(one.noise));
  };
  FittedAlike found{alike(rival), std::vector<std::size_t>(rival.effects.size())};
  std::iota(found.kept.begin(), found.kept.end(), 0);
  while (!found.kept.empty()) {
    const LeastCertain least = least_certain(campaign, found.rival);
    if (least.certainty > tuning::doubtful_std_errors) break;
    found.rival = alike(less_effect(found.rival, least.effect));
    found.kept.erase(found.kept.begin() + least.effect);
  }
  if (found.kept.size() < rival.effects.size() && !campaign.quick) // its noise has changed
    found.rival = alike(fit_rival(campaign, found.rival, found.rival.effects, found.rival.causes,
                                  found.rival.noise, NoiseSearch::again));
  return found;
}

} // namespace frictab::trace
