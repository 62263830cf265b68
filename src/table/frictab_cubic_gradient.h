/* Value and all derivatives by the axis coordinates of a spline; the same value, bit for bit, as
 * ft_cubic_N gives. Stands behind frictab_cubic.h and frictab_gradient.h. */
#ifndef FRICTAB_CUBIC_GRADIENT_H
#define FRICTAB_CUBIC_GRADIENT_H

/* Derivatives by u of the weights of axis d. */
FT_INLINE void ft_support_slopes(const ft_spline_axis* axis, const ft_support* support, int d,
                                 double* by) {
  const double* b = axis[d].basis + 16 * support->cell[d];
  const double t = support->t[d];
  const double s = ft_weight_slope(&axis[d].nodes, t, support->cell[d], support->outside >> d & 1u);
  by[0] = s * (b[4] + t * (2.0 * b[8] + t * (3.0 * b[12])));
  by[1] = s * (b[5] + t * (2.0 * b[9] + t * (3.0 * b[13])));
  by[2] = s * (b[6] + t * (2.0 * b[10] + t * (3.0 * b[14])));
  by[3] = s * (b[7] + t * (2.0 * b[11] + t * (3.0 * b[15])));
}

/* As ft_sum_N, and the derivatives by each axis but the last. s: slopes of the weights w. */
typedef struct {
  ft_quad value, by[FT_MAX_AXES];
} ft_quad_gradient;

FT_INLINE void ft_sum_gradient_1(const ft_spline_axis* axis, ft_weights w, ft_weights s,
                                 ft_values v, long at, ft_quad_gradient* sum) {
  (void)axis;
  (void)w;
  (void)s;
  sum->value = ft_load4(v, at);
}
FT_INLINE void ft_sum_gradient_2(const ft_spline_axis* axis, ft_weights w, ft_weights s,
                                 ft_values v, long at, ft_quad_gradient* sum) {
  sum->value = ft_rows(axis, w[0], v, at);
  sum->by[0] = ft_rows(axis, s[0], v, at);
}
#define FT_SUM_GRADIENT_ZERO(i) sum->by[(i) + 1] = ft_zero4();
#define FT_SUM_GRADIENT_BY(i)                                                                      \
  sum->by[(i) + 1] = ft_plus4(sum->by[(i) + 1], ft_times4(w[0][j], row.by[i]));
#define FT_SUM_GRADIENT(N, D, INNER)                                                               \
  FT_INLINE void ft_sum_gradient_##N(const ft_spline_axis* axis, ft_weights w, ft_weights s,       \
                                     ft_values v, long at, ft_quad_gradient* sum) {                \
    ft_quad_gradient row;                                                                          \
    int j;                                                                                         \
    sum->value = sum->by[0] = ft_zero4();                                                          \
    FT_EACH_##INNER(FT_SUM_GRADIENT_ZERO) for (j = 0; j < ft_support_size(axis);                   \
                                               ++j, at += axis->nodes.stride) {                    \
      ft_sum_gradient_##D(axis + 1, w + 1, s + 1, v, at, &row);                                    \
      sum->value = ft_plus4(sum->value, ft_times4(w[0][j], row.value));                            \
      sum->by[0] = ft_plus4(sum->by[0], ft_times4(s[0][j], row.value));                            \
      FT_EACH_##INNER(FT_SUM_GRADIENT_BY)                                                          \
    }                                                                                              \
  }
FT_SUM_GRADIENT(3, 2, 1)
FT_SUM_GRADIENT(4, 3, 2)
FT_SUM_GRADIENT(5, 4, 3)
FT_SUM_GRADIENT(6, 5, 4)
FT_SUM_GRADIENT(7, 6, 5)
FT_SUM_GRADIENT(8, 7, 6)

/* ft_cubic_gradient_N: as ft_cubic_N; by_u: one derivative per axis. */
#define FT_CUBIC_SLOPES(i) ft_support_slopes(axis, &support, i, slope[i]);
#define FT_CUBIC_BY(i) by_u[i] = ft_dot4(support.w[last], sum.by[i]);
#define FT_CUBIC_GRADIENT(N, LAST)                                                                 \
  FT_INLINE double ft_cubic_gradient_##N(const ft_spline_axis* axis, ft_values v, const double* u, \
                                         double* by_u, unsigned* outside) {                        \
    const int last = LAST;                                                                         \
    double slope[N][4];                                                                            \
    ft_support support;                                                                            \
    ft_quad_gradient sum;                                                                          \
    ft_support_##N(axis, u, &support);                                                             \
    if (outside) *outside = support.outside;                                                       \
    FT_EACH_##N(FT_CUBIC_SLOPES)                                                                   \
        ft_sum_gradient_##N(axis, (ft_weights)support.w, (ft_weights)slope, v, support.at, &sum);  \
    FT_EACH_##LAST(FT_CUBIC_BY) by_u[LAST] = ft_dot4(slope[LAST], sum.value);                      \
    return ft_dot4(support.w[last], sum.value);                                                    \
  }
FT_CUBIC_GRADIENT(1, 0)
FT_CUBIC_GRADIENT(2, 1)
FT_CUBIC_GRADIENT(3, 2)
FT_CUBIC_GRADIENT(4, 3)
FT_CUBIC_GRADIENT(5, 4)
FT_CUBIC_GRADIENT(6, 5)
FT_CUBIC_GRADIENT(7, 6)
FT_CUBIC_GRADIENT(8, 7)

#endif
