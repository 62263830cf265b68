// Bases by QR with column pivoting.
#include "stats/projection.h"

#include <Eigen/QR>

namespace frictab::stats {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd orthonormal(const MatrixXd& columns) {
  if (columns.cols() == 0) return columns; // Eigen does not decompose empty matrices
  MatrixXd scaled = columns;
  for (Index c = 0; c < scaled.cols(); ++c)
    if (const double norm = scaled.col(c).norm(); norm > 0) scaled.col(c) /= norm;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(scaled);
  qr.setThreshold(1e-7);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

void append_columns(MatrixXd& to, const MatrixXd& more) {
  const Index before = to.cols();
  if (more.cols() == 0) return;
  to.conservativeResize(more.rows(), before + more.cols());
  to.rightCols(more.cols()) = more;
}

MatrixXd products(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd all(a.rows(), a.cols() * b.cols());
  for (Index i = 0; i < a.cols(); ++i)
    all.middleCols(i * b.cols(), b.cols()) = b.array().colwise() * a.col(i).array();
  return all;
}

bool standardise(Eigen::VectorXd& values) {
  values.array() -= values.mean();
  const double size = root_mean_square(values);
  if (size > 0) values /= size;
  return size > 0;
}

} // namespace frictab::stats
