// The fit of the polynomial: generalised least squares with everything that scatters estimated.
//
// y = ln mu of the bins, A = [1, terms]. With b ~ N(0, t_o^2) for the terms of order o (a ridge)
// and, within one experiment with bins at x of r rows (r of the mean bin = 1),
//   V = gain^2 + 12 slope^2 x x' + slow^2 exp(-|x - x'|/length) + white^2/r on the diagonal,
// y has the covariance Sigma = V + A T A'. The standard deviations gain, slope, slow, white, t_1 ..
// t_o and the length maximise the restricted likelihood (REML: Patterson and Thompson 1971), that
// is they minimise
//   (ln|V| + ln|A'WA + T^-1| + ln|T| + y'W y - b'A'W y)/2,   W = V^-1,
// with b solving (A'WA + T^-1) b = A'W y. A difference between experiments so counts for little and
// what changes within one for much, and terms the data do not ask for shrink to nothing. Ours.
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
  double length = 0.2; // over which the slow part forgets
  double white = 0.02; // of a bin of mean rows
};

struct PolynomialProblem {
  Eigen::MatrixXd design;          // bins x (1 + terms); the first column is 1
  std::vector<unsigned> order;     // of each column; 0 of the first
  Eigen::VectorXd ln_mu;           // of the bins
  Eigen::VectorXd position;        // within the experiment, -1/2 to 1/2
  Eigen::VectorXd rows;            // of each bin
  std::vector<Eigen::Index> first; // bin of each experiment, and the end
};

struct PolynomialFit {
  Eigen::VectorXd coefficients; // of the columns of the design
  Eigen::MatrixXd without; // columns x experiments: the same fitted without each, at this noise
  PolynomialNoise noise;
  std::vector<double> spread; // t_1 .. t_o: standard deviation of the coefficients of each order
  double criterion = 0;       // what is minimised, with a weak prior on the logarithms
  std::size_t evaluations = 0;
};

// Where nothing speaks for or against a component (no experiment twice, one bin each), it stays
// near the defaults of PolynomialNoise. Any number of bins, none included.
PolynomialFit fit_polynomial(const PolynomialProblem& problem);

// Standard errors of the coefficients by experiment (jackknife: Tukey 1958), the ridge held; NaN of
// fewer than three experiments.
Eigen::VectorXd jackknife_errors(const PolynomialFit& fit);

// The criterion at the logarithms of gain, slope, slow, length, white, t_1 .. t_o, and its gradient
// where asked for.
double polynomial_criterion(const PolynomialProblem& problem, std::span<const double> logs,
                            std::span<double> gradient = {});

} // namespace frictab::calibrate
