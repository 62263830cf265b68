// Linear algebra that every test of the trace stage needs: bases of what is fitted already, so that
// it can be taken out of what is tested.
#pragma once

#include <Eigen/Core>

namespace frictab::trace {

// An orthonormal basis Q of what the columns span (QR with column pivoting): x - Q (Q' x) is what
// they leave of x. Columns that are combinations of others, to 1e-7 of their length, are left out.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

// Puts the columns of `more` behind those of `to`.
void append_columns(Eigen::MatrixXd& to, const Eigen::MatrixXd& more);

} // namespace frictab::trace
