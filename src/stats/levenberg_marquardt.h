// The least of a cost of many rows within bounds: Levenberg-Marquardt, with a learned correction of
// the curvature.
//
// The cost c(p) is a sum over rows of the squares of residuals, or of another loss of them. J holds
// the derivatives of the predictions by the parameters p, so that near p
//   c(p + d) = c(p) - g'd + d'(H + B)d/2,   g = -dc/dp,   H = J'J (Gauss and Newton)
// with a correction B, at first 0, for the predictions' own curvature. A step d solves the damped
// normal equations
//   (H + B + damping D) d = g,
// where D is the diagonal of H (Levenberg 1944, Marquardt 1963), which makes the path independent
// of the parameters' units. Little damping gives the step of Gauss and Newton, which converges fast
// where the quadratic holds; much damping gives a short step along the scaled gradient, which
// lowers any smooth cost. So damping falls after a step that was accepted, and grows until one is.
// * Bounds: a parameter at a bound against which g pushes it stays there. One that a step would
//   carry across its bound is fixed at it, and the step is solved again for the others.
// * Scale: a parameter marked by_logarithm is stepped by its logarithm. In C p^a the scale C and
//   the exponent a trade off against each other along a curved valley; in ln C the valley is
//   straight, so that a step can follow it.
// * Correction: H lacks the predictions' own curvature, which matters where residuals are large.
//   Close to the minimum the change of g along each step d reveals what is missing there:
//     y = -(change of g) - (H + B) d,   B <- B + y y'/(y'd)
//   (symmetric rank one, in the spirit of Dennis, Gay and Welsch 1981). B is dropped where H + B
//   has no minimum, or where B exceeds H, as it does after a kink has been crossed.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace frictab::stats {

// The cost at one set of parameters, with its gradient and curvature.
struct NormalEquations {
  double cost = 0;         // infinity where predictions are not finite, or not allowed
  Eigen::VectorXd descent; // g: minus the gradient of the cost
  Eigen::MatrixXd hessian; // H, symmetric: of a cost of half the squares, J'J
};

inline Eigen::Map<const Eigen::VectorXd> as_vector(std::span<const double> parameters) {
  return {parameters.data(), static_cast<Eigen::Index>(parameters.size())};
}

// A cost to minimise. Its two functions must agree on the cost, to rounding.
class LeastSquares {
public:
  virtual ~LeastSquares() = default;
  virtual double cost(std::span<const double> parameters) = 0;
  virtual NormalEquations normal_equations(std::span<const double> parameters) = 0;
};

struct ParameterRange {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool by_logarithm = false; // only with lower > 0
};

enum class DampingUnit {
  largest_diagonal, // of H so far (More 1978): no parameter regains its freedom where H loses sight
                    // of it for a while, as beyond a kink
  current_diagonal  // forgets a steep start
};

// The defaults are those of the fits of laws (calibrate/fit.h), which have few parameters and must
// end where another machine would.
struct LevenbergMarquardtOptions {
  // ---- the end ----
  // Share of the cost that counts as no gain. Smaller: more steps, and parameters closer to the
  // optimum than their error; 1e-10 leaves those of 44,550 rows within a hundredth of a standard
  // error.
  double tolerance = 1e-10;
  // Whether a fit ends when the undamped step promises no gain, which takes one more solution of
  // the normal equations a step. The end then does not depend on how long the last step happened to
  // be. Without it the last gains decide alone.
  bool promise_ends = true;
  // Number of accepted steps in a row that gain nothing and end the fit. More than one where
  // promises stay wrong, as near a kink, and a single short step proves little; one where the rest
  // is worth less than its time.
  int small_gains_end = 3;
  // Accepted steps, and steps tried: the second bounds the time where evaluations take long.
  std::size_t most_steps = 200, most_trials = std::numeric_limits<std::size_t>::max();
  // Cost below which only rounding is left.
  double exact_cost = 0;
  // Sees the parameters after each accepted step; the fit ends where it returns false. For stopping
  // early, by rows that are held out.
  std::function<bool(std::span<const double>)> goes_on = {};

  // ---- damping ----
  // Of the first step. Small where the start is known to be close, which saves steps; too small a
  // one costs rejected steps.
  double first_damping = 1e-3;
  DampingUnit unit = DampingUnit::largest_diagonal;
  // Factor after an accepted step. 0: by the ratio of its gain to the promised one, 0.01 where the
  // quadratic holds to 10 %, 3 where it is far off: fewest steps to a close optimum. A constant
  // keeps some damping for longer, which serves problems with flat directions: there undamped steps
  // go far.
  double fall = 0;
  // Factor after a rejected step, and the factor by which that factor itself grows from one
  // rejection to the next. Large factors find an acceptable step soon, but a shorter one than
  // necessary.
  double growth = 4, growth_of_growth = 2;
  // At least this after a rejected step, which saves the trials between a damping that is as good
  // as none and the first that shortens the step.
  double least_damping_after_rejection = 1e-6;
  // Damping whose step is so short that the fit ends if it gains nothing.
  double most_damping = 1e14;

  // ---- bounds ----
  // true: a step across bounds is clamped to them, and not solved again for the others. Takes more
  // steps, and may end next to a minimum that lies on a bound; only where results must stay.
  bool clamps_at_bounds = false;

  // ---- evaluations ----
  // Whether the first trial of a step computes derivatives with the cost: one sweep less where it
  // is accepted, as most are. false where derivatives cost many times the predictions.
  bool derivatives_at_first_trial = true;
  // Whether B is learned. Saves steps, the more the larger the residuals are; needs smooth
  // predictions, and parameters that the data determine.
  bool learns_curvature = true;
  // B of an earlier fit to similar rows, which saves the steps in which it would be learned.
  const Eigen::MatrixXd* correction = nullptr;
};

enum class FitEnding {
  no_promise,     // converged: the undamped step promises no gain
  small_gains,    // converged: the last gains were within the tolerance
  no_better_step, // converged: no step improves the cost, however short
  exact,          // converged: the cost is no more than rounding
  nothing_free,   // converged: every parameter is held by a bound or without influence
  observer,       // stopped by `goes_on`
  most_steps,     // stopped
  most_trials,    // stopped
  not_finite      // stopped: the cost is not finite at the start
};

struct LevenbergMarquardtFit {
  std::vector<double> parameters;
  double cost = 0;
  FitEnding ending = FitEnding::no_promise;
  Eigen::MatrixXd correction; // B at the end
  // false if no parameter changes any row there; derivatives that the fit had no use for are not
  // computed for it.
  bool influence = false;
};

// Fits from one start, which must lie within the ranges (one per parameter). Only rounding of the
// problem's own sums depends on the machine.
LevenbergMarquardtFit levenberg_marquardt(LeastSquares& problem,
                                          std::span<const ParameterRange> ranges,
                                          std::vector<double> start,
                                          const LevenbergMarquardtOptions& options = {});

} // namespace frictab::stats
