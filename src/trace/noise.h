// What the residuals of one experiment have in common: the covariance that weights every fit and
// every test of the trace stage.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "trace/blocks.h"

namespace frictab {

// Covariance of the block means of one experiment, t = predicted shear stress there, x = position
// in the experiment (-1/2 .. 1/2):
//   gain^2 t t' + slope^2 (t x)(t x)' + D (slow^2 exp(-|x_i - x_j| / length) + white^2 W) D,
//   D = scale diag (t / scale)^growth, W = diag (usual rows of a block / rows of this one).
// An experiment as a whole lies high or low (gain), and rises or falls against the law (slope);
// noise within it is slow and white. All but `scale` are relative to the shear stress, so that a
// unit of stress changes nothing. `length` is capped at 0.4 of an experiment: slow noise that
// lasts longer could not be told from the gain and would swallow it.
struct NoiseModel {
  double gain = 0;
  double slope = 0;
  double slow = 1;
  double length = 0.1; // of an experiment
  double white = 1;
  double growth = 1; // 0: the same for all stresses | 1: in proportion to the stress
  double scale = 1;  // MPa, mean predicted shear stress
};

// D of the formula above, per block.
Eigen::ArrayXd noise_size(const NoiseModel& noise, const Eigen::VectorXd& tau);

// V^-1/2 of all experiments, which are independent: the slow and white noise by their innovations
// (Kalman filter, a few operations per value), the random effects as two directions; behind it,
// nuisance columns are projected out.
class Whitener {
public:
  // `tau`: predicted, per block; `nuisance`: directions of which nothing is to be seen (structure
  // along the order of tests, ...), or no columns.
  Whitener(const NoiseModel& noise, const Eigen::VectorXd& tau, const Blocks& blocks,
           const Eigen::MatrixXd& nuisance = {});

  // Columns of block values, in place.
  void apply(Eigen::Ref<Eigen::MatrixXd> columns) const;
  void apply(Eigen::Ref<Eigen::MatrixXf> columns) const;
  // Log determinant of V, per experiment.
  const Eigen::VectorXd& log_det() const { return log_det_; }
  // Variance of each block mean.
  const Eigen::VectorXd& variance() const { return variance_; }

private:
  template <class Number> using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  template <class Number> void filter(Eigen::Ref<Matrix<Number>> columns) const;
  template <class Number> struct Directions {
    std::vector<Matrix<Number>> q;  // per experiment, orthonormal: of the random effects
    std::vector<Matrix<Number>> qc; // and what is taken off along them
    Matrix<Number> nuisance;        // orthonormal, whitened
  };
  template <class Number>
  void apply(Eigen::Ref<Matrix<Number>> columns, const Directions<Number>& directions) const;

  struct Part {
    Eigen::Index first, size;
    double rho;
  };
  // Of the filter along one experiment; its log determinant.
  double make_filter(const Part& part, const Eigen::VectorXd& white, double slow);

  std::vector<double> gain_, scale_; // of the filter, per block
  std::vector<Part> parts_;
  Eigen::VectorXd shrink_; // 1/D
  Eigen::VectorXd log_det_, variance_;
  Directions<double> directions_;
  Directions<float> directions_f_;
};

// Where a residual (per block) comes from: what the noise is fitted to.
struct NoiseData {
  const Eigen::VectorXd& residual;
  const Eigen::VectorXd& tau; // predicted
  const Blocks& blocks;
  // Directions of fitted parameters: restricted maximum likelihood, so that fitted degrees of
  // freedom do not make the noise look smaller.
  const Eigen::MatrixXd& fitted;
  const Eigen::MatrixXd& nuisance;
  // false: experiments have no slope of their own. For a screening, which asks only what
  // experiments share: a slope that is free in each hides a rise that all of them have.
  bool slope = true;
};

struct NoiseFit {
  NoiseModel noise;
  double log_likelihood = 0; // restricted
};

// Restricted maximum likelihood, from several starts, for each of a few lengths; converged far
// beyond what data can tell, so that rounding of the data, their unit and their order do not show.
// Both ways in which noise may grow (not at all, with tau) are tried.
NoiseFit fit_noise(const NoiseData& data);

// The same for the growth of an earlier fit, from it and from nothing: noise fitted to the residual
// of a law that lacked an effect has swallowed it, and does not let go by itself.
NoiseFit refit_noise(const NoiseData& data, const NoiseModel& earlier);

// The same at its length, from it alone: where little has changed.
NoiseFit refine_noise(const NoiseData& data, const NoiseModel& earlier);

// From it and from nothing at its length, to what weights can show: where a search is repeated.
NoiseFit refit_noise_coarsely(const NoiseData& data, const NoiseModel& earlier);

// An orthonormal basis of what the columns span; columns that others explain are left out.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

// `more` behind the columns that are there.
void append_columns(Eigen::MatrixXd& to, const Eigen::MatrixXd& more);

} // namespace frictab
