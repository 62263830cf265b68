// The noise model: the covariance of the residuals of one experiment. It weights every fit and
// every test of the trace stage, because the rows of an experiment are not independent: an
// experiment as a whole lies high or low, and neighbouring rows err alike. Without it a few long
// experiments would count as thousands of observations.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "stats/blocks.h"

namespace frictab::stats {

// Covariance V of the block means of one experiment, t = predicted shear stress there, x = position
// in the experiment (-1/2 .. 1/2):
//   gain^2 t t' + slope^2 (t x)(t x)' + D (slow^2 exp(-|x_i - x_j| / length) + white^2 W) D,
//   D = scale diag (t / scale)^growth, W = diag (usual rows of a block / rows of this one).
// An experiment as a whole lies high or low (gain), and rises or falls relative to the law (slope);
// noise within it has a slow (autocorrelated) and a white part. All but `scale` are relative to the
// shear stress, so results do not depend on its unit. `length` is capped at 0.4 of an experiment:
// slower noise could not be distinguished from the gain and would absorb it.
struct NoiseModel {
  double gain = 0;
  double slope = 0;
  double slow = 1;
  double length = 0.1; // of an experiment
  double white = 1;
  double growth = 1; // 0: the same at all stresses | 1: proportional to the stress
  double scale = 1;  // MPa, mean predicted shear stress
};

// D of the formula above, per block.
Eigen::ArrayXd noise_size(const NoiseModel& noise, const Eigen::VectorXd& tau);

// Whitens columns of block values, i.e. multiplies them by V^-1/2: the results have independent
// errors of variance 1, so that ordinary least squares on them is generalised least squares on the
// originals. Experiments are independent. Within one, a Kalman filter turns slow and white noise
// into independent innovations (the slow noise is autoregressive; a few operations per value). Gain
// and slope add two directions to the covariance, whose share is then removed. Last, nuisance
// columns are projected out.
class Whitener {
public:
  // `tau`: predicted, per block; `nuisance`: directions that no test may use (structure along the
  // order of tests, ...), or no columns.
  Whitener(const NoiseModel& noise, const Eigen::VectorXd& tau, const Blocks& blocks,
           const Eigen::MatrixXd& nuisance = {});

  // Whitens columns of block values in place.
  void apply(Eigen::Ref<Eigen::MatrixXd> columns) const;
  // Log determinant of V, per experiment.
  const Eigen::VectorXd& log_det() const { return log_det_; }
  // Variance of each block mean.
  const Eigen::VectorXd& variance() const { return variance_; }

private:
  struct Part {
    Eigen::Index first, size;
    double rho;
  };
  // Sets up the filter along one experiment and returns its log determinant.
  double make_filter(const Part& part, const Eigen::VectorXd& white, double slow);
  void filter(Eigen::Ref<Eigen::MatrixXd> columns) const;

  std::vector<double> gain_, scale_; // of the filter, per block
  std::vector<Part> parts_;
  Eigen::VectorXd shrink_; // 1/D
  Eigen::VectorXd log_det_, variance_;
  std::vector<Eigen::MatrixXd> q_;  // per experiment, orthonormal directions of the random effects
  std::vector<Eigen::MatrixXd> qc_; // and the factors removed along them
  Eigen::MatrixXd nuisance_;        // orthonormal, whitened
};

} // namespace frictab::stats
