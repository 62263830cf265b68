// A calibrated law with its formulas written out.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

// Made once, where a model meets a table or data (a stage of the pipeline, a command), and handed
// down: what samples, bounds, compares and prints a law takes its formulas from here and asks the
// law for none. Expressions share their parts, so a copy is cheap.
struct AssembledLaw {
  explicit AssembledLaw(Model model);

  Model model;
  std::vector<std::string> inputs;     // states that tau_R depends on, as inputs(law) lists them
  std::vector<std::string> parameters; // their names, in the order of model.parameters

  // Of states and parameters by name, each part stored once, as in a table that was read from its
  // file: sources do not depend on where their table came from.
  expr::Expr piece; // the smooth part that a table holds
  expr::Expr
      combine; // tau_R from "value", states and parameters, with the model's gain and shear limit
  expr::Expr tau_R; // MPa: `combine` of `piece`

  // The states that the piece depends on: a table of this law has an axis for each.
  std::set<std::string> piece_inputs;

  // An expression of this law with the numbers of its parameters in their place.
  expr::Expr in_numbers(const expr::Expr& expression) const;
};

} // namespace frictab::models
