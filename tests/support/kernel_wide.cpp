// Compiled with -mavx2 where the compiler knows it (tests/CMakeLists.txt).
#define VARIANT wide_kernel_if_avx
#define VARIANT_NAME "wide"
#include "support/kernel_variant.inc"

namespace frictab::test {

const KernelVariant* wide_kernel() {
#ifdef __AVX__
  return __builtin_cpu_supports("avx2") ? &wide_kernel_if_avx : nullptr;
#else
  return nullptr;
#endif
}

} // namespace frictab::test
