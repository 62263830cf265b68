// The error of a look-up in single precision, then of the formula around it.
//
// A look-up is the exact interpolation at a coordinate that is a little off, plus the rounding of
// its sums (Higham 2002, ch. 3; gamma_n = n u/(1 - n u), u = 2^-24). Along each axis, coordinate u
// between nodes u_i, weight w:
//   * the coordinate is off by the rounding of the argument (and of its logarithm), and by that of
//     the nodes: the kernel's nodes are those of the exact table seen through a map that moves no
//     coordinate further than the furthest node. Interpolation is steepest as the steepest cell is;
//   * w = (u - u_i) * per_cell has two roundings and that of per_cell; it changes the value by at
//     most the largest difference of neighbours;
//   * N times (1 - w) a + w b, three roundings each, and that of the values: gamma_(3 N + 1) times
//     the largest of them.
// Of a cubic table the same, with the polynomials of a cell in the place of weights, and the slopes
// of these in the place of differences: B-splines are not negative and sum up to 1.
#include "single_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/entry_arguments.h"
#include "codegen/layer.h"
#include "codegen/single_precision.h"
#include "expr/rounding.h"
#include "table/spline.h"

namespace frictab::c_target {

using expr::Expr;
using namespace codegen;
using table::Table;
using table::TableAxis;

namespace {

constexpr double roundoff = expr::single_roundoff;
constexpr double smallest_normal = std::numeric_limits<float>::min(); // what may become 0

double gamma_of(std::size_t n) {
  return static_cast<double>(n) * roundoff / (1 - static_cast<double>(n) * roundoff);
}

double largest_size(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values)
    most = std::max(most, std::abs(v));
  return most;
}

// Of an argument in canonical units: rounded once; converted, with a rounded factor, by a product
// or quotient.
double argument_error(const InputArgument& input) {
  return input.solver.same() ? roundoff : 2.1 * roundoff + expr::single_library_error;
}

// What rounding does along one axis.
struct AxisErrors {
  double coordinate = 0; // how far it is off, in u
  double weight = 0;     // how far the weight is off beyond that
};

AxisErrors axis_errors(const TableAxis& axis, double argument) {
  const std::vector<double> u = axis.coordinates();
  const double x = std::max(std::abs(axis.nodes.front()), std::abs(axis.nodes.back()));
  AxisErrors out;
  out.coordinate = argument * x + smallest_normal;
  if (axis.log)
    out.coordinate = argument / (1 - argument) +
                     expr::single_library_error * (largest_size(u) + 2 * argument) +
                     smallest_normal;
  double nodes = 0, per_cell = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    nodes = std::max(nodes, std::abs(static_cast<float>(u[i]) - u[i]));
    if (i == 0) continue;
    const double cell =
        static_cast<double>(static_cast<float>(u[i])) - static_cast<float>(u[i - 1]);
    per_cell = std::max(per_cell, std::abs(single_value(1 / cell) * cell - 1));
  }
  out.coordinate += nodes;
  out.weight = (1 + per_cell) * (1 + roundoff) * (1 + roundoff) - 1 + smallest_normal;
  return out;
}

// The largest difference of neighbours along an axis, and the steepest cell.
struct AxisSlopes {
  double difference = 0, steepest = 0;
};

AxisSlopes linear_slopes(const std::vector<double>& values, const std::vector<double>& u,
                         std::size_t stride) {
  AxisSlopes out;
  for (std::size_t at = 0; at + stride < values.size(); ++at) {
    const std::size_t i = at / stride % u.size();
    if (i + 1 == u.size()) continue;
    const double d = std::abs(values[at + stride] - values[at]);
    out.difference = std::max(out.difference, d);
    out.steepest = std::max(out.steepest, d / (u[i + 1] - u[i]));
  }
  return out;
}

double linear_error(const Table& table, const std::vector<double>& argument) {
  const std::vector<double> values = table.value_coordinates();
  const std::size_t roundings = 3 * table.axes.size() + 1;
  double error =
      gamma_of(roundings) * largest_size(values) + static_cast<double>(roundings) * smallest_normal;
  std::size_t stride = values.size();
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    stride /= table.axes[a].nodes.size();
    const AxisErrors axis = axis_errors(table.axes[a], argument[a]);
    const AxisSlopes slopes = linear_slopes(values, table.axes[a].coordinates(), stride);
    error += slopes.steepest * axis.coordinate + slopes.difference * axis.weight;
  }
  return error;
}

// Of the polynomials of an axis, over its cells.
struct Polynomials {
  double size = 0;   // sum of the sizes of all coefficients
  AxisSlopes slopes; // of the spline, by the weight and by u
};

// Sums over the 4 splines of a cell: of their coefficients' sizes, of their largest slopes by the
// weight.
std::pair<double, double> sums_of_cell(const double* basis) {
  double size = 0, slope = 0;
  for (std::size_t p = 0; p < 4; ++p)
    for (std::size_t j = 0; j < 4; ++j) {
      size += std::abs(basis[4 * p + j]);
      slope += static_cast<double>(p) * std::abs(basis[4 * p + j]);
    }
  return {size, slope};
}

