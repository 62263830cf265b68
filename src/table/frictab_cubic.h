/* Tensor-product cubic spline on a rectangular grid, C99, no allocation, no state, thread-safe.
 *
 * Stands behind frictab_kernel.h, here and in every generated C source of a cubic table. */
#ifndef FRICTAB_CUBIC_H
#define FRICTAB_CUBIC_H

/* One axis: its nodes; per cell the first of the min(n, 4) coefficients that act there, and the
 * polynomials in the cell's weight t that multiply them: 16 numbers, the powers of t one after the
 * other, 4 coefficients each (0 for those an axis of 2 or 3 nodes does not have). */
typedef struct {
  ft_axis nodes;
  const int* first;
  const double* basis;
} ft_spline_axis;

/* Four numbers, for as many coefficients along the last axis. */
#if defined(__AVX__) && defined(__GNUC__) && !defined(FT_PLAIN)
typedef double ft_quad __attribute__((vector_size(32)));
FT_INLINE ft_quad ft_zero4(void) {
  const ft_quad q = {0.0, 0.0, 0.0, 0.0};
  return q;
}
FT_INLINE ft_quad ft_load4(ft_values v, long at) {
  return v.f32 ? (ft_quad)_mm256_cvtps_pd(_mm_loadu_ps(v.f32 + at))
               : (ft_quad)_mm256_loadu_pd(v.f64 + at);
}
FT_INLINE ft_quad ft_plus4(ft_quad a, ft_quad b) {
  return a + b;
}
FT_INLINE ft_quad ft_times4(double w, ft_quad a) {
  return w * a;
}
FT_INLINE double ft_get4(ft_quad q, int i) {
  return q[i];
}
#else
typedef struct {
  ft_pair of[2];
} ft_quad;
FT_INLINE ft_quad ft_quad_of(ft_pair a, ft_pair b) {
  ft_quad q;
  q.of[0] = a;
  q.of[1] = b;
  return q;
}
FT_INLINE ft_quad ft_zero4(void) {
  return ft_quad_of(ft_pair_of(0.0, 0.0), ft_pair_of(0.0, 0.0));
}
FT_INLINE ft_quad ft_load4(ft_values v, long at) {
  return ft_quad_of(ft_load(v, at), ft_load(v, at + 2));
}
FT_INLINE ft_quad ft_plus4(ft_quad a, ft_quad b) {
  return ft_quad_of(ft_plus(a.of[0], b.of[0]), ft_plus(a.of[1], b.of[1]));
}
FT_INLINE ft_quad ft_times4(double w, ft_quad a) {
  return ft_quad_of(ft_times(w, a.of[0]), ft_times(w, a.of[1]));
}
FT_INLINE double ft_get4(ft_quad q, int i) {
  return ft_get(q.of[i / 2], i % 2);
}
#endif

FT_INLINE double ft_dot4(const double* w, ft_quad x) {
  return (w[0] * ft_get4(x, 0) + w[1] * ft_get4(x, 1)) +
         (w[2] * ft_get4(x, 2) + w[3] * ft_get4(x, 3));
}

FT_INLINE int ft_support_size(const ft_spline_axis* axis) {
  return axis->nodes.n < 4 ? axis->nodes.n : 4;
}

/* The support of a state on N axes, which is the coefficients whose splines are not zero there: the
 * first of them, and per axis the weights of its 2 to 4. */
typedef struct {
  double w[FT_MAX_AXES][4];
  double t[FT_MAX_AXES]; /* weight of the cell's upper node */
  int cell[FT_MAX_AXES];
  long at;
  unsigned outside;
} ft_support;

FT_INLINE void ft_support_0(const ft_spline_axis* axis, const double* u, ft_support* support) {
  (void)axis;
  (void)u;
  support->at = 0;
  support->outside = 0u;
}
#define FT_SUPPORT_WEIGHT(D, J)                                                                    \
  support->w[D][J] =                                                                               \
      b[J] + support->t[D] * (b[4 + J] + support->t[D] * (b[8 + J] + support->t[D] * b[12 + J]));
#define FT_SUPPORT(N, D)                                                                           \
  FT_INLINE void ft_support_##N(const ft_spline_axis* axis, const double* u,                       \
                                ft_support* support) {                                             \
    const double* b;                                                                               \
    ft_support_##D(axis, u, support);                                                              \
    if (ft_locate(&axis[D].nodes, u[D], &support->cell[D], &support->t[D]))                        \
      support->outside |= 1u << D;                                                                 \
    b = axis[D].basis + 16 * support->cell[D];                                                     \
    support->at += axis[D].first[support->cell[D]] * axis[D].nodes.stride;                         \
    FT_SUPPORT_WEIGHT(D, 0)                                                                        \
    FT_SUPPORT_WEIGHT(D, 1) FT_SUPPORT_WEIGHT(D, 2) FT_SUPPORT_WEIGHT(D, 3)                        \
  }
