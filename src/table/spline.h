// The cubic spline of a table: from values at nodes to coefficients and cell polynomials for
// ft_cubic.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "table/table.h"

namespace frictab::table {

// The spline's name in a table file. It is the interpolating B-spline in the axes' coordinates, of
// degree 3 (n - 1 on an axis of n < 4 nodes), without a knot at the second and the last node but
// one (de Boor, A Practical Guide to Splines, ch. IV): n coefficients for n nodes. An axis that
// lists kinks has one such spline on each side of them, joined in value.
inline constexpr const char* spline_name = "not-a-knot";

// The data of one axis to which an ft_spline_axis points.
struct SplineAxis {
  std::vector<double> u;     // nodes in the axis' coordinate
  std::vector<int> first;    // per cell: first coefficient that acts there
  std::vector<double> basis; // per cell: 16 numbers, [power of t][coefficient]
};

// `kinks`: inner nodes at which the spline is split, in the coordinate u; values that are not inner
// nodes are ignored.
SplineAxis spline_axis(const std::vector<double>& u, const std::vector<double>& kinks = {});
SplineAxis spline_axis(const TableAxis& axis);

// Replaces the values at the nodes of one axis by coefficients, for `outer` blocks of n x `inner`
// numbers, row-major. Banded elimination without pivoting is stable for B-splines (their
// collocation matrix is totally positive; de Boor, ch. XIII).
void solve_along(const SplineAxis& axis, std::size_t outer, std::size_t inner,
                 std::span<double> values);

// Returns the coefficients of the tensor product, row-major as the values, and the 2 zeros that
// ft_cubic reads after them.
std::vector<double> spline_coefficients(const std::vector<SplineAxis>& axes,
                                        std::span<const double> values);

} // namespace frictab::table
