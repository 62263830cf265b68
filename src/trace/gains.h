// A test's gain: how far its friction lies from a law as a whole.
#pragma once

#include <span>

#include <Eigen/Core>

#include "data/dataset.h"

namespace frictab::trace {

// Per test, the mean of ln(measured / law) over its rows, and the variance of that mean, from means
// of at most ten parts of the test.
struct TestGains {
  Eigen::VectorXd gain;
  Eigen::VectorXd variance;
};
TestGains test_gains(const data::Dataset& data, std::span<const double> predicted);

// Scatter between tests beyond what `variance` says (Paule and Mandel 1982), variance; 0: none.
// `known`: tests x directions that explain some of it.
double scatter_between(const Eigen::VectorXd& gain, const Eigen::VectorXd& variance,
                       const Eigen::MatrixXd& known);

} // namespace frictab::trace
