// Data of the polynomial: few bins per experiment, cut where the states change.
//
// Rows of an experiment are so alike that they amount to repeated copies of one observation. An
// experiment is cut in two where the cut reduces the scatter of its scaled states within parts
// most, then the part that gains most, and so on (a regression tree of the states over the rows:
// Breiman et al. 1984). A run-in or a step of velocity thus gets short bins and the steady stroke
// long ones; states that only scatter give bins of about equal length.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/dataset.h"
#include "models/law.h"
#include "models/polynomial.h"

namespace frictab::calibrate {

struct PolynomialBins {
  std::vector<models::PolynomialState> states; // the given states that vary
  Eigen::MatrixXd z;                           // bins x states, -1 to 1
  Eigen::VectorXd ln_mu;                       // logarithm of mean measured tau_R over mean sigma_n
  Eigen::VectorXd stress;                      // mean sigma_n, MPa
  Eigen::VectorXd limit;    // shear yield stress k, MPa; infinity without the shear limit
  Eigen::VectorXd position; // middle of the bin, -1/2 to 1/2 over the rows of its experiment
  Eigen::VectorXd rows;
  // first bin of each experiment that has any; last, the number of bins
  std::vector<Eigen::Index> first;
  std::size_t without_load = 0;     // rows without a friction coefficient
  std::size_t without_friction = 0; // bins whose mean stress is at most slightly above zero

  std::size_t experiments() const { return first.size() - 1; }
};

// Cuts the experiments. `names`: states that vary.
PolynomialBins polynomial_bins(const std::vector<std::string>& names, const data::Dataset& data,
                               const models::Conventions& conventions);

} // namespace frictab::calibrate
