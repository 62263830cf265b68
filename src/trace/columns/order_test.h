// Test for structure along the order of tests. It does not name a cause, because drift, wear and
// batches look alike there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stats/noise.h"
#include "trace/basics.h"

namespace frictab::trace {

// Returns one score per experiment: how far its friction as a whole lies from the law, in standard
// deviations under the noise model.
VectorXd experiment_scores(const VectorXd& residual, const VectorXd& sensitivity,
                           const MatrixXd& fitted, const stats::Whitener& whitener,
                           std::span<const std::size_t> first);

// Permutation test of the null hypothesis that the scores have no structure along the order. Three
// statistics: likeness of tests up to six apart, the excursion of the cumulated sum, and slow
// waves. The smallest p-value over statistics and columns of scores (experiments x ways in which
// friction may differ) is compared with its own permutation distribution.
struct OrderTest {
  double p_value = 1;
  Index column = 0; // column of scores with the largest slow waves
};
OrderTest test_order(const MatrixXd& scores, std::span<const double> order,
                     std::size_t permutations, std::uint64_t seed);

// Returns the position of each experiment in the order: 0, 1, 2, ...
std::vector<std::size_t> ranks(std::span<const double> order);

// Returns slow functions of the order (cosines of the rank), per experiment; each has mean 0.
MatrixXd order_functions(std::span<const double> order, int count);

// Returns sensitivity times the functions, per block of each experiment.
MatrixXd functions_on_blocks(const MatrixXd& functions, const VectorXd& sensitivity,
                             std::span<const std::size_t> first);

} // namespace frictab::trace
