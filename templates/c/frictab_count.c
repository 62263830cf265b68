void frictab_count_outside(
    size_t n,
    @{arrays},
    unsigned long* counts) {
  size_t i;
@for name in not_axes
  (void)@{name.text};
@end
@if has_axes
  for (i = 0; i < n; ++i) {
@for axis in axes
    {
      const double x = @{axis.canonical}; /* @{axis.name} */
      counts[@{axis.first}] += x < @{axis.low} ? 1ul : 0ul;
      counts[@{axis.second}] += x > @{axis.high} ? 1ul : 0ul;
    }
@end
  }
@else
  (void)n;
  (void)counts;
  (void)i;
@end
}
