// Gain of a test: how far its friction as a whole lies from a law.
#pragma once

#include <span>

#include "data/dataset.h"
#include "trace/basics.h"

namespace frictab::trace {

// Mean of ln(measured / law) over the rows of each test, and the variance of that mean, estimated
// from means of at most ten parts of the test.
struct TestGains {
  VectorXd gain;
  VectorXd variance;
};
TestGains test_gains(const data::Dataset& data, std::span<const double> predicted);

// Variance between tests beyond `variance` (Paule and Mandel 1982); 0: none. `known`: tests x
// directions that explain part of the scatter.
double scatter_between(const VectorXd& gain, const VectorXd& variance, const MatrixXd& known);

} // namespace frictab::trace
