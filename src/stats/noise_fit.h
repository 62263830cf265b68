// Fit of the noise model of noise.h to the residuals of a law.
//
// The residuals are modelled as normal with mean X b and the covariance V of the noise model; X
// holds the directions of the parameters that were fitted. V maximises the restricted likelihood
// (stats/reml.h). Neither V nor its inverse is formed.
// The slow noise is a first-order autoregressive process with one of a few lengths. At a given
// length, the directions in which slow and white noise are independent are the same for any size of
// either and for all experiments with as many blocks. So the columns are transformed to these
// directions once, their products are summed over such experiments once, and the likelihood for
// each size of the noise is a sum over directions. Gain and slope enter as a 2 x 2 matrix per
// experiment (Woodbury's identity). Four logarithms of standard deviations are searched at each
// length.
#pragma once

#include <Eigen/Core>

#include "stats/noise.h"

namespace frictab::stats {

// Data of a noise fit: a residual per block, and the fit that left it.
struct NoiseData {
  const Eigen::VectorXd& residual;
  const Eigen::VectorXd& tau; // predicted
  const Blocks& blocks;
  const Eigen::MatrixXd& fitted;   // directions of the parameters that were fitted
  const Eigen::MatrixXd& nuisance; // further directions that count as fitted; may have no columns
};

struct NoiseFit {
  NoiseModel noise;
  double log_likelihood = 0; // restricted
};

// Fits from scratch: several starts, all lengths, and both kinds of growth of the noise (constant,
// proportional to the stress). Converges far beyond statistical accuracy, so that results do not
// depend on rounding of the data, their unit or their order.
NoiseFit fit_noise(const NoiseData& data);

// Refits after the law has changed: from an earlier fit and from scratch, keeping its growth, at
// its length and the two neighbouring ones. The second start is needed because an earlier fit
// without an effect explains that effect as noise, and an optimisation from there stays in that
// maximum.
NoiseFit refit_noise(const NoiseData& data, const NoiseModel& earlier);

// Refits after a small change: from the earlier fit alone, at its length.
NoiseFit refine_noise(const NoiseData& data, const NoiseModel& earlier);

// Refits for the folds of a repeated search: from both starts at the earlier length, only as
// accurately as weights need.
NoiseFit refit_noise_coarsely(const NoiseData& data, const NoiseModel& earlier);

} // namespace frictab::stats
