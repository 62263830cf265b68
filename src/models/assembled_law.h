// A calibrated law with its formulas written out.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "models/law.h"

namespace frictab::models {

// Built once, where a model is combined with a table or data (a stage of the pipeline, a command),
// and passed on: code that samples, bounds, compares or prints a law takes its formulas from here
// instead of building them again. Expressions share their parts, so a copy is cheap.
struct AssembledLaw {
  explicit AssembledLaw(Model model);

  Model model;
  std::vector<std::string> inputs;     // states that tau_R depends on, as in inputs(law)
  std::vector<std::string> parameters; // their names, in the order of model.parameters

  // Formulas of states and parameters by name. Equal parts are stored once, as in a table read from
  // a file, so that generated sources do not depend on where their table came from.
  expr::Expr piece; // the smooth part, which a table samples
  expr::Expr
      combine; // tau_R from "value", states and parameters, with the model's gain and shear limit
  expr::Expr tau_R; // MPa: `combine` of `piece`

  // States that the piece depends on: a table of this law has an axis for each.
  std::set<std::string> piece_inputs;

  // Returns an expression of this law with its parameters replaced by their calibrated values.
  expr::Expr in_numbers(const expr::Expr& expression) const;
};

} // namespace frictab::models
