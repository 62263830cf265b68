// Standard error of a law's stress at any state from the covariance of its parameters, by the delta
// method: u^2 = g' V g with g = d tau/d p. The shear limit is ignored, because where it begins
// depends on the law.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "expr/program.h"
#include "models/law.h"

namespace frictab::calibrate {

// Relative standard error below which a law is followed beyond the tests: with 95 % it is then
// within a factor of about 1.4. That is about the error of a coefficient clamped at the nearest
// test where the pressure falls to a tenth (the published exponent of wzl is -0.154: 10^0.154 =
// 1.4); a less certain law predicts worse than that coefficient.
inline constexpr double allowed_error = 0.2;

class StressError {
public:
  // `inputs`: those of the model's law, and any others.
  StressError(const models::Model& model, const std::vector<std::string>& inputs);

  // Whether the model has a covariance.
  bool known() const { return known_; }
  // Returns the derivatives of ln tau_R by the parameters at a state, in the order of `inputs`;
  // none if the law has no stress there.
  std::optional<Eigen::VectorXd> slope(std::span<const double> state) const;
  // Covariance of a quantity that changes with `slope` with each parameter, and its standard error.
  // NaN if it depends on a parameter without a known error (at a bound, determined by one
  // experiment).
  Eigen::VectorXd with(const Eigen::VectorXd& slope) const;
  double of(const Eigen::VectorXd& slope) const;
  // Standard error at a state, relative to the stress; none if not known.
  std::optional<double> at(std::span<const double> state) const;

private:
  std::vector<double> parameters_;
  Eigen::MatrixXd covariance_;
  bool known_ = false;
  expr::Program program_; // of inputs and parameters
};

} // namespace frictab::calibrate