FT_SUPPORT(1, 0)
FT_SUPPORT(2, 1)
FT_SUPPORT(3, 2)
FT_SUPPORT(4, 3)
FT_SUPPORT(5, 4)
FT_SUPPORT(6, 5)
FT_SUPPORT(7, 6)
FT_SUPPORT(8, 7)

/* Along the first of `axis`: sum over its support of w[j] times the 4 coefficients there. */
FT_INLINE ft_quad ft_rows(const ft_spline_axis* axis, const double* w, ft_values v, long at) {
  const long step = axis->nodes.stride;
  const int n = axis->nodes.n;
  ft_quad sum = ft_plus4(ft_times4(w[0], ft_load4(v, at)), ft_times4(w[1], ft_load4(v, at + step)));
  if (n == 3) sum = ft_plus4(sum, ft_times4(w[2], ft_load4(v, at + 2 * step)));
  if (n > 3)
    sum = ft_plus4(sum, ft_plus4(ft_times4(w[2], ft_load4(v, at + 2 * step)),
                                 ft_times4(w[3], ft_load4(v, at + 3 * step))));
  return sum;
}

/* Along all of N axes but the last: what is left on that one. Three axes, 16 rows of 4, are
 * unrolled; the others are loops, so that the code stays in the processor's cache of code. */
typedef const double (*ft_weights)[4];
FT_INLINE ft_quad ft_sum_1(const ft_spline_axis* axis, ft_weights w, ft_values v, long at) {
  (void)axis;
  (void)w;
  return ft_load4(v, at);
}
FT_INLINE ft_quad ft_sum_2(const ft_spline_axis* axis, ft_weights w, ft_values v, long at) {
  return ft_rows(axis, w[0], v, at);
}
FT_INLINE ft_quad ft_sum_3(const ft_spline_axis* axis, ft_weights w, ft_values v, long at) {
  const long step = axis->nodes.stride;
  ft_quad sum = ft_plus4(ft_zero4(), ft_times4(w[0][0], ft_sum_2(axis + 1, w + 1, v, at)));
  sum = ft_plus4(sum, ft_times4(w[0][1], ft_sum_2(axis + 1, w + 1, v, at + step)));
  if (axis->nodes.n > 2)
    sum = ft_plus4(sum, ft_times4(w[0][2], ft_sum_2(axis + 1, w + 1, v, at + 2 * step)));
  if (axis->nodes.n > 3)
    sum = ft_plus4(sum, ft_times4(w[0][3], ft_sum_2(axis + 1, w + 1, v, at + 3 * step)));
  return sum;
}
#define FT_SUM(N, D)                                                                               \
  FT_INLINE ft_quad ft_sum_##N(const ft_spline_axis* axis, ft_weights w, ft_values v, long at) {   \
    ft_quad sum = ft_zero4();                                                                      \
    int j;                                                                                         \
    for (j = 0; j < ft_support_size(axis); ++j, at += axis->nodes.stride)                          \
      sum = ft_plus4(sum, ft_times4(w[0][j], ft_sum_##D(axis + 1, w + 1, v, at)));                 \
    return sum;                                                                                    \
  }
FT_SUM(4, 3)
FT_SUM(5, 4)
FT_SUM(6, 5)
FT_SUM(7, 6)
FT_SUM(8, 7)

/* ft_cubic_N: as ft_linear_N. v: coefficients, and 2 zeros behind the last one (4 are read along an
 * axis of 2 or 3 nodes as well). */
#define FT_CUBIC(N, LAST)                                                                          \
  FT_INLINE double ft_cubic_##N(const ft_spline_axis* axis, ft_values v, const double* u,          \
                                unsigned* outside) {                                               \
    ft_support support;                                                                            \
    ft_support_##N(axis, u, &support);                                                             \
    if (outside) *outside = support.outside;                                                       \
    return ft_dot4(support.w[LAST], ft_sum_##N(axis, (ft_weights)support.w, v, support.at));       \
  }
FT_CUBIC(1, 0)
FT_CUBIC(2, 1)
FT_CUBIC(3, 2)
FT_CUBIC(4, 3)
FT_CUBIC(5, 4)
FT_CUBIC(6, 5)
FT_CUBIC(7, 6)
FT_CUBIC(8, 7)

#endif
