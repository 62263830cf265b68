/* Multilinear interpolation on a rectangular grid, C99, no allocation, no state, thread-safe.
 *
 * This one text is compiled into frictab and copied into every generated C source, so that what
 * was verified is what runs. Outside the grid the nearest edge is used (clamped) and reported;
 * NaN in gives NaN out. Compile without -ffast-math and with -ffp-contract=off. */
#ifndef FRICTAB_KERNEL_H
#define FRICTAB_KERNEL_H

#include <math.h>

#define FT_MAX_AXES 8

/* One axis: n >= 2 ascending nodes u in the axis coordinate (x, or ln x where the axis is
 * logarithmic). per_step > 0: the nodes are evenly spaced, 1/step, and are found without search. */
typedef struct {
  int n;
  double per_step;
  const double* u;
} ft_axis;

/* NaN in either operand gives NaN. */
static inline double ft_min(double a, double b) {
  return (b < a || b != b) ? b : a;
}
static inline double ft_max(double a, double b) {
  return (b > a || b != b) ? b : a;
}
static inline double ft_where_le(double a, double b, double x, double y) {
  if (a != a) return a;
  if (b != b) return b;
  return a <= b ? x : y;
}

/* Coordinate of a logarithmic axis; zero and negative values lie below every axis. */
static inline double ft_log(double x) {
  return x > 0.0 ? log(x) : (x == x ? -HUGE_VAL : x);
}

/* The cell of u and the weight of its upper node. Returns 1 where u lies outside the axis. */
static inline int ft_locate(const ft_axis* axis, double u, int* cell, double* weight) {
  const double* x = axis->u;
  const int last = axis->n - 1;
  int i = 0;
  *cell = 0;
  if (u != u) {
    *weight = u;
    return 0;
  }
  if (u <= x[0]) {
    *weight = 0.0;
    return u < x[0];
  }
  if (u >= x[last]) {
    *cell = last - 1;
    *weight = 1.0;
    return u > x[last];
  }
  if (axis->per_step > 0.0) {
    i = (int)((u - x[0]) * axis->per_step);
    if (i > last - 1) i = last - 1;
    if (u < x[i])
      --i; /* rounding at a node */
    else if (u > x[i + 1])
      ++i;
  } else {
    int high = last;
    while (high - i > 1) {
      const int middle = (i + high) / 2;
      if (x[middle] <= u)
        i = middle;
      else
        high = middle;
    }
  }
  *cell = i;
  *weight = (u - x[i]) / (x[i + 1] - x[i]);
  return 0;
}

/* value: row-major, last axis fastest; u: one coordinate per axis. Bit d of *outside is set where
 * axis d was clamped (outside may be NULL). Zero axes: value[0]. */
static inline double ft_interpolate(int axes, const ft_axis* axis, const double* value,
                                    const double* u, unsigned* outside) {
  double corner[1 << (FT_MAX_AXES - 1)];
  double weight[FT_MAX_AXES];
  int stride[FT_MAX_AXES];
  long base = 0;
  unsigned flags = 0u;
  int d, size = 1, corners, i;
  if (axes == 0) {
    if (outside) *outside = 0u;
    return value[0];
  }
  for (d = axes - 1; d >= 0; --d) {
    int cell;
    if (ft_locate(&axis[d], u[d], &cell, &weight[d])) flags |= 1u << d;
    stride[d] = size;
    base += (long)cell * size;
    size *= axis[d].n;
  }
  if (outside) *outside = flags;
  corners = 1 << (axes - 1);
  for (i = 0; i < corners; ++i) { /* along the last axis first: its nodes are neighbours */
    long at = base;
    for (d = 0; d < axes - 1; ++d)
      if (i & (1 << (axes - 2 - d))) at += stride[d];
    corner[i] = (1.0 - weight[axes - 1]) * value[at] + weight[axes - 1] * value[at + 1];
  }
  for (d = axes - 2; d >= 0; --d) {
    corners /= 2;
    for (i = 0; i < corners; ++i)
      corner[i] = (1.0 - weight[d]) * corner[2 * i] + weight[d] * corner[2 * i + 1];
  }
  return corner[0];
}

#endif
