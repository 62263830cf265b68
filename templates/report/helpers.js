const {abs, acos, exp, log, pow, sin, sqrt, tanh} = Math;
// NaN in either operand gives NaN.
const ft_min = (a, b) => (b < a || b !== b ? b : a);
const ft_max = (a, b) => (b > a || b !== b ? b : a);
const ft_where_le = (a, b, x, y) => (a !== a ? a : b !== b ? b : a <= b ? x : y);
