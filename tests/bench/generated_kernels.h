// Kernels as a user has them: a table is exported, compiled by the recipe's command and loaded.
#pragma once

#include <memory>

#include "codegen/compile.h"
#include "table/table.h"

namespace frictab::bench {

// Values at random on [0, 1]^n, given back as they are; nodes even, or denser at the lower end.
table::Table random_table(const std::vector<std::size_t>& counts, bool even, bool cubic);

// The generated C file, to which is added what it does not offer itself: derivatives, values in
// single precision, a textbook's nested loop over the same numbers.
class CKernel {
public:
  // `flags` behind those of the recipe: "-march=native".
  explicit CKernel(const table::Table& table, const std::vector<std::string>& flags = {});
  double (*value)(const double* u);
  double (*single)(const double* u);
  double (*gradient)(const double* u, double* by_u);
  double (*nested)(const double* u);
  double (*tau)(double sigma_n, double psi, double v, double T, double s, double sigma_f);

private:
  TemporaryDirectory directory_;
  std::unique_ptr<codegen::Library> library_;
};

// The generated Fortran core: what looks the table up, and the same with derivatives (flag: true).
class FortranKernel {
public:
  // `gradient`: a core that has ftgrad; its value then comes out of the same routine.
  explicit FortranKernel(const table::Table& table, bool gradient = false);
  double (*value)(const double* u);
  void (*gradient)(const double* u, double* value, double* by_u, const int* flag) = nullptr;

private:
  TemporaryDirectory directory_;
  std::unique_ptr<codegen::Library> library_;
};

// The entries for many states of a target with the contract's interface.
class BatchEntries {
public:
  BatchEntries(const table::Table& table, const std::string& target);
  using Array = const double*;
  void (*value)(std::size_t, Array, Array, Array, Array, Array, Array, double*);
  void (*gradient)(std::size_t, Array, Array, Array, Array, Array, Array, double*, double*);

private:
  TemporaryDirectory directory_;
  std::unique_ptr<codegen::Library> library_;
};

// For kernels_against_scipy.py: 210,681 nodes on arbitrary axes as table.json, and the C bundle.
void write_generated(const std::filesystem::path& directory);

} // namespace frictab::bench
