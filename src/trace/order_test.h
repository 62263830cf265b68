// Is there structure along the order of tests? Drift, wear and batch look alike there, so that none
// of them is named.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "trace/noise.h"

namespace frictab::trace {

// One score per experiment: how far its friction as a whole lies from the law, in units of its
// standard deviation under the noise model.
Eigen::VectorXd experiment_scores(const Eigen::VectorXd& residual,
                                  const Eigen::VectorXd& sensitivity, const Eigen::MatrixXd& fitted,
                                  const Whitener& whitener, std::span<const std::size_t> first);

// "The scores have no structure along the order": tests up to six apart are alike, a
// cumulated sum that strays, or slow waves; the smallest of the three and of all columns of scores
// (experiments x ways in which friction may differ), its distribution by permutation.
struct OrderTest {
  double p_value = 1;
  Eigen::Index column = 0; // of the scores, in which slow waves are the largest
};
OrderTest test_order(const Eigen::MatrixXd& scores, std::span<const double> order,
                     std::size_t permutations, std::uint64_t seed);

// Position of each experiment in the order: 0, 1, 2, ...
std::vector<std::size_t> ranks(std::span<const double> order);

// Slow functions of the order (cosines of the rank), per experiment; each has mean 0.
Eigen::MatrixXd order_functions(std::span<const double> order, int count);

// Per block of each experiment: sensitivity times the functions.
Eigen::MatrixXd functions_on_blocks(const Eigen::MatrixXd& functions,
                                    const Eigen::VectorXd& sensitivity,
                                    std::span<const std::size_t> first);

} // namespace frictab::trace
