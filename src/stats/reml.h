// Restricted maximum likelihood (REML: Patterson and Thompson 1971), by which variances are
// estimated.
//
// y = A b + e, with e normal of covariance V. Maximum likelihood would underestimate V by what the
// coefficients b have explained; the likelihood of the data after projection orthogonal to A does
// not. A coefficient may be free, or itself normal about 0 with a standard deviation that is
// estimated too (a ridge); T holds the variances of the latter, and T^-1 is 0 for the free ones. Up
// to a constant, minus the logarithm of the restricted likelihood is
//   (ln|V| + ln|T| + ln|A'WA + T^-1| + y'W y - b'A'W y)/2,   W = V^-1,   (A'WA + T^-1) b = A'W y.
// Standard deviations are searched by their logarithms, with a weak prior, because where the data
// do not determine one the likelihood is flat and the result would be arbitrary.
//
// Two evaluations form the sums of this criterion. DenseReml factorises V of each experiment: for
// any V, with the gradient, in operations that grow by the cube of the rows of an experiment. The
// noise fit of tracing runs for hundreds of laws and evaluates the criterion hundreds of times for
// each; it uses that slow and white noise of a given length are independent in directions known
// beforehand, so that it neither forms V nor factorises it (noise_fit.h). A test holds both to the
// same values. Two estimates by this likelihood stand elsewhere: that of random_effects.h is of one
// variance that is often 0, which has no logarithm, and is found by scoring from three sums; the
// search for terms (trace/search/joint_model.h) has tests as modes, whose V is diagonal.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Cholesky>

namespace frictab::stats {

// Sums over the rows that give the criterion.
struct RestrictedSums {
  Eigen::MatrixXd information; // A'WA + T^-1, of which only the lower triangle is read
  Eigen::VectorXd right;       // A'W y
  double squares = 0;          // y'W y
  double log_determinants = 0; // ln|V| + ln|T|
};

// The criterion, with the factor of the information and the coefficients in its basis.
struct RestrictedSolution {
  explicit RestrictedSolution(const RestrictedSums& sums);

  Eigen::LLT<Eigen::MatrixXd> factor; // of A'WA + T^-1
  Eigen::VectorXd along;              // L^-1 A'W y, whose squares b has explained
  double criterion = 0;
};

struct RemlRows {
  const Eigen::MatrixXd& design;       // A: rows x coefficients
  const Eigen::VectorXd& y;            // of the rows
  std::span<const Eigen::Index> first; // first row of each experiment; last, the number of rows
  std::size_t experiments() const { return first.size() - 1; }
};

// Evaluation with V of each experiment written out.
class DenseReml {
public:
  // covariance(e): V of an experiment. `precision`: diagonal of T^-1, 0 of a free coefficient. What
  // `rows` refers to must outlive the object.
  DenseReml(const RemlRows& rows, const std::function<Eigen::MatrixXd(std::size_t)>& covariance,
            Eigen::VectorXd precision);

  double criterion() const { return solution_.criterion; }
  const Eigen::VectorXd& coefficients() const { return coefficients_; }
  // The coefficients fitted without one experiment, at the same variances.
  Eigen::VectorXd without(std::size_t experiment) const;

  // Derivative G of the criterion by V of one experiment: if V changes by dV, the criterion changes
  // by the sum of the products of G and dV.
  Eigen::MatrixXd slope(std::size_t experiment) const;
  // Derivatives of the criterion by the logarithm of each coefficient's standard deviation.
  Eigen::VectorXd ridge_slopes() const;

private:
  struct Weighted {
    Eigen::MatrixXd inverse; // V^-1
    Eigen::MatrixXd design;  // V^-1 A
  };
  auto design(std::size_t e) const {
    return rows_.design.middleRows(rows_.first[e], rows_.first[e + 1] - rows_.first[e]);
  }
  auto y(std::size_t e) const {
    return rows_.y.segment(rows_.first[e], rows_.first[e + 1] - rows_.first[e]);
  }
  RestrictedSums sums(const std::function<Eigen::MatrixXd(std::size_t)>& covariance);

  RemlRows rows_;
  Eigen::VectorXd precision_;
  std::vector<Weighted> weighted_; // per experiment
  RestrictedSums sums_;
  RestrictedSolution solution_;
  Eigen::VectorXd coefficients_;
};

// Normal prior of the logarithms, added to the criterion: so wide that it decides only where the
// data say nothing.
struct LogPrior {
  std::vector<double> centre;
  double precision = 0; // 1/variance of a logarithm

  double operator()(std::span<const double> logs, std::span<double> gradient = {}) const;
};

struct LogSearch {
  std::vector<double> low, high; // bounds of the logarithms
  LogPrior prior;
  // true: SLSQP, few evaluations of a smooth criterion. false: BOBYQA, which needs none and does
  // not end early on the flat parts of a criterion.
  bool has_gradient = false;
  double first_step = 0; // of a logarithm; 0: by NLopt
  double tolerance = 0;  // of the criterion
  double log_tolerance = 0;
  int most_evaluations = 0;
};

// Returns the criterion at `logs` without the prior and, where the search has a gradient, writes
// it.
using Criterion = std::function<double(std::span<const double> logs, std::span<double> gradient)>;

struct LogMinimum {
  std::vector<double> logs;
  double criterion = 0; // with the prior
  std::size_t evaluations = 0;
};

LogMinimum least_criterion(const Criterion& criterion, std::vector<double> start,
                           const LogSearch& search);

} // namespace frictab::stats
