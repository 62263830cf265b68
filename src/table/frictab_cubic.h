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

/* First coefficient and weights of u; returns 1 where u lies outside the axis (the edge is used).
 */
static inline int ft_spline_weights(const ft_spline_axis* axis, double u, int* first, double* w) {
  const double* b;
  double t;
  int cell, j;
  const int outside = ft_locate(&axis->nodes, u, &cell, &t);
  b = axis->basis + 16 * cell;
  *first = axis->first[cell];
  for (j = 0; j < 4; ++j)
    w[j] = b[j] + t * (b[4 + j] + t * (b[8 + j] + t * b[12 + j]));
  return outside;
}

/* On 4 numbers, for as many coefficients along the last axis. */
static inline void ft_zero4(double* sum) {
  int l;
  for (l = 0; l < 4; ++l)
    sum[l] = 0.0;
}
static inline void ft_add4(double* sum, double w, const double* x) {
  int l;
  for (l = 0; l < 4; ++l)
    sum[l] += w * x[l];
}
/* lane = the sum over the 4 taps of an axis whose coefficients lie at c + row[j]. */
static inline void ft_rows4(double* lane, const double* w, const double* c, const long* row) {
  const double *x0 = c + row[0], *x1 = c + row[1], *x2 = c + row[2], *x3 = c + row[3];
  int l;
  for (l = 0; l < 4; ++l)
    lane[l] = (w[0] * x0[l] + w[1] * x1[l]) + (w[2] * x2[l] + w[3] * x3[l]);
}
/* Hands sums on and starts new ones. */
static inline void ft_take4(double* to, double* sum) {
  int l;
  for (l = 0; l < 4; ++l) {
    to[l] = sum[l];
    sum[l] = 0.0;
  }
}
static inline double ft_dot4(const double* w, const double* x) {
  return (w[0] * x[0] + w[1] * x[1]) + (w[2] * x[2] + w[3] * x[3]);
}

/* What a spline of two or more axes is summed over at u. */
typedef struct {
  double w[FT_MAX_AXES][4];
  int taps[FT_MAX_AXES];
  long stride[FT_MAX_AXES];
  long row[4];      /* of the last axis but one; a tap that is not there has the weight 0 */
  long first;       /* coefficient */
  unsigned outside; /* bits of clamped axes */
} ft_spline_place;

static inline void ft_spline_locate(ft_spline_place* at, int axes, const ft_spline_axis* axis,
                                    const double* u) {
  long size = 1;
  int d, j;
  at->first = 0;
  at->outside = 0u;
  for (d = axes - 1; d >= 0; --d) {
    int first;
    if (ft_spline_weights(&axis[d], u[d], &first, at->w[d])) at->outside |= 1u << d;
    at->taps[d] = axis[d].nodes.n < 4 ? axis[d].nodes.n : 4;
    at->stride[d] = size;
    at->first += first * size;
    size *= axis[d].nodes.n;
  }
  for (j = 0; axes > 1 && j < 4; ++j)
    at->row[j] = j < at->taps[axes - 2] ? j * at->stride[axes - 2] : 0;
}

/* c: row-major, last axis fastest, and 2 zeros behind the last coefficient (4 are read along an
 * axis of 2 or 3 nodes as well). u, *outside and zero axes: as for ft_interpolate. */
static inline double ft_cubic(int axes, const ft_spline_axis* axis, const double* c,
                              const double* u, unsigned* outside) {
  ft_spline_place at;
  double sum[FT_MAX_AXES][4], rows[4], lane[4];
  int tap[FT_MAX_AXES];
  const int last = axes - 1, inner = axes - 2, outer = axes - 3;
  int d, j;
  if (outside) *outside = 0u;
  if (axes == 0) return c[0];
  ft_spline_locate(&at, axes, axis, u);
  if (outside) *outside = at.outside;
  c += at.first;
  if (axes == 1) return ft_dot4(at.w[0], c);
  for (d = 0; d < outer; ++d) {
    tap[d] = 0;
    ft_zero4(sum[d]);
  }
  for (;;) { /* the last three axes as one block; its sums are carried upwards like digits */
    if (outer < 0) {
      ft_rows4(lane, at.w[inner], c, at.row);
    } else {
      ft_zero4(lane);
      for (j = 0; j < at.taps[outer]; ++j) {
        ft_rows4(rows, at.w[inner], c + j * at.stride[outer], at.row);
        ft_add4(lane, at.w[outer][j], rows);
      }
    }
    for (d = outer - 1; d >= 0; --d) {
      ft_add4(sum[d], at.w[d][tap[d]], lane);
      c += at.stride[d];
      if (++tap[d] < at.taps[d]) break;
      c -= at.taps[d] * at.stride[d];
      tap[d] = 0;
      ft_take4(lane, sum[d]);
    }
    if (d < 0) return ft_dot4(at.w[last], lane);
  }
}

#endif
