// The grid of a solver's own friction table, made to a tolerance. Such tables hold a coefficient
// over states in plain units; the solver interpolates it linearly and multiplies it by pressure (or
// by the shear yield stress), so the nodes of a frictab table, which are made for other
// coordinates, do not fit.
//
// The error that counts is that of the stress: |factor * interpolated - tau_R| in MPa, both cut at
// the limit where the solver knows one. It is measured, since laws have kinks, where an estimate by
// second derivatives fails. Along lines parallel to each axis (through the corners of the ranges
// and through states inside) the coefficient is read at many places. From the low end on, every
// cell is the longest whose error on all these lines stays below what is allowed. Then the whole
// grid is checked, at the centres of its cells and at points that fill the ranges. What is allowed
// on a line is changed by aim over found, the worst states become lines, and the grid is made
// again, until the aim is met closely or the rounds are used up.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/solver_units.h"

namespace frictab::codegen {

// A table as a solver reads it.
struct NativeValues {
  std::vector<std::vector<double>> nodes; // per column, solver's unit, ascending; one or none: the
                                          // value does not depend on this column
  std::vector<double> value;              // first column fastest
  std::optional<double> limit;            // largest shear stress, solver's unit

  // Linear between nodes, constant beyond their ends; NaN in x gives NaN.
  double at(std::span<const double> x) const;
};

// One column.
struct NativeAxis {
  std::string state; // canonical name
  SolverUnit unit;
  double low = 0, high = 0;       // canonical
  bool log = false;               // the state is even in its logarithm
  std::vector<double> kinks = {}; // canonical: nodes of the table it is made from
  std::size_t fewest = 1;         // nodes; 1: none where the value does not depend on the state
};

// What is tabulated: coefficient * factor, where the factor is the pressure, a column of its own,
// or one number (MPa); limited where the solver knows a largest shear stress. Coefficients above
// `most` are written as that.
struct NativeProblem {
  static constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();
  std::vector<NativeAxis> axes;
  std::size_t pressure = no_column;
  double factor_MPa = 1;
  std::optional<double> limit_MPa;
  double most = std::numeric_limits<double>::infinity();
  // tau_R in MPa without the limit; columns in canonical units, in the order of the axes. Parallel.
  std::function<void(std::size_t rows, std::span<const double* const>, std::span<double>)> tau;
};

struct NativeGoal {
  double aim_MPa = 0.5;            // largest difference from the problem's tau_R
  std::size_t most_values = 30000; // lines that an input deck should hold
};

struct NativeGrid {
  NativeValues values;
  double found_MPa = 0; // largest difference found, over states that fill the ranges
  bool met = false;
};

// As few values as meet the aim, or the closest grid of `most_values`. Nodes have six significant
// digits (ends: nine), values nine: the numbers of the text that a target writes.
NativeGrid make_native_grid(const NativeProblem& problem, const NativeGoal& goal);

// A number with nine significant digits, and the double that this text is read as.
std::string native_number(double value);
double as_written(double value);

} // namespace frictab::codegen
