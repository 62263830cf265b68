// The grid of a solver's own friction table, built to a tolerance. Such tables have a coefficient
// over states in plain units; the solver interpolates it linearly and multiplies it by the pressure
// (or by the shear yield stress), so the nodes of a frictab table, which fit other coordinates,
// cannot be reused.
//
// The relevant error is that of the stress: |factor * interpolated - tau_R| in MPa, both cut at the
// limit if the solver has one. The error is measured, because laws have kinks, at which an estimate
// from second derivatives fails. The coefficient is sampled at many places along lines parallel to
// each axis (through the corners of the ranges and through interior states). Starting at the low
// end, every cell is the longest whose error on all these lines stays below the allowed one. Then
// the whole grid is checked, at the centres of its cells and at points that fill the ranges. The
// allowed error on a line is scaled by aim over found, the worst states become lines, and the grid
// is rebuilt, until the aim is met closely or the rounds are used up.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/solver_units.h"

namespace frictab::codegen {

// The numbers of a table as a solver reads it.
struct NativeValues {
  // Per column, solver's unit, ascending; one or none: the value does not depend on this column.
  std::vector<std::vector<double>> nodes;
  std::vector<double> value;   // first column varies fastest
  std::optional<double> limit; // largest shear stress, solver's unit

  // Interpolates linearly between nodes; constant beyond their ends; NaN in x gives NaN.
  double at(std::span<const double> x) const;
};

// A column of the solver's table.
struct NativeAxis {
  std::string state; // canonical name
  SolverUnit unit;
  double low = 0, high = 0;       // canonical units
  bool log = false;               // places are evenly spaced in its logarithm
  std::vector<double> kinks = {}; // canonical units: nodes of the table it is made from
  // Least number of nodes; 1: a single one if the value does not depend on the state.
  std::size_t fewest = 1;
};

// The function to tabulate: tau_R = coefficient * factor. The factor is the pressure, a column of
// its own, or one number (MPa). tau_R is limited if the solver has a largest shear stress.
// Coefficients above `most` are written as `most`.
struct NativeProblem {
  static constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();
  std::vector<NativeAxis> axes;
  std::size_t pressure = no_column;
  double factor_MPa = 1;
  std::optional<double> limit_MPa;
  double most = std::numeric_limits<double>::infinity();
  // tau_R in MPa without the limit; columns in canonical units, in the order of the axes. Called
  // from several threads.
  std::function<void(std::size_t rows, std::span<const double* const>, std::span<double>)> tau;
};

struct NativeGoal {
  double aim_MPa = 0.5;            // largest allowed difference from the problem's tau_R
  std::size_t most_values = 30000; // number of lines that an input deck can have
};

struct NativeGrid {
  NativeValues values;
  double found_MPa = 0; // largest difference found, over states that fill the ranges
  bool met = false;
};

// Returns the grid with the fewest values that meets the aim, or the closest grid of `most_values`.
// Nodes have six significant digits (ends: nine), values nine, exactly as in the text that a target
// writes.
NativeGrid make_native_grid(const NativeProblem& problem, const NativeGoal& goal);

// Formats a number with nine significant digits, and rounds a number to the double that this text
// reads back as.
std::string native_number(double value);
double as_written(double value);

} // namespace frictab::codegen
