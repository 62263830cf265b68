// A friction law given by a table: coefficients or stresses at the nodes of a grid, from a paper or
// another program, with linear interpolation between them. The table is turned into a formula, and
// so into a Law like any other; it has no parameters and is evaluated without a fit.
//
// An axis with nodes x_0 < ... < x_n has ramps
//   r_i(x) = (u(min(max(x, x_i), x_i+1)) - u(x_i))/(u(x_i+1) - u(x_i)),  u = x or ln x,
// which go from 0 to 1 between two nodes and are constant outside. Along one axis the table is
//   y_0 + sum_i (y_i+1 - y_i) r_i(x),
// and with more axes each y is a sum of this kind over the next axis. Within a cell only the ramps
// of that cell vary, so bounds over a cell stay narrow. States beyond the ends of an axis are
// clamped to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

struct LawTableAxis {
  std::string name;          // of a state, column or history, as in formulas
  bool log = false;          // linear in ln x; all nodes are then positive
  std::vector<double> nodes; // ascending, at least 2
  Place place;
};

struct LawTable {
  std::string name, title, reference;
  std::string file; // shown in the formula
  PieceQuantity quantity = PieceQuantity::mu;
  bool log_value = false; // linear in ln of the value; all values are then positive
  std::vector<LawTableAxis> axes;
  std::vector<double> value; // row-major, last axis fastest
  // Formula of tau_R with the symbol "value"; absent: value*sigma_n_MPa or value, by the quantity.
  std::optional<expr::Expr> combine;
};

// Upper limit of a table's nodes, because its formula is written out in model files and, as the
// direct form, in generated sources.
constexpr std::size_t most_law_nodes = 5000;

// Builds a law from the table. The caller checks axes and values.
Law law_of_table(const LawTable& table);

} // namespace frictab::models
