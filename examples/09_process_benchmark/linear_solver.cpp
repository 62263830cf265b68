#include "linear_solver.h"

#include <stdexcept>

#include <Eigen/SparseLU>

void solve(const getfem::model_real_sparse_matrix& K, const getfem::model_real_plain_vector& right,
           const std::vector<bool>& fixed, getfem::model_real_plain_vector& x) {
  const auto is_fixed = [&](std::size_t i) { return !fixed.empty() && fixed[i]; };
  const auto n = static_cast<int>(right.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd b(n);
  for (std::size_t column = 0; column < right.size(); ++column) {
    const auto c = static_cast<int>(column);
    b[c] = is_fixed(column) ? 0 : right[column];
    if (is_fixed(column)) {
      entries.emplace_back(c, c, 1);
      continue;
    }
    const auto& values = gmm::mat_const_col(K, column);
    for (auto i = gmm::vect_const_begin(values); i != gmm::vect_const_end(values); ++i)
      if (!is_fixed(i.index())) entries.emplace_back(static_cast<int>(i.index()), c, *i);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
  if (lu.info() != Eigen::Success) throw std::runtime_error("the matrix is singular");
  x.resize(right.size());
  Eigen::Map<Eigen::VectorXd>(x.data(), n) = lu.solve(b);
}
