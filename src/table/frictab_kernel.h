/* Multilinear interpolation on a rectangular grid, C99, no allocation, no state, thread-safe.
 *
 * This one text is compiled into frictab and copied into every generated C source, so that what
 * was verified is what runs. Everything is inlined: where the axes are constants, sizes, strides
 * and searches become constants of the code. Corners are read as pairs of neighbours on the last
 * axis, in vectors where the compiler has them; the bits are the same without (FT_PLAIN).
 * Outside the grid the nearest edge is used (clamped) and reported; NaN in gives NaN out. Compile
 * without -ffast-math and with -ffp-contract=off. */
#ifndef FRICTAB_KERNEL_H
#define FRICTAB_KERNEL_H

#include <math.h>
#if defined(__AVX__) && !defined(FT_PLAIN)
#include <immintrin.h>
#elif defined(__SSE2__) && !defined(FT_PLAIN)
#include <emmintrin.h>
#endif

#define FT_MAX_AXES 8

#if defined(__GNUC__)
#define FT_INLINE static inline __attribute__((always_inline, unused))
#else
#define FT_INLINE static inline
#endif

/* One axis: n >= 2 ascending nodes u in the axis coordinate (x, or ln x where the axis is
 * logarithmic), and per cell 1/(u[i + 1] - u[i]). How a cell is found (the same one each way):
 * scale > 0: (int)(u * scale - shift) is the cell or one below it, or where there is a guide, the
 * position in it of such a cell; scale = 0: by bisection. */
typedef struct {
  int n;
  long stride; /* of the values along this axis */
  const double* u;
  const double* per_cell;
  double scale, shift;
  const unsigned short* guide;
} ft_axis;

/* Values, row-major, last axis fastest; one of the two is null. Arithmetic is double in either. */
typedef struct {
  const double* f64;
  const float* f32;
} ft_values;

/* NaN in either operand gives NaN. The comparison stands alone, so that it becomes an instruction
 * instead of a branch: which side of a kink a state lies on is hard to predict. */
FT_INLINE double ft_min(double a, double b) {
  const double least = b < a ? b : a;
  return b != b ? b : least;
}
FT_INLINE double ft_max(double a, double b) {
  const double most = b > a ? b : a;
  return b != b ? b : most;
}
FT_INLINE double ft_where_le(double a, double b, double x, double y) {
  if (a != a) return a;
  if (b != b) return b;
  return a <= b ? x : y;
}

/* Coordinate of a logarithmic axis; zero and negative values lie below every axis. */
FT_INLINE double ft_log(double x) {
  return isgreater(x, 0.0) ? log(x) : (x == x ? -HUGE_VAL : x);
}

/* Two numbers. */
#if defined(__GNUC__) && !defined(FT_PLAIN)
typedef double ft_pair __attribute__((vector_size(16)));
FT_INLINE ft_pair ft_pair_of(double a, double b) {
  const ft_pair p = {a, b};
  return p;
}
FT_INLINE double ft_get(ft_pair p, int i) {
  return p[i];
}
FT_INLINE ft_pair ft_plus(ft_pair a, ft_pair b) {
  return a + b;
}
FT_INLINE ft_pair ft_minus(ft_pair a, ft_pair b) {
  return a - b;
}
FT_INLINE ft_pair ft_times(double w, ft_pair a) {
  return w * a;
}
#else
typedef struct {
  double of[2];
} ft_pair;
FT_INLINE ft_pair ft_pair_of(double a, double b) {
  ft_pair p;
  p.of[0] = a;
  p.of[1] = b;
  return p;
}
FT_INLINE double ft_get(ft_pair p, int i) {
  return p.of[i];
}
FT_INLINE ft_pair ft_plus(ft_pair a, ft_pair b) {
  return ft_pair_of(a.of[0] + b.of[0], a.of[1] + b.of[1]);
}
FT_INLINE ft_pair ft_minus(ft_pair a, ft_pair b) {
  return ft_pair_of(a.of[0] - b.of[0], a.of[1] - b.of[1]);
}
FT_INLINE ft_pair ft_times(double w, ft_pair a) {
  return ft_pair_of(w * a.of[0], w * a.of[1]);
}
#endif

FT_INLINE ft_pair ft_load(ft_values v, long at) {
  if (!v.f32) return ft_pair_of(v.f64[at], v.f64[at + 1]);
#if defined(__SSE2__) && !defined(FT_PLAIN)
  return (ft_pair)_mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64((const __m128i*)(v.f32 + at))));
#else
  return ft_pair_of(v.f32[at], v.f32[at + 1]);
#endif
}

/* Between a and b, exact at both. */
FT_INLINE double ft_between(double w, double a, double b) {
  return (1.0 - w) * a + w * b;
}
FT_INLINE ft_pair ft_mix(double w, ft_pair a, ft_pair b) {
  return ft_plus(ft_times(1.0 - w, a), ft_times(w, b));
}

