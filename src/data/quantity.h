// The canonical quantities: names, units, meaning and the range of the paper's Table 1. A state
// that laws may take is one row here; in addition, each solver's table defines how its routine
// reads it (codegen/solver_inputs.h).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace frictab::data {

struct Quantity {
  std::string name;      // CSV column, TOML key, HDF5 scale, JSON
  std::string symbol;    // as written in formulas: sigma_N
  std::string unit;      // canonical unit
  std::string meaning;   // long_name in files
  double lowest = 0;     // smallest admissible value (-inf if unlimited)
  bool state = false;    // may be an input of a law, and so an axis of a table
  bool log_axis = false; // default spacing of its axis
  std::optional<std::pair<double, double>> paper_range = {}; // Table 1
  bool argument = false;                                     // of every generated frictab_tau_R
  // Value in the job's [export.inputs] that takes it from the solver. "contact": it has no other
  // source.
  std::string choice = "solver";
  std::optional<double> unknown = {}; // substitute if its value is unknown
};

// In contract order; excludes experiment, which is a label.
std::span<const Quantity> quantities();

// nullptr if `name` is not canonical (then the column is a bystander).
const Quantity* find_quantity(std::string_view name);

// True for a tribometer's measurements of friction itself, which are neither inputs of a law nor
// causes of an effect.
bool is_measured(std::string_view name);

} // namespace frictab::data