// The slopes of the splines of a cell sum up to 0, so that only the spread of their factors counts:
// half of largest less smallest, of any line along this axis.
double largest_spread(const std::vector<double>& values, std::size_t first, std::size_t nodes,
                      std::size_t stride) {
  const std::size_t support = std::min<std::size_t>(nodes, 4);
  double most = 0;
  for (std::size_t block = 0; block < values.size(); block += nodes * stride)
    for (std::size_t line = block; line < block + stride; ++line) {
      double low = values[line + first * stride], high = low;
      for (std::size_t j = 1; j < support; ++j) {
        low = std::min(low, values[line + (first + j) * stride]);
        high = std::max(high, values[line + (first + j) * stride]);
      }
      most = std::max(most, 0.5 * (high - low));
    }
  return most;
}

Polynomials polynomials(const TableAxis& axis, const std::vector<double>& values,
                        std::size_t stride) {
  const table::SplineAxis spline = table::spline_axis(axis);
  const std::vector<double>& u = spline.u;
  Polynomials out;
  for (std::size_t cell = 0; cell + 1 < u.size(); ++cell) {
    const auto [size, slope] = sums_of_cell(&spline.basis[16 * cell]);
    const double change =
        slope *
        largest_spread(values, static_cast<std::size_t>(spline.first[cell]), u.size(), stride);
    out.size = std::max(out.size, size);
    out.slopes.difference = std::max(out.slopes.difference, change);
    out.slopes.steepest = std::max(out.slopes.steepest, change / (u[cell + 1] - u[cell]));
  }
  return out;
}

double cubic_error(const Table& table, const std::vector<double>& argument) {
  std::vector<double> values = baked_values(table);
  values.resize(values.size() - 2); // the zeros behind them
  double error = 0, sums = 1 + roundoff, terms = 1;
  std::size_t stride = values.size();
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    stride /= table.axes[a].nodes.size();
    const AxisErrors axis = axis_errors(table.axes[a], argument[a]);
    const Polynomials splines = polynomials(table.axes[a], values, stride);
    error += splines.slopes.steepest * axis.coordinate + splines.slopes.difference * axis.weight;
    sums *= (1 + gamma_of(7) * splines.size + smallest_normal) * (1 + gamma_of(5));
    terms *= 4;
  }
  return error + largest_size(values) * (sums - 1) + 4 * terms * smallest_normal;
}

// The looked up value with its error.
expr::SingleSymbol looked_up(const Table& table, const std::vector<double>& argument) {
  const std::vector<double> values = baked_values(table);
  const auto end = values.end() - (is_cubic(table) ? 2 : 0);
  const auto [low, high] = std::minmax_element(values.begin(), end);
  if (table.axes.empty()) return {{*low, *high}};
  return {{*low, *high},
          0,
          is_cubic(table) ? cubic_error(table, argument) : linear_error(table, argument)};
}

// A formula whose symbols are arguments, constants and what is looked up.
RoundingBound bound_of(const ExportRequest& request, const Expr& tau,
                       const std::map<std::string, expr::SingleSymbol>& symbols) {
  const double over = solver_unit("MPa", request.units).over;
  const expr::SingleBound bound = bound_in_single(over == 1 ? tau : tau * Expr(over), symbols);
  if (!std::isfinite(bound.error))
    return {{}, "its formula may overflow in single precision, or branch by a rounded number"};
  const double of_double = 0x1p-40 * bound.exact.magnitude(); // rounding of the other function
  return {(bound.error + of_double) / over, ""};
}

} // namespace

RoundingBound rounding_bound(const ExportRequest& request) {
  const Table& table = request.table;
  const std::vector<InputArgument> inputs = entry_arguments(table, request.units);
  std::map<std::string, expr::SingleSymbol> symbols;
  std::vector<double> of_axis(table.axes.size());
  for (const InputArgument& input : inputs) {
    if (!input.used) continue;
    const auto range = table.range(input.name);
    if (!range) return {{}, "no range of " + input.name + " is known"};
    symbols[input.name] = {{range->first, range->second}, argument_error(input)};
    if (input.axis) of_axis[*input.axis] = argument_error(input);
  }
  for (const auto& [name, value] : table.constants)
    symbols[name] = {{value, value}, roundoff, smallest_normal};
  if (table.is_direct()) {
    if (split_layer(*table.extension).layer) return {{}, "its formula is a network"};
    return bound_of(request, substitute(table.combine, {{"value", *table.extension}}), symbols);
  }
  const Expr value = Expr::symbol("value");
  symbols["value"] = looked_up(table, of_axis);
  const Expr looked = table.log_value ? exp(value) : value;
  return bound_of(request, substitute(table.combine, {{"value", looked}}), symbols);
}

} // namespace frictab::c_target
