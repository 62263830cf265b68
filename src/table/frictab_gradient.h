/* Value and all derivatives by the axis coordinates in one pass; the same value, bit for bit, as
 * ft_linear_N gives. C99, no allocation, no state, thread-safe. Stands behind frictab_kernel.h. */
#ifndef FRICTAB_GRADIENT_H
#define FRICTAB_GRADIENT_H

/* DO(0) ... DO(k - 1), without a loop: what they index stays in registers. */
#define FT_EACH_0(DO)
#define FT_EACH_1(DO) DO(0)
#define FT_EACH_2(DO) FT_EACH_1(DO) DO(1)
#define FT_EACH_3(DO) FT_EACH_2(DO) DO(2)
#define FT_EACH_4(DO) FT_EACH_3(DO) DO(3)
#define FT_EACH_5(DO) FT_EACH_4(DO) DO(4)
#define FT_EACH_6(DO) FT_EACH_5(DO) DO(5)
#define FT_EACH_7(DO) FT_EACH_6(DO) DO(6)
#define FT_EACH_8(DO) FT_EACH_7(DO) DO(7)

/* d weight/d u: 0 outside, where the edge's value is used; NaN for NaN. */
FT_INLINE double ft_weight_slope(const ft_axis* axis, double weight, int cell, unsigned outside) {
  if (weight != weight) return weight;
  return outside ? 0.0 : axis->per_cell[cell];
}

/* As ft_corners_N, and the derivatives by the weight of each axis but the last. */
typedef struct {
  ft_pair value, by[FT_MAX_AXES];
} ft_pair_gradient;

FT_INLINE void ft_corners_gradient_1(const ft_axis* axis, const double* w, ft_values v, long at,
                                     ft_pair_gradient* sum) {
  (void)axis;
  (void)w;
  sum->value = ft_load(v, at);
}
#define FT_CORNERS_GRADIENT_BY(i) sum->by[(i) + 1] = ft_mix(w[0], end[0].by[i], end[1].by[i]);
#define FT_CORNERS_GRADIENT_END(J, D)                                                              \
  ft_corners_gradient_##D(axis + 1, w + 1, v, at + J * axis->stride, end + J);
#define FT_CORNERS_GRADIENT_BOTH(D) FT_CORNERS_GRADIENT_END(0, D) FT_CORNERS_GRADIENT_END(1, D)
#define FT_CORNERS_GRADIENT_LOOP(D)                                                                \
  for (j = 0; j < 2; ++j)                                                                          \
  FT_CORNERS_GRADIENT_END(j, D)
#define FT_CORNERS_GRADIENT(N, D, INNER, ENDS)                                                     \
  FT_INLINE void ft_corners_gradient_##N(const ft_axis* axis, const double* w, ft_values v,        \
                                         long at, ft_pair_gradient* sum) {                         \
    ft_pair_gradient end[2];                                                                       \
    int j = 0;                                                                                     \
    (void)j;                                                                                       \
    ENDS(D)                                                                                        \
    sum->value = ft_mix(w[0], end[0].value, end[1].value);                                         \
    sum->by[0] = ft_minus(end[1].value, end[0].value);                                             \
    FT_EACH_##INNER(FT_CORNERS_GRADIENT_BY)                                                        \
  }
FT_CORNERS_GRADIENT(2, 1, 0, FT_CORNERS_GRADIENT_BOTH)
FT_CORNERS_GRADIENT(3, 2, 1, FT_CORNERS_GRADIENT_BOTH)
FT_CORNERS_GRADIENT(4, 3, 2, FT_CORNERS_GRADIENT_BOTH)
FT_CORNERS_GRADIENT(5, 4, 3, FT_CORNERS_GRADIENT_BOTH)
FT_CORNERS_GRADIENT(6, 5, 4, FT_CORNERS_GRADIENT_LOOP)
FT_CORNERS_GRADIENT(7, 6, 5, FT_CORNERS_GRADIENT_LOOP)
FT_CORNERS_GRADIENT(8, 7, 6, FT_CORNERS_GRADIENT_LOOP)

/* ft_linear_gradient_N: as ft_linear_N; by_u: one derivative per axis. */
#define FT_LINEAR_BY(i)                                                                            \
  by_u[i] = ft_between(t, ft_get(sum.by[i], 0), ft_get(sum.by[i], 1)) *                            \
            ft_weight_slope(axis + (i), found.w[i], found.cell[i], found.outside >> (i)&1u);
#define FT_LINEAR_GRADIENT(N, LAST)                                                                \
  FT_INLINE double ft_linear_gradient_##N(const ft_axis* axis, ft_values v, const double* u,       \
                                          double* by_u, unsigned* outside) {                       \
    ft_location found;                                                                             \
    ft_pair_gradient sum;                                                                          \
    double t;                                                                                      \
    ft_locate_##N(axis, u, &found);                                                                \
    if (outside) *outside = found.outside;                                                         \
    ft_corners_gradient_##N(axis, found.w, v, found.at, &sum);                                     \
    t = found.w[LAST];                                                                             \
    FT_EACH_##LAST(FT_LINEAR_BY) by_u[LAST] =                                                      \
        (ft_get(sum.value, 1) - ft_get(sum.value, 0)) *                                            \
        ft_weight_slope(axis + LAST, t, found.cell[LAST], found.outside >> LAST & 1u);             \
    return ft_between(t, ft_get(sum.value, 0), ft_get(sum.value, 1));                              \
  }
FT_LINEAR_GRADIENT(1, 0)
FT_LINEAR_GRADIENT(2, 1)
FT_LINEAR_GRADIENT(3, 2)
FT_LINEAR_GRADIENT(4, 3)
FT_LINEAR_GRADIENT(5, 4)
FT_LINEAR_GRADIENT(6, 5)
FT_LINEAR_GRADIENT(7, 6)
FT_LINEAR_GRADIENT(8, 7)

#endif
