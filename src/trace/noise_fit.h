// Fits the noise model of noise.h to the residuals of a law.
//
// The residuals of one experiment are taken for normal with mean X b and the covariance V of the
// noise model; X are the directions of the parameters that were fitted. Maximum likelihood would
// take what those parameters have explained for a lack of noise. Restricted maximum likelihood
// (Patterson and Thompson 1971) does not: it maximises
//   -1/2 (log det V + log det X' V^-1 X + r' P r),   P = V^-1 - V^-1 X (X' V^-1 X)^-1 X' V^-1,
// the likelihood of what is left of the data beside X. Neither V nor its inverse is ever formed.
// The slow noise is a first-order autoregressive process of one of a few lengths. At one length the
// directions in which slow and white noise are independent are the same for any size of either, and
// for all experiments of as many blocks: the columns are turned into them once, their products are
// summed over such experiments once, and each size of the noise is a sum over directions. Gain and
// slope come in as a 2 x 2 matrix per experiment (Woodbury's identity). Four logarithms of standard
// deviations are searched at each length (NLopt's BOBYQA).
#pragma once

#include <Eigen/Core>

#include "trace/noise.h"

namespace frictab::trace {

// What the noise is fitted to: the residual per block, and what it is the residual of.
struct NoiseData {
  const Eigen::VectorXd& residual;
  const Eigen::VectorXd& tau; // predicted
  const Blocks& blocks;
  const Eigen::MatrixXd& fitted;   // directions of the parameters that were fitted
  const Eigen::MatrixXd& nuisance; // directions that count as fitted as well; may have no columns
  // false: experiments have no slope of their own. For a screening, which asks only what
  // experiments share: a slope that is free in each hides a rise that all of them have.
  bool slope = true;
};

struct NoiseFit {
  NoiseModel noise;
  double log_likelihood = 0; // restricted
};

// From scratch: several starts, all lengths, and both ways in which noise may grow (not at all, in
// proportion to the stress). Converged far beyond what data can tell, so that rounding of the data,
// their unit and their order do not show in any result.
NoiseFit fit_noise(const NoiseData& data);

// After the law has changed: from an earlier fit and from scratch, with its growth, at its length
// and the two beside it. The second start is needed because noise that was fitted without an effect
// explains that effect as noise, and a search from there stays in that maximum.
NoiseFit refit_noise(const NoiseData& data, const NoiseModel& earlier);

// Where little has changed: from the earlier fit alone, at its length.
NoiseFit refine_noise(const NoiseData& data, const NoiseModel& earlier);

// For the folds of a repeated search: both starts at the earlier length, and no closer than it
// takes for weights.
NoiseFit refit_noise_coarsely(const NoiseData& data, const NoiseModel& earlier);

} // namespace frictab::trace