/* The cell of u, u[0] < u < u[n - 1]. */
FT_INLINE int ft_cell(const ft_axis* axis, double u) {
  const double* x = axis->u;
  int i = 0, high = axis->n - 1;
  if (axis->n == 2) return 0;
  if (axis->scale > 0.0) {
    i = (int)(u * axis->scale - axis->shift);
    if (axis->guide) i = axis->guide[i];
    while (u >= x[i + 1])
      ++i;
    return i;
  }
  while (high - i > 1) {
    const int middle = (i + high) / 2;
    if (x[middle] <= u)
      i = middle;
    else
      high = middle;
  }
  return i;
}

/* The cell of u and the weight of its upper node. Returns 1 where u lies outside the axis. */
FT_INLINE int ft_locate(const ft_axis* axis, double u, int* cell, double* weight) {
  const double* x = axis->u;
  const int last = axis->n - 1;
  if (isgreater(u, x[0]) && isless(u, x[last])) {
    const int i = ft_cell(axis, u);
    *cell = i;
    *weight = (u - x[i]) * axis->per_cell[i];
    return 0;
  }
  *cell = 0;
  *weight = u;
  if (u != u) return 0;
  *weight = 0.0;
  if (u <= x[0]) return u < x[0];
  *cell = last - 1;
  *weight = 1.0;
  return u > x[last];
}

/* Where n axes are read: first corner, cells and weights, bits of clamped axes. */
typedef struct {
  double w[FT_MAX_AXES];
  int cell[FT_MAX_AXES];
  long at;
  unsigned outside;
} ft_location;

FT_INLINE void ft_locate_0(const ft_axis* axis, const double* u, ft_location* found) {
  (void)axis;
  (void)u;
  found->at = 0;
  found->outside = 0u;
}
#define FT_LOCATE(N, D)                                                                            \
  FT_INLINE void ft_locate_##N(const ft_axis* axis, const double* u, ft_location* found) {         \
    ft_locate_##D(axis, u, found);                                                                 \
    if (ft_locate(axis + D, u[D], &found->cell[D], &found->w[D])) found->outside |= 1u << D;       \
    found->at += found->cell[D] * axis[D].stride;                                                  \
  }
FT_LOCATE(1, 0)
FT_LOCATE(2, 1)
FT_LOCATE(3, 2)
FT_LOCATE(4, 3)
FT_LOCATE(5, 4)
FT_LOCATE(6, 5)
FT_LOCATE(7, 6)
FT_LOCATE(8, 7)

/* Along all of N axes but the last: the pair that is left on that one. Up to 5 axes, 16 pairs, are
 * unrolled; further ones are loops, so that the code stays small. */
FT_INLINE ft_pair ft_corners_1(const ft_axis* axis, const double* w, ft_values v, long at) {
  (void)axis;
  (void)w;
  return ft_load(v, at);
}
#define FT_CORNERS(N, D)                                                                           \
  FT_INLINE ft_pair ft_corners_##N(const ft_axis* axis, const double* w, ft_values v, long at) {   \
    return ft_mix(w[0], ft_corners_##D(axis + 1, w + 1, v, at),                                    \
                  ft_corners_##D(axis + 1, w + 1, v, at + axis->stride));                          \
  }
FT_CORNERS(2, 1)
FT_CORNERS(3, 2)
FT_CORNERS(4, 3)
FT_CORNERS(5, 4)
#define FT_CORNERS_LOOP(N, D)                                                                      \
  FT_INLINE ft_pair ft_corners_##N(const ft_axis* axis, const double* w, ft_values v, long at) {   \
    ft_pair end[2];                                                                                \
    int j;                                                                                         \
    for (j = 0; j < 2; ++j)                                                                        \
      end[j] = ft_corners_##D(axis + 1, w + 1, v, at + j * axis->stride);                          \
    return ft_mix(w[0], end[0], end[1]);                                                           \
  }
FT_CORNERS_LOOP(6, 5)
FT_CORNERS_LOOP(7, 6)
FT_CORNERS_LOOP(8, 7)

/* ft_linear_N: the value at u, one coordinate per axis. Bit d of *outside is set where axis d was
 * clamped (outside may be null). */
#define FT_LINEAR(N, LAST)                                                                         \
  FT_INLINE double ft_linear_##N(const ft_axis* axis, ft_values v, const double* u,                \
                                 unsigned* outside) {                                              \
    ft_location found;                                                                             \
    ft_pair ends;                                                                                  \
    ft_locate_##N(axis, u, &found);                                                                \
    if (outside) *outside = found.outside;                                                         \
    ends = ft_corners_##N(axis, found.w, v, found.at);                                             \
    return ft_between(found.w[LAST], ft_get(ends, 0), ft_get(ends, 1));                            \
  }
FT_LINEAR(1, 0)
FT_LINEAR(2, 1)
FT_LINEAR(3, 2)
FT_LINEAR(4, 3)
FT_LINEAR(5, 4)
FT_LINEAR(6, 5)
FT_LINEAR(7, 6)
FT_LINEAR(8, 7)

#endif
