// What the polynomial is fitted to: few bins per experiment, cut where the states change.
//
// Rows of an experiment are so alike that they are one observation many times over. An experiment
// is cut in two where that takes most off the scatter of its scaled states within parts, then the
// part that gains most, and so on (a regression tree of the states over the rows: Breiman et al.
// 1984). A run-in or a step of velocity so gets short bins and the steady stroke long ones; states
// that only scatter give bins of about equal length.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/dataset.h"
#include "models/law.h"
#include "models/polynomial.h"

namespace frictab::calibrate {

struct PolynomialBins {
  std::vector<models::PolynomialState> states; // of those named, the ones that vary
  Eigen::MatrixXd z;                           // bins x states, -1 to 1
  Eigen::VectorXd ln_mu;                       // logarithm of mean measured tau_R over mean sigma_n
  Eigen::VectorXd stress;                      // mean sigma_n, MPa
  Eigen::VectorXd limit;    // shear yield stress k, MPa; infinity without the shear limit
  Eigen::VectorXd position; // middle of the bin, -1/2 to 1/2 over the rows of its experiment
  Eigen::VectorXd rows;
  std::vector<Eigen::Index> first;  // of each experiment that has bins, and the end
  std::size_t without_load = 0;     // rows that have no coefficient
  std::size_t without_friction = 0; // bins whose mean stress is not above zero, or hardly

  std::size_t experiments() const { return first.size() - 1; }
};

// `names`: states that vary.
PolynomialBins polynomial_bins(const std::vector<std::string>& names, const data::Dataset& data,
                               const models::Conventions& conventions);

} // namespace frictab::calibrate
