// Fit of the polynomial: generalised least squares with all variance components estimated.
//
// y = ln mu of the bins, A = [1, terms], b ~ N(0, t_o^2) for the terms of order o (a ridge), and
// within one experiment with bins at x of r rows (r of the mean bin = 1)
//   V = gain^2 + 12 slope^2 x x' + slow^2 exp(-|x - x'|/length) + white^2/r on the diagonal.
// The standard deviations gain, slope, slow, white, t_1 .. t_o and the length maximise the
// restricted likelihood (stats/reml.h). A difference between experiments thus has little weight and
// a change within one much, and terms without support in the data shrink to zero. This combination
// is our own.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace frictab::calibrate {

// Standard deviations of ln mu; the length in strokes.
struct PolynomialNoise {
  double gain = 0.08;  // of an experiment as a whole
  double slope = 0.02; // of the difference from the middle of the stroke, averaged over it
  double slow = 0.03;
  double length = 0.2; // correlation length of the slow part
  double white = 0.02; // of a bin with the mean number of rows
};

struct PolynomialProblem {
  Eigen::MatrixXd design;          // bins x (1 + terms); the first column is 1
  std::vector<unsigned> order;     // of each column; 0 for the first
  Eigen::VectorXd ln_mu;           // of the bins
  Eigen::VectorXd position;        // within the experiment, -1/2 to 1/2
  Eigen::VectorXd rows;            // of each bin
  std::vector<Eigen::Index> first; // first bin of each experiment; last, the number of bins
};

struct PolynomialFit {
  Eigen::VectorXd coefficients; // one per column of the design
  // columns x experiments: the same fitted without each experiment, at this noise
  Eigen::MatrixXd without;
  PolynomialNoise noise;
  std::vector<double> spread; // t_1 .. t_o: standard deviation of the coefficients of each order
  double criterion = 0;       // the minimised function, with a weak prior on the logarithms
  std::size_t evaluations = 0;
};

// Fits the polynomial. Components that the data do not determine (no repeated experiment, one bin
// each) stay near the defaults of PolynomialNoise. Accepts any number of bins, also none.
PolynomialFit fit_polynomial(const PolynomialProblem& problem);

// V of one experiment with bins at these positions; `relative_rows` of a mean bin is 1.
Eigen::MatrixXd bin_covariance(const PolynomialNoise& noise, const Eigen::VectorXd& position,
                               const Eigen::VectorXd& relative_rows);

// Standard errors of the coefficients by experiment (jackknife: Tukey 1958), with the ridge fixed;
// NaN with fewer than three experiments.
Eigen::VectorXd jackknife_errors(const PolynomialFit& fit);

// Evaluates the criterion at the logarithms of gain, slope, slow, length, white, t_1 .. t_o and, if
// requested, its gradient.
double polynomial_criterion(const PolynomialProblem& problem, std::span<const double> logs,
                            std::span<double> gradient = {});

} // namespace frictab::calibrate
