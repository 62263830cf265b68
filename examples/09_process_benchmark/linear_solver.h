// A direct solver for GetFEM's sparse matrices: Eigen's LU. (Debian's GetFEM offers MUMPS without
// the file to link with.)
#pragma once

#include <vector>

#include <getfem/getfem_models.h>

// K x = right, with x = 0 where `fixed` (empty: nowhere). Throws std::runtime_error if K is
// singular.
void solve(const getfem::model_real_sparse_matrix& K, const getfem::model_real_plain_vector& right,
           const std::vector<bool>& fixed, getfem::model_real_plain_vector& x);
