@if uses_min
/* NaN in either operand gives NaN. */
static inline double ft_min(double a, double b) {
  return (b < a || b != b) ? b : a;
}
@end
@if uses_max
static inline double ft_max(double a, double b) {
  return (b > a || b != b) ? b : a;
}
@end
@if uses_where
static inline double ft_where_le(double a, double b, double x, double y) {
  if (a != a) return a;
  if (b != b) return b;
  return a <= b ? x : y;
}
@end
