// Loops compiled three times: for any x86-64, and for one with AVX2 or AVX-512, chosen when the
// program starts. Only for element-wise arithmetic and sums of fixed order, where the width of a
// register changes the speed but no bit (-ffp-contract=off: no product is fused with a sum).
#pragma once

// Sanitizers run before the choice can be made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FRICTAB_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FRICTAB_WIDE
#endif

// For what such a loop is made of: only what is inlined into it is compiled so.
#if defined(__GNUC__)
#define FRICTAB_INLINE __attribute__((always_inline)) inline
#else
#define FRICTAB_INLINE inline
#endif
