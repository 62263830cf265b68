// The canonical quantities: names, units, meaning and the range of the paper's Table 1.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace frictab {

struct Quantity {
  std::string name;    // CSV column, TOML key, HDF5 scale, JSON
  std::string symbol;  // as written in formulas: sigma_N
  std::string unit;    // canonical unit
  std::string meaning; // long_name in files
  double lowest;       // smallest admissible value (-inf where any)
  bool state;          // may be an input of a law, and so an axis of a table
  bool log_axis;       // default spacing of its axis
  std::optional<std::pair<double, double>> paper_range; // Table 1
};

// In contract order: experiment is not among them (it is a label).
std::span<const Quantity> quantities();

// nullptr where `name` is not canonical (then the column is a bystander).
const Quantity* find_quantity(std::string_view name);

// What a tribometer measures of friction itself: no input of a law and no cause of an effect.
bool is_measured(std::string_view name);

} // namespace frictab
