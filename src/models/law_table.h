// A friction law that is a table: coefficients or stresses at the nodes of a grid, from a paper or
// another program, with linear interpolation between them. It becomes a formula, and with that a
// Law like any other; it has no parameters and is judged as it is.
//
// An axis with nodes x_0 < ... < x_n has ramps
//   r_i(x) = (u(min(max(x, x_i), x_i+1)) - u(x_i))/(u(x_i+1) - u(x_i)),  u = x or ln x,
// which go from 0 to 1 between two nodes and stand still outside. Along one axis the table is
//   y_0 + sum_i (y_i+1 - y_i) r_i(x),
// and with more axes each y is such a sum over the next one. Only the ramps of the cell around a
// state move there: bounds of a cell stay narrow. Beyond the ends of its axes the table is held.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

struct LawTableAxis {
  std::string name;          // of a state, a column or a history, as formulas have it
  bool log = false;          // straight in ln x; its nodes are then above 0
  std::vector<double> nodes; // ascending, at least 2
  Place place;
};

struct LawTable {
  std::string name, title, reference;
  std::string file; // for people
  PieceQuantity quantity = PieceQuantity::mu;
  bool log_value = false; // straight in ln of the value; every value is then above 0
  std::vector<LawTableAxis> axes;
  std::vector<double> value; // row-major, last axis fastest
  // How tau_R follows from "value"; absent: value*sigma_n_MPa or value, by the quantity.
  std::optional<expr::Expr> combine;
};

// Nodes that a table may have as a law: its formula is written out in model files and, as the
// direct form, in generated sources.
constexpr std::size_t most_law_nodes = 5000;

// The table as its axes and values say it; what they must be is the caller's to check.
Law law_of_table(const LawTable& table);

} // namespace frictab::models
