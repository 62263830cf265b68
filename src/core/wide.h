// Loops compiled twice: for any x86-64, and for one with AVX2, chosen when the program starts. Only
// for element-wise arithmetic and sums of fixed order, where the width of a register changes the
// speed but no bit (AVX2 without FMA; -ffp-contract=off).
#pragma once

// Sanitizers run before the choice can be made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FRICTAB_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define FRICTAB_WIDE
#endif

// For what such a loop is made of: only what is inlined into it is compiled twice.
#if defined(__GNUC__)
#define FRICTAB_INLINE __attribute__((always_inline)) inline
#else
#define FRICTAB_INLINE inline
#endif
