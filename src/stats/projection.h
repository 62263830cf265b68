// Linear algebra shared by the tests of the trace stage: bases of fitted directions, to be
// projected out of tested ones.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace frictab::stats {

// Returns an orthonormal basis Q of the span of the columns (QR with column pivoting), so that x -
// Q (Q' x) is the part of x orthogonal to them. Columns that are combinations of others, to 1e-7 of
// their length, are left out.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

// Appends the columns of `more` to `to`.
void append_columns(Eigen::MatrixXd& to, const Eigen::MatrixXd& more);

// Returns the products of each column of `a` with each of `b`; those of the first column of `a`
// come first.
Eigen::MatrixXd products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// Root mean square over rows of the length of a row.
template <class Columns> double root_mean_square(const Columns& columns) {
  return columns.norm() / std::sqrt(static_cast<double>(columns.rows()));
}

// Scales to mean 0 and mean square 1; returns false, and leaves zeros, if the values do not vary.
bool standardise(Eigen::VectorXd& values);

} // namespace frictab::stats
