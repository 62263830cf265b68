@if has_layer
/* tanh x for |x| <= 19.1 to 5e-15 of its value, without a branch: Lambert's continued fraction of
 * tanh(x/4), 8 terms, and the double-angle formula twice. Beyond, tanh is 1 to 5e-17. */
static inline double ft_unit(double x) {
  const double z = 0.25 * x, y = z * z;
  const double p = z * (2027025.0 + y * (270270.0 + y * (6930.0 + y * 36.0)));
  const double q = 2027025.0 + y * (945945.0 + y * (51975.0 + y * (630.0 + y)));
  const double p2 = (p + p) * q, q2 = p * p + q * q;
  return (p2 + p2) * q2 / (p2 * p2 + q2 * q2);
}

/* The wider vectors of processors that have them, chosen when the program starts; the same bits. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__)
#define FT_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define FT_WIDE
#endif

/* @{units} units of tanh, @{outputs} outputs of @{per_output} units each: unit u belongs to output u % @{outputs} */
@for feature in features
static const double ft_weight@{feature.index}[@{units}] = {
@{feature.weights}
};
@end
static const double ft_bias[@{units}] = {
@{bias}
};
static const double ft_gain[@{units}] = {
@{gain}
};
static const double ft_offset[@{outputs}] = {
@{offset}
};

@end
/* The law's own @{quantity}, by its formula; held at the ends of the range on sides that clamp */
@if has_layer
FT_WIDE
@end
static double ft_piece(
    @{parameters}) {
@include c/clamped_states.c
@if has_layer
  const double @{before...};
  double unit[@{units}], net[@{outputs}];
@include c/layer_sums.c
@end
  const double @{statements...};
  return @{result};
}
