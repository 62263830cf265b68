// What the residuals of one experiment have in common: the covariance that weights every fit and
// every test of the trace stage.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace frictab {

// Covariance of the block means of one experiment, tau = predicted shear stress there:
//   u u' + multiplicative^2 tau tau' + D (slow^2 rho^|i-j| + white^2 I) D,
//   u = additive + coupling tau / scale, D = diag (tau / scale)^growth
// (level and slope of the experiment as two random effects that may go together; slow and white
// noise within it, which grow with tau).
struct NoiseModel {
  double additive = 0;       // MPa
  double coupling = 0;       // MPa
  double multiplicative = 0; // 1
  double slow = 1;           // MPa
  double rho = 0.5;          // from block to block
  double white = 1;          // MPa
  double growth = 0;
  double scale = 1; // MPa, mean predicted tau

  // Standard deviation between experiments relative to tau, root mean square over blocks.
  double between(const Eigen::VectorXd& tau) const;
};

// V^-1/2 of all experiments, which are independent: the slow and white noise by their innovations
// (Kalman filter, a few operations per value), the random effects as two directions; behind it,
// nuisance columns are projected out.
class Whitener {
public:
  // `tau`: predicted, per block; `first`: blocks of each experiment; `nuisance`: directions of
  // which nothing is to be seen (structure along the order of tests, ...), or no columns.
  Whitener(const NoiseModel& noise, const Eigen::VectorXd& tau, std::span<const std::size_t> first,
           const Eigen::MatrixXd& nuisance = {});

  // Columns of block values, in place.
  void apply(Eigen::Ref<Eigen::MatrixXd> columns) const;
  void apply(Eigen::Ref<Eigen::MatrixXf> columns) const;
  // Log determinant of V, per experiment.
  const Eigen::VectorXd& log_det() const { return log_det_; }
  // Log determinant of what the data say about the nuisance columns' coefficients.
  double nuisance_log_det() const { return nuisance_log_det_; }
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
  };
  double rho_ = 0;
  std::vector<double> gain_, scale_; // of the filter, by place in the experiment
  std::vector<Part> parts_;
  Eigen::VectorXd shrink_; // 1/D
  Eigen::VectorXd log_det_, variance_;
  Directions<double> directions_;
  Directions<float> directions_f_;
  double nuisance_log_det_ = 0;
};

// Maximum likelihood of `residual` (per block), by NLopt's BOBYQA; restricted maximum likelihood
// where `jacobian` has columns (of fitted parameters), so that fitted degrees of freedom do not
// make the noise look smaller. `start`: of an earlier fit; its growth is kept.
struct NoiseFit {
  NoiseModel noise;
  double log_likelihood = 0;
};
NoiseFit fit_noise(const Eigen::VectorXd& residual, const Eigen::VectorXd& tau,
                   std::span<const std::size_t> first, const Eigen::MatrixXd& jacobian,
                   const NoiseModel& start, int evaluations, const Eigen::MatrixXd& nuisance = {});

// The same from nothing but the size of the residual, beside `start`: noise that has been fitted to
// the residual of a law that lacked an effect has swallowed it, and does not let go by itself.
NoiseFit fit_noise_anew(const Eigen::VectorXd& residual, const Eigen::VectorXd& tau,
                        std::span<const std::size_t> first, const NoiseModel& start,
                        int evaluations, const Eigen::MatrixXd& nuisance = {});

// From nothing: both ways that noise may grow (not at all, with tau) are tried.
NoiseFit first_noise(const Eigen::VectorXd& residual, const Eigen::VectorXd& tau,
                     std::span<const std::size_t> first, const Eigen::MatrixXd& jacobian,
                     const Eigen::MatrixXd& nuisance = {});

// An orthonormal basis of what the columns span; columns that others explain are left out.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

// `more` behind the columns that are there.
void append_columns(Eigen::MatrixXd& to, const Eigen::MatrixXd& more);

} // namespace frictab
