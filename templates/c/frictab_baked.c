/* @{value_comment} */
static const double ft_value[@{n_values}] = {
@{values}
};
@if has_axes
static const ft_values ft_table = {ft_value, 0};
@end
