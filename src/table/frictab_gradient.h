/* Value and all derivatives by the axis coordinates in one pass, linear and cubic; the same value,
 * bit for bit, as ft_interpolate and ft_cubic give. C99, no allocation, no state, thread-safe.
 * Stands behind frictab_cubic.h. */
#ifndef FRICTAB_GRADIENT_H
#define FRICTAB_GRADIENT_H

/* d weight/d u in the cell of u: 0 outside, where the edge's value is used; NaN for NaN. */
static inline double ft_weight_slope(const ft_axis* axis, double u, int cell, int outside) {
  if (u != u) return u;
  return outside ? 0.0 : 1.0 / (axis->u[cell + 1] - axis->u[cell]);
}

/* As ft_interpolate; by_u: one derivative per axis. */
static inline double ft_interpolate_gradient(int axes, const ft_axis* axis, const double* value,
                                             const double* u, double* by_u, unsigned* outside) {
  double corner[1 << (FT_MAX_AXES - 1)];
  double slope[FT_MAX_AXES][1 << (FT_MAX_AXES - 1)]; /* by the weight of each axis done so far */
  double weight[FT_MAX_AXES], weight_slope[FT_MAX_AXES];
  long stride[FT_MAX_AXES];
  long base = 0, size = 1;
  unsigned flags = 0u;
  const int last = axes - 1;
  int d, e, corners, i;
  if (outside) *outside = 0u;
  if (axes == 0) return value[0];
  for (d = last; d >= 0; --d) {
    int cell;
    const int beyond = ft_locate(&axis[d], u[d], &cell, &weight[d]);
    if (beyond) flags |= 1u << d;
    weight_slope[d] = ft_weight_slope(&axis[d], u[d], cell, beyond);
    stride[d] = size;
    base += cell * size;
    size *= axis[d].n;
  }
  if (outside) *outside = flags;
  corners = 1 << last;
  for (i = 0; i < corners; ++i) {
    long at = base;
    for (d = 0; d < last; ++d)
      if (i & (1 << (last - 1 - d))) at += stride[d];
    corner[i] = (1.0 - weight[last]) * value[at] + weight[last] * value[at + 1];
    slope[last][i] = value[at + 1] - value[at];
  }
  for (d = last - 1; d >= 0; --d) {
    const double w = weight[d];
    corners /= 2;
    for (e = d + 1; e < axes; ++e)
      for (i = 0; i < corners; ++i)
        slope[e][i] = (1.0 - w) * slope[e][2 * i] + w * slope[e][2 * i + 1];
    for (i = 0; i < corners; ++i) {
      slope[d][i] = corner[2 * i + 1] - corner[2 * i];
      corner[i] = (1.0 - w) * corner[2 * i] + w * corner[2 * i + 1];
    }
  }
  for (d = 0; d < axes; ++d)
    by_u[d] = slope[d][0] * weight_slope[d];
  return corner[0];
}

/* Derivatives of the weights that ft_spline_weights gives, by u. */
static inline void ft_spline_slopes(const ft_spline_axis* axis, double u, double* by_u) {
  const double* b;
  double t, s;
  int cell, j;
  const int outside = ft_locate(&axis->nodes, u, &cell, &t);
  b = axis->basis + 16 * cell;
  s = ft_weight_slope(&axis->nodes, u, cell, outside);
  for (j = 0; j < 4; ++j)
    by_u[j] = s * (b[4 + j] + t * (2.0 * b[8 + j] + t * (3.0 * b[12 + j])));
}

/* Adds one tap of axis d. lane, sum: [0] the value, [1 + e] the derivative by axis e, for
 * d <= e < last. */
static inline void ft_gather4(double (*sum)[4], double (*lane)[4], int d, int last, double w,
                              double slope) {
  int e;
  ft_add4(sum[0], w, lane[0]);
  ft_add4(sum[1 + d], slope, lane[0]);
  for (e = d + 1; e < last; ++e)
    ft_add4(sum[1 + e], w, lane[1 + e]);
}

/* The last two axes, or three, as one block: lane[0], lane[1 + inner], lane[1 + outer]. */
static inline void ft_block4(const ft_spline_place* at, double (*slope)[4], const double* c,
                             int axes, double (*lane)[4]) {
  const int inner = axes - 2, outer = axes - 3;
  double value[4], by_inner[4], sum[3][4];
  int j;
  if (outer < 0) {
    ft_rows4(lane[0], at->w[inner], c, at->row);
    ft_rows4(lane[1 + inner], slope[inner], c, at->row);
    return;
  }
  for (j = 0; j < 3; ++j)
    ft_zero4(sum[j]);
  for (j = 0; j < at->taps[outer]; ++j) {
    ft_rows4(value, at->w[inner], c + j * at->stride[outer], at->row);
    ft_rows4(by_inner, slope[inner], c + j * at->stride[outer], at->row);
    ft_add4(sum[0], at->w[outer][j], value);
    ft_add4(sum[1], at->w[outer][j], by_inner);
    ft_add4(sum[2], slope[outer][j], value);
  }
  ft_take4(lane[0], sum[0]);
  ft_take4(lane[1 + inner], sum[1]);
  ft_take4(lane[1 + outer], sum[2]);
}

/* As ft_cubic; by_u: one derivative per axis. */
static inline double ft_cubic_gradient(int axes, const ft_spline_axis* axis, const double* c,
                                       const double* u, double* by_u, unsigned* outside) {
  ft_spline_place at;
  double slope[FT_MAX_AXES][4], sum[FT_MAX_AXES][1 + FT_MAX_AXES][4], lane[1 + FT_MAX_AXES][4];
  int tap[FT_MAX_AXES];
  const int last = axes - 1, outer = axes - 3;
  int d, e;
  if (outside) *outside = 0u;
  if (axes == 0) return c[0];
  ft_spline_locate(&at, axes, axis, u);
  if (outside) *outside = at.outside;
  c += at.first;
  for (d = 0; d < axes; ++d)
    ft_spline_slopes(&axis[d], u[d], slope[d]);
  if (axes == 1) {
    by_u[0] = ft_dot4(slope[0], c);
    return ft_dot4(at.w[0], c);
  }
  for (d = 0; d < outer; ++d) {
    tap[d] = 0;
    for (e = 0; e < axes; ++e)
      ft_zero4(sum[d][e]);
  }
  for (;;) { /* as in ft_cubic */
    ft_block4(&at, slope, c, axes, lane);
    for (d = outer - 1; d >= 0; --d) {
      ft_gather4(sum[d], lane, d, last, at.w[d][tap[d]], slope[d][tap[d]]);
      c += at.stride[d];
      if (++tap[d] < at.taps[d]) break;
      c -= at.taps[d] * at.stride[d];
      tap[d] = 0;
      ft_take4(lane[0], sum[d][0]);
      for (e = d; e < last; ++e)
        ft_take4(lane[1 + e], sum[d][1 + e]);
    }
    if (d < 0) break;
  }
  for (e = 0; e < last; ++e)
    by_u[e] = ft_dot4(at.w[last], lane[1 + e]);
  by_u[last] = ft_dot4(slope[last], lane[0]);
  return ft_dot4(at.w[last], lane[0]);
}

#endif
