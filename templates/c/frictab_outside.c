/* A NaN is never compared by size: where invalid operations trap, that does. */
unsigned frictab_outside(
    @{parameters}) {
  unsigned outside = 0u;
  (void)@{without_range...};
@for end in ends
  {
    const double x = @{end.canonical}; /* @{end.name} */
    if (x == x && (x < @{end.low} || x > @{end.high})) outside |= @{end.bit}u;
  }
@end
  return outside;
}

void frictab_count_outside(
    size_t n,
    @{arrays},
    unsigned long* counts) {
  size_t i;
  (void)@{without_range...};
@if has_ends
  for (i = 0; i < n; ++i) {
@for end in ends
    {
      const double x = @{end.element}; /* @{end.name} */
      if (x == x) {
        counts[@{end.first}] += x < @{end.low} ? 1ul : 0ul;
        counts[@{end.second}] += x > @{end.high} ? 1ul : 0ul;
      }
    }
@end
  }
@else
  (void)n;
  (void)counts;
  (void)i;
@end
}
