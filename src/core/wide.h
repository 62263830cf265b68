// Loops compiled three times: for any x86-64, for AVX2 and for AVX-512; the variant is chosen at
// program start. Only for element-wise arithmetic and sums of fixed order, where the register width
// changes the speed but no bit (-ffp-contract=off: products are not fused with sums).
#pragma once

// Code of the sanitizers runs before the variant can be chosen.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FRICTAB_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FRICTAB_WIDE
#endif

// For functions called in such a loop: only inlined code is compiled for the chosen variant.
#if defined(__GNUC__)
#define FRICTAB_INLINE __attribute__((always_inline)) inline
#else
#define FRICTAB_INLINE inline
#endif
