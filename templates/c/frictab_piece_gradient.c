/* The same, and its derivatives by the arguments: 0 where one is held at an end */
@if has_layer
FT_WIDE
@end
static double ft_piece_gradient(
    @{parameters}) {
@include c/clamped_states.c
@if has_layer
  const double @{before...};
  double unit[@{units}], net[@{outputs}], adjoint[@{outputs}];
@for feature in features
  double slope@{feature.index} = 0.0;
@end
@include c/layer_sums.c
@end
  const double @{statements...};
@if has_layer
@for output in by_outputs
  adjoint[@{output.index}] = @{output.name};
@end
  for (i = 0; i < @{units}; i += @{outputs})
    for (j = 0; j < @{outputs}; ++j)
      unit[i + j] = adjoint[j] * ft_gain[i + j] * (1.0 - unit[i + j] * unit[i + j]);
  for (i = 0; i < @{units}; ++i) {
@for feature in features
    slope@{feature.index} += ft_weight@{feature.index}[i] * unit[i];
@end
  }
@end
  {
    const double @{slope_statements...};
@for slope in slopes
    by[@{slope.place}] = @{slope.text};
@end
@if has_none
    (void)by;
@end
  }
  return @{result};
}
