-- @{about...}
--
-- frictab_tau_R takes, in this order, and gives tau_R in @{stress}:
--   @{arguments...}
-- Arguments the law does not use may be nil. NaN in one that it uses gives NaN.
-- @{outside...}
-- Plain Lua 5.1: runs in LuaJIT and in every later Lua.

local exp, log, sqrt, sin, acos = math.exp, math.log, math.sqrt, math.sin, math.acos
local ft_nan = math.huge - math.huge

@if uses_unit
-- tanh x for |x| <= 19.1 to 5e-15 of its value: Lambert's continued fraction of tanh(x/4), 8 terms,
-- and the double-angle formula twice. Beyond, tanh is 1 to 5e-17.
local function ft_unit(x)
  if x > 19.1 then return 1.0 elseif x < -19.1 then return -1.0 end
  local z = 0.25 * x
  local y = z * z
  local p = z * (2027025.0 + y * (270270.0 + y * (6930.0 + y * 36.0)))
  local q = 2027025.0 + y * (945945.0 + y * (51975.0 + y * (630.0 + y)))
  local p2, q2 = (p + p) * q, p * p + q * q
  return (p2 + p2) * q2 / (p2 * p2 + q2 * q2)
end

@end
@if uses_tanh
-- Later Luas have no tanh of their own.
local tanh = math.tanh or ft_unit

@end
@if uses_pow
local function pow(a, b)
  return a ^ b
end

@end
@if uses_min
-- NaN in either operand gives NaN.
local function ft_min(a, b)
  if a ~= a then return a end
  if b ~= b or b < a then return b end
  return a
end

@end
@if uses_max
local function ft_max(a, b)
  if a ~= a then return a end
  if b ~= b or b > a then return b end
  return a
end

@end
@if uses_where
-- x where a <= b, else y
local function ft_where_le(a, b, x, y)
  if a ~= a then return a end
  if b ~= b then return b end
  if a <= b then return x end
  return y
end

@end
@if interpolates
@if uses_log
-- Zero and negative values lie below every logarithmic axis.
local function ft_log(x)
  if x > 0 then return log(x) end
  return -math.huge
end

@end
-- Nodes of each axis in its coordinate, and the step of the values along it.
local ft_nodes = {
@for axis in axes
  -- @{axis.comment}
  {
@{axis.nodes}
  },
@end
}
local ft_stride = {@{strides}}
@if cubic
-- Per cell the first coefficient that acts there, and the polynomials in the cell's weight that
-- multiply the coefficients: the powers one after the other, 4 numbers each.
local ft_first = {
@for axis in axes
  {
@{axis.first}
  },
@end
}
local ft_basis = {
@for axis in axes
  {
@{axis.basis}
  },
@end
}
local ft_support = {@{supports}}
@end
-- @{value_comment}
local ft_value = {}
@for chunk in chunks
for _, v in ipairs((function()
  return {
@{chunk.text}
  }
end)()) do
  ft_value[#ft_value + 1] = v
end
@end

-- The cell of u, from 1, and the weight of its upper node.
local function ft_locate(nodes, u)
  local low, high = 1, #nodes
  if u <= nodes[1] then return 1, 0.0 end
  if u >= nodes[high] then return high - 1, 1.0 end
  while high - low > 1 do
    local middle = (low + high - (low + high) % 2) / 2
    if nodes[middle] <= u then low = middle else high = middle end
  end
  return low, (u - nodes[low]) / (nodes[low + 1] - nodes[low])
end

local ft_weight = {@{no_weights}} -- of the query at hand
@if cubic

local function ft_sum(d, at)
  if d > @{n_axes} then return ft_value[at] end
  local w, step, sum = ft_weight[d], ft_stride[d], 0.0
  for j = 1, ft_support[d] do
    sum = sum + w[j] * ft_sum(d + 1, at + (j - 1) * step)
  end
  return sum
end

-- Cubic spline at these coordinates, tensor product.
local function ft_interpolate(u)
  local at = 1
  for d = 1, @{n_axes} do
    local cell, t = ft_locate(ft_nodes[d], u[d])
    local b, k, w = ft_basis[d], 16 * (cell - 1), ft_weight[d]
    for j = 1, 4 do
      w[j] = b[k + j] + t * (b[k + 4 + j] + t * (b[k + 8 + j] + t * b[k + 12 + j]))
    end
    at = at + ft_first[d][cell] * ft_stride[d]
  end
  return ft_sum(1, at)
end
@else

local function ft_sum(d, at)
  if d > @{n_axes} then return ft_value[at] end
  local w = ft_weight[d]
  return (1.0 - w) * ft_sum(d + 1, at) + w * ft_sum(d + 1, at + ft_stride[d])
end

-- Linear along every axis at these coordinates.
local function ft_interpolate(u)
  local at = 1
  for d = 1, @{n_axes} do
    local cell, t = ft_locate(ft_nodes[d], u[d])
    ft_weight[d] = t
    at = at + (cell - 1) * ft_stride[d]
  end
  return ft_sum(1, at)
end
@end

@end
@if has_layer
-- @{units} units of tanh, @{outputs} outputs: unit u belongs to output u % @{outputs}
local ft_layer = {
@for feature in features
  {
@{feature.weights}
  },
@end
}
local ft_bias = {
@{bias}
}
local ft_gain = {
@{gain}
}
local ft_offset = {
@{offset}
}
local net = {}

@end
@if has_piece
-- The law's own @{quantity}; held at the ends of the range on sides that clamp.
local function ft_piece(
  @{piece_parameters}
)
  @{held...}
@if piece_table
  local steps = {}
@end
@if has_layer
  @{before...}
  local feature = {@{feature_names}}
  for j = 1, @{outputs} do
    net[j] = ft_offset[j]
  end
  for i = 1, @{units} do
    local a = 0.0
    for f = 1, #feature do
      a = a + ft_layer[f][i] * feature[f]
    end
    a = a + ft_bias[i]
    local j = (i - 1) % @{outputs} + 1
    net[j] = net[j] + ft_gain[i] * ft_unit(a)
  end
@end
  @{piece...}
  return @{piece_result}
end

@end
-- tau_R in MPa; states in canonical units.
local function ft_tau(
  @{parameters}
)
@for name in states
  if @{name.text} ~= @{name.text} then return @{name.text} end
@end
  if @{refusing...} then return ft_nan end -- outside = error
@if interpolates
  local @{value} = ft_interpolate({
    @{coordinates}
  })
@if log_value
  @{value} = exp(@{value})
@end
@else
  local @{value} =
    @{only_value}
@end
@if extends
  if -- outside = law
    @{extending}
  then
    @{value} =
      @{piece_call}
  end
@end
  -- the formula at the head; its value is @{value}
@if formula_table
  local steps = {}
@end
  @{formula...}
  return @{result}
end

function frictab_tau_R(@{entry})
  return ft_tau(@{converted})@{to_solver}
end

-- True where a state lies outside the range that was tested.
function frictab_outside(@{entry})
@for axis in ends
  do
    local x = @{axis.value}
    if x < @{axis.low} or x > @{axis.high} then return true end
  end
@end
  return false
end

-- RECALLED, check against your release: QForm calls FrictionStress of a lubricant and passes fields
-- by the names of its arguments. Which names it knows was not found: put yours here, in the order
-- of the call below, in the units above. parameter(name, default) is QForm's own.
function FrictionStress(@{given})
  return frictab_tau_R(
    @{call...}
  )
end
