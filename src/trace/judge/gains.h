// Gain of a test: how far its friction as a whole lies from a law.
#pragma once

#include <span>

#include <Eigen/Core>

#include "data/dataset.h"

namespace frictab::trace {

// Mean of ln(measured / law) over the rows of each test, and the variance of that mean, estimated
// from means of at most ten parts of the test.
struct TestGains {
  Eigen::VectorXd gain;
  Eigen::VectorXd variance;
};
TestGains test_gains(const data::Dataset& data, std::span<const double> predicted);

// Variance between tests beyond `variance` (Paule and Mandel 1982); 0: none. `known`: tests x
// directions that explain part of the scatter.
double scatter_between(const Eigen::VectorXd& gain, const Eigen::VectorXd& variance,
                       const Eigen::MatrixXd& known);

} // namespace frictab::trace
