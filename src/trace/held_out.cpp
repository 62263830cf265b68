// Cross-validation by experiment.
#include "trace/held_out.h"

#include <algorithm>

#include "calibrate/folds.h"
#include "core/parallel.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t cv_folds = 5;
constexpr double least_gain = 0.002;    // of the error, that an effect has to bring
constexpr double clearly_better = 0.04; // that plain least squares must be, to be used instead

VectorXd errors_under(const NoiseModel& weights, const Campaign& campaign, const Rival& rival,
                      std::uint64_t seed) {
  const LawOnBlocks law(bounded_law(campaign, rival), campaign.conventions,
                        campaign.candidates.by_symbol);
  const auto& first = campaign.blocks.first;
  const Whitener whitener(weights, rival.predicted, first);
  const std::size_t experiments = campaign.blocks.experiments();
  const std::size_t folds = std::min(cv_folds, experiments);
  const auto fold = experiment_folds(experiments, folds, seed, 0);
  const auto rows = [&](std::size_t e, auto&& values) {
    return values.segment(static_cast<Index>(first[e]),
                          static_cast<Index>(first[e + 1] - first[e]));
  };
  VectorXd errors(static_cast<Index>(experiments));
  parallel_for(folds, [&](std::size_t f) {
    VectorXd use = VectorXd::Ones(campaign.measured.size());
    for (std::size_t e = 0; e < experiments; ++e)
      if (fold[e] == f) rows(e, use).setZero();
    const BlockFit fit = fit_blocks(law, campaign.measured, whitener, rival.parameters, use);
    const VectorXd left = (campaign.measured - fit.predicted).cwiseAbs();
    for (std::size_t e = 0; e < experiments; ++e)
      if (fold[e] == f) errors(static_cast<Index>(e)) = rows(e, left).sum();
  });
  return errors / static_cast<double>(campaign.measured.size());
}

} // namespace

VectorXd held_out_errors(const Campaign& campaign, const Rival& rival, std::uint64_t seed) {
  const VectorXd weighted = errors_under(rival.noise, campaign, rival, seed);
  const VectorXd plain = errors_under(rows_alike(rival.noise), campaign, rival, seed);
  return plain.sum() < weighted.sum() ? plain : weighted;
}

bool pays(const VectorXd& without, const VectorXd& with) {
  return with.sum() < (1 - least_gain) * without.sum();
}

Rival delivered(const Campaign& campaign, const Rival& rival, std::uint64_t seed) {
  const NoiseModel alike = rows_alike(rival.noise);
  const bool plain = errors_under(alike, campaign, rival, seed).sum() <
                     (1 - clearly_better) * errors_under(rival.noise, campaign, rival, seed).sum();
  return plain ? with_weights(campaign, rival, alike) : rival;
}

} // namespace frictab
