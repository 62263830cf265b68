// ln mu as a polynomial in scaled states, the law `polynomial` with its scatter and ridge held:
// what tests say of a process, whichever law is right. Linear in its coefficients b, so that the
// effect of other tests is known in closed form:
//   b ~ N(0, prior), y = G b + noise of covariance V per test (calibrate/polynomial_fit.h).
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calibrate/calibration.h"
#include "data/dataset.h"
#include "models/polynomial.h"

namespace frictab::process {

// States of tests or of a process: one column per state of a Smooth, rows of equal number.
using States = std::vector<std::vector<double>>;
using StateRanges = std::vector<std::pair<double, double>>; // per state

class Smooth {
public:
  // Over these states of the tests, between `ranges` (wider ones than the tests' give the prior
  // more room: the standard deviation of a coefficient grows with the range to the power of its
  // degree).
  Smooth(const calibrate::Calibration& calibration, const data::Dataset& tests,
         std::vector<std::string> names, const StateRanges& ranges);

  // Adds what no polynomial follows: bumps of ln mu at some of these states, so that no place is
  // known by tests far from it alone.
  void add_bumps(const States& states);

  Eigen::Index terms() const { return prior_.size(); }
  const Eigen::VectorXd& prior() const { return prior_; } // variances; infinite for the first

  // One row per state: terms, states held within the ranges.
  Eigen::MatrixXd design(const States& states) const;
  // The rows of one test as bins of equal numbers of rows: means of the design.
  Eigen::MatrixXd bins(const Eigen::MatrixXd& design) const;
  // V^-1 of such a test.
  const Eigen::MatrixXd& weight() const { return weight_; }
  static constexpr Eigen::Index bins_of_a_test = 8;

private:
  Eigen::MatrixXd scaled(const States& states) const; // states x rows

  std::vector<models::PolynomialState> states_;
  std::vector<models::PolynomialDegrees> terms_;
  Eigen::MatrixXd bumps_; // scaled states x bumps
  Eigen::VectorXd prior_;
  Eigen::MatrixXd weight_;
};

// States that the polynomial can use and that vary in the tests.
std::vector<std::string> smooth_states(const data::Dataset& tests);
StateRanges ranges_of(const data::Dataset& data, std::span<const std::string> names);

// Rows of one test, `most` at most and evenly spaced: their numbers in the data.
std::vector<std::size_t> some_rows(std::size_t first, std::size_t end, std::size_t most);
States states_at(const data::Dataset& data, std::span<const std::string> names,
                 std::span<const std::size_t> rows);

} // namespace frictab::process
