// Gram matrix J'J of a tall matrix.
#pragma once

#include <Eigen/Core>

namespace frictab::stats {

// Returns columns' columns, symmetric. Takes half of the products of a general matrix product, in
// registers as wide as the machine's; sums have a fixed order, so the bits are the same on every
// machine. For tall matrices: the columns of a part of 512 rows should fit into the cache.
Eigen::MatrixXd gram(const Eigen::Ref<const Eigen::MatrixXd>& columns);

} // namespace frictab::stats
