@if has_piece
@{piece_gradient}

@end
static double ft_no_gradient(double tau, double* derivative) {
@for input in used
  derivative[@{input.place}] = tau;
@end
@if none_used
  (void)derivative;
@end
  return tau;
}

double frictab_tau_R_gradient(
    @{parameters},
    double* derivative) {
@include c/states.c
  double @{through_value...} = 0.0;
@if interpolates
  double u[@{n_axes}], by_u[@{n_axes}];
@end
@if has_piece
  double by[@{n_by}];
@end
  double @{value};
  int i;
  (void)@{unused...};
  for (i = 0; i < @{n_arguments}; ++i)
    derivative[i] = 0.0;
@for input in used
  if (@{input.name} != @{input.name})
    return ft_no_gradient(@{input.name}, derivative);
@end
@if in_file
  if (!ft_ready()) return ft_no_gradient((double)NAN, derivative);
@end
  if (@{refusing...}) return ft_no_gradient((double)NAN, derivative); /* outside = error */
@if interpolates
@for axis in axes
  u[@{axis.index}] = @{axis.coordinate};
@end
  @{value} = @{interpolate}(ft_axes, ft_table, u, by_u, 0);
@if log_value
  @{value} = exp(@{value});
@end
@for axis in axes
@if axis.log
  if (by_u[@{axis.index}] != 0.0) @{axis.slope} = by_u[@{axis.index}] / @{axis.variable};
@else
  @{axis.slope} = by_u[@{axis.index}];
@end
@if log_value
  @{axis.slope} *= @{value};
@end
@end
@else
@if tabulated
  @{value} = @{only_value};
@end
@end
@if has_piece
@if tabulated
  if (/* outside = law */
      @{extending}) {
@else
  {
@end
    @{value} = @{piece_call};
@for state in of_piece
    @{state.text} = by[@{state.place}];
@end
  }
@end
  {
    const double @{statements...};
@for slope in slopes
    derivative[@{slope.place}] = @{slope.text};
@end
    return @{result};
  }
}

void frictab_tau_R_gradient_batch(
    size_t n,
    @{arrays},
    double* tau,
    double* derivative) {
  size_t i;
  (void)@{unused_arrays...};
  for (i = 0; i < n; ++i)
    tau[i] = frictab_tau_R_gradient(
        @{items},
        derivative + @{n_arguments} * i);
}
