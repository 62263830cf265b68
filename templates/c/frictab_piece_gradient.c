/* The same, and its derivatives by the arguments: 0 where one is held at an end */
@if has_layer
FT_WIDE
@end
static double ft_piece_gradient(
    @{parameters}) {
@for input in held
  const double @{input.name} =
      @{input.value};
@end
@for constant in constants
@if constant.renamed
  /* @{constant.comment} */
@end
  const double @{constant.name} = @{constant.value};
@end
@if has_layer
@for statement in before
  const double @{statement.text};
@end
  double unit[@{units}], net[@{outputs}], adjoint[@{outputs}];
@for feature in features
  double slope@{feature.index} = 0.0;
@end
  int i, j;
  for (i = 0; i < @{units}; ++i) {
    double a = 0.0;
@for feature in features
    a += ft_weight@{feature.index}[i] * @{feature.name};
@end
    a += ft_bias[i];
    a = a < -19.1 ? -19.1 : a;
    unit[i] = a > 19.1 ? 19.1 : a;
  }
  for (i = 0; i < @{units}; ++i)
    unit[i] = ft_unit(unit[i]);
  for (j = 0; j < @{outputs}; ++j)
    net[j] = ft_offset[j];
  for (i = 0; i < @{units}; i += @{outputs})
    for (j = 0; j < @{outputs}; ++j)
      net[j] += ft_gain[i + j] * unit[i + j];
@end
@for statement in statements
  const double @{statement.text};
@end
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
@for statement in slope_statements
    const double @{statement.text};
@end
@for slope in slopes
    by[@{slope.place}] = @{slope.text};
@end
@if has_none
    (void)by;
@end
  }
  return @{result};
}
