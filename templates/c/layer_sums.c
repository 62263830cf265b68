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
