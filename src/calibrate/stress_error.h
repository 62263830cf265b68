// The standard error of a law's stress at any state, by the covariance of its parameters: the delta
// method, u^2 = g' V g with g = d tau/d p. What the shear limit cuts off is as uncertain as if it
// did not: where the limit begins depends on the law.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "expr/program.h"
#include "models/law.h"

namespace frictab::calibrate {

// Beyond the tests a law is followed where its own standard error stays below this share of the
// stress: with 95 % it is then within a factor of 1.4 or so, which is about what a coefficient that
// is held at the nearest test is off by where the pressure falls to a tenth (the published exponent
// of wzl is -0.154: 10^0.154 = 1.4). A law that is known worse says less than that.
inline constexpr double allowed_error = 0.2;

class StressError {
public:
  // `inputs`: those of the model's law, and any others.
  StressError(const models::Model& model, const std::vector<std::string>& inputs);

  // Whether the model has a covariance.
  bool known() const { return known_; }
  // Derivatives of ln tau_R by the parameters at a state in the order of `inputs`; nothing where
  // the law has no stress there.
  std::optional<Eigen::VectorXd> slope(std::span<const double> state) const;
  // Standard error of what changes with `slope`, and its covariance with each parameter. NaN where
  // a parameter of no known error (at a bound, determined by one experiment) has a part in it.
  Eigen::VectorXd with(const Eigen::VectorXd& slope) const;
  double of(const Eigen::VectorXd& slope) const;
  // Relative to the stress. Nothing where it is not known.
  std::optional<double> at(std::span<const double> state) const;

private:
  std::vector<double> parameters_;
  Eigen::MatrixXd covariance_;
  bool known_ = false;
  expr::Program program_; // of inputs and parameters
};

} // namespace frictab::calibrate
