// Gain of a test: how far its friction as a whole lies from a law. Scatter of gains between tests,
// and their shift from training to validation tests.
#pragma once

#include <span>

#include "trace/search/search.h"

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

// Tests whether the validation tests as a whole lie higher or lower than the training tests,
// relative to that rival: the difference of the mean gains, with a standard error that includes the
// scatter of the tests and the uncertainty of the fitted parameters.
ValidationShift validation_shift_of(const Search& search, const Rival& rival);
// The same from gains; `freedom`: number of parameters fitted to `seen`. Fills only the shares and
// the p-value.
ValidationShift shift_of(const TestGains& seen, const TestGains& unseen, double freedom);

// Fills noise_floor, scatter_between, its interval and lower bound, and repeatability where tests
// were repeated. The floor is the RMSE that the noise model expects of an exact law, and the
// corresponding MAE by the ratio that the residuals have: if nothing else is missing, no law has a
// smaller error. It is capped at the calibrated law's RMSE, corrected for the degrees of freedom.
void add_scatter(Trace& trace, const Search& search, const Rival& last);

} // namespace frictab::trace
