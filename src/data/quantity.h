// The canonical quantities: names, units, meaning and the range of the paper's Table 1. A state
// that laws may take is one row here; beside it, each solver's table says how its routine reads it
// (codegen/solver_inputs.h).
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
  double lowest = 0;     // smallest admissible value (-inf where any)
  bool state = false;    // may be an input of a law, and so an axis of a table
  bool log_axis = false; // default spacing of its axis
  std::optional<std::pair<double, double>> paper_range = {}; // Table 1
  bool argument = false;                                     // of every generated frictab_tau_R
  // In the job's [export.inputs]: takes it from where the solver has it. "contact": from nowhere
  // else.
  std::string choice = "solver";
  std::optional<double> unknown = {}; // stands for it where nothing is known of it
};

// In contract order: experiment is not among them (it is a label).
std::span<const Quantity> quantities();

// nullptr where `name` is not canonical (then the column is a bystander).
const Quantity* find_quantity(std::string_view name);

// What a tribometer measures of friction itself: no input of a law and no cause of an effect.
bool is_measured(std::string_view name);

} // namespace frictab::data
