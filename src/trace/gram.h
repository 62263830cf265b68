// J'J of a tall matrix.
#pragma once

#include <Eigen/Core>

namespace frictab::trace {

// columns' columns, symmetric. Half of the products of a general matrix product, in registers as
// wide as the machine's; the sums have one order, so the bits are the same on every machine. For
// tall matrices: the columns of a part of 512 rows should stay in the cache.
Eigen::MatrixXd gram(const Eigen::Ref<const Eigen::MatrixXd>& columns);

} // namespace frictab::trace
