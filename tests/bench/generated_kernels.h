// Kernels as a user has them: a table is exported, compiled by the recipe's command and loaded.
#pragma once

#include <memory>

#include "codegen/compile.h"
#include "table/table.h"

namespace frictab::bench {

// Values at random on [0, 1]^n, given back as they are; nodes even, or denser at the lower end.
Table random_table(const std::vector<std::size_t>& counts, bool even, bool cubic);

// The generated C file, to which is added what it does not offer itself: derivatives, values in
// single precision, a textbook's nested loop over the same numbers.
class CKernel {
public:
  // `flags` behind those of the recipe: "-march=native".
  explicit CKernel(const Table& table, const std::vector<std::string>& flags = {});
  double (*value)(const double* u);
  double (*single)(const double* u);
  double (*gradient)(const double* u, double* by_u);
  double (*nested)(const double* u);
  double (*tau)(double sigma_n, double psi, double v, double T, double s, double sigma_f);

private:
  TemporaryDirectory directory_;
  std::unique_ptr<Library> library_;
};

// The generated Fortran function that looks the table up.
class FortranKernel {
public:
  explicit FortranKernel(const Table& table);
  double (*value)(const double* u);

private:
  TemporaryDirectory directory_;
  std::unique_ptr<Library> library_;
};

// For kernels_against_scipy.py: 210,681 nodes on arbitrary axes as table.json, and the C bundle.
void write_generated(const std::filesystem::path& directory);

} // namespace frictab::bench
