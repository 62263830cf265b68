double frictab_tau_R(
    @{parameters}) {
@if in_file
  if (!ft_ready()) return (double)NAN;
@end
  return ft_tau(
      @{names});
}

@{outside}

void frictab_tau_R_batch(
    size_t n,
    @{arrays},
    double* tau) {
  size_t i;
  (void)@{unused_arrays...};
@if in_file
  if (!ft_ready()) {
    for (i = 0; i < n; ++i)
      tau[i] = (double)NAN;
    return;
  }
@end
  for (i = 0; i < n; ++i)
    tau[i] = ft_tau(
        @{items});
}

@{gradient}
