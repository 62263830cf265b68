// Restricted likelihood of the noise, and chi-square limits of the scatter between experiments.
#include "trace/scatter.h"

#include <algorithm>
#include <cmath>

#include <gsl/gsl_cdf.h>

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Mean square of the measured rows about their block's line of blocks: what block means leave out.
double within_blocks(const Dataset& training, const Blocks& blocks) {
  const auto tau = training.values("tau_R_MPa");
  double sum = 0;
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    const std::size_t begin = blocks.first_row[b], end = blocks.first_row[b + 1];
    const auto n = static_cast<double>(end - begin);
    if (end - begin < 2) continue;
    double my = 0, mx = (n - 1) / 2, xy = 0, xx = 0, yy = 0;
    for (std::size_t i = begin; i < end; ++i)
      my += tau[i] / n;
    for (std::size_t i = begin; i < end; ++i) {
      const double dx = static_cast<double>(i - begin) - mx, dy = tau[i] - my;
      xy += dx * dy;
      xx += dx * dx;
      yy += dy * dy;
    }
    // (Two rows tell nothing of a trend; from block to block it is small.)
    sum += end - begin == 2 ? yy : std::max(yy - xy * xy / xx, 0.0) * (n - 1) / (n - 2);
  }
  return sum / static_cast<double>(training.rows());
}

// Of each experiment, relative to the law.
VectorXd levels(const VectorXd& residual, const VectorXd& predicted, const Campaign& campaign) {
  const auto& first = campaign.blocks.first;
  VectorXd level(static_cast<Index>(first.size() - 1));
  for (Index e = 0; e < level.size(); ++e) {
    const auto begin = static_cast<Index>(first[static_cast<std::size_t>(e)]);
    const auto count = static_cast<Index>(first[static_cast<std::size_t>(e) + 1]) - begin;
    const auto law = predicted.segment(begin, count);
    level(e) = law.dot(residual.segment(begin, count)) / law.squaredNorm();
  }
  return level;
}

// Not below 0. A variance of heavy-tailed values is known less well, as if there were fewer.
double excess_kurtosis(const VectorXd& values) {
  const Eigen::ArrayXd squares = (values.array() - values.mean()).square();
  const double variance = squares.mean();
  return variance > 0 ? std::max(0.0, squares.square().mean() / (variance * variance) - 3) : 0;
}

} // namespace

void add_scatter(Trace& trace, const Campaign& campaign, const Rival& last,
                 const Dataset& training) {
  const VectorXd residual = campaign.measured - last.predicted;
  const NoiseFit fit = fit_noise(residual, last.predicted, campaign.blocks.first, last.jacobian,
                                 last.noise, 200, campaign.nuisance);
  const NoiseModel& noise = fit.noise;
  const Whitener whitener(noise, last.predicted, campaign.blocks.first);
  const double modelled = whitener.variance().mean() + within_blocks(training, campaign.blocks);
  const Metrics& after = last.effects.empty() ? trace.recalibrated.training : trace.after.training;
  // (Of few experiments the likelihood may take any scatter for possible; what is left, with the
  // fitted parameters' share, is more than the noise.)
  const double experiments = static_cast<double>(training.experiments.size());
  const double share_left =
      std::max(0.5, 1 - static_cast<double>(last.parameters.size()) / experiments);
  const double rmse = std::min(std::sqrt(modelled), after.rmse_MPa / std::sqrt(share_left));
  trace.noise_floor.method =
      "noise model: scatter between experiments, slow and white noise within, "
      "by restricted maximum likelihood";
  trace.noise_floor.part = "training";
  trace.noise_floor.rmse_MPa = rmse;
  trace.noise_floor.mae_MPa = after.rmse_MPa > 0 ? rmse * after.mae_MPa / after.rmse_MPa : 0;
  trace.noise_floor.n_rows = training.rows();
  trace.noise_floor.n_experiments = training.experiments.size();
  const double share = noise.between(last.predicted);
  trace.scatter_between = share;
  const double degrees =
      std::max(1.0, (experiments - static_cast<double>(last.parameters.size())) /
                        (1 + 0.5 * excess_kurtosis(levels(residual, last.predicted, campaign))));
  const auto bound = [&](double probability) {
    return share * std::sqrt(degrees / gsl_cdf_chisq_Pinv(probability, degrees));
  };
  trace.scatter_interval = {bound(0.975), bound(0.025)};
  trace.scatter_at_least = bound(0.95);
}

} // namespace frictab
