// The hidden layer of a formula in a generated function: names, formulas in the order of their
// statements, and the values of its loops for a template.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "codegen/layer.h"
#include "codegen/variables.h"
#include "core/template.h"

namespace frictab::codegen {

// Spelling of a layer's variables in a language.
struct LayerSpelling {
  const char* output; // "net({})", an output by its number
  std::size_t first;  // number of the first output
  const char* slope;  // "b{}": the derivative by the weighted sum of feature number {}'s units
};

// Returns the names of the loops, for the function that has them.
std::set<std::string> names_of_layer(const UnitLayer& layer);

// Returns the features of the layer, then the formula after it as `value`; names the outputs.
std::vector<Wanted> layer_formulas(const LayeredFormula& formula, const std::string& value,
                                   const LayerSpelling& spelling, Variables& variables);

// Appends the adjoints of the layer's outputs and the derivatives by these states; the layer's own
// sums come between them.
void add_slopes(std::vector<Wanted>& wanted, const LayeredFormula& formula,
                const std::vector<std::string>& states, const LayerSpelling& spelling,
                Variables& variables);

// Adds the values of the loops: flag has_layer, texts units and outputs, lists features and
// by_outputs (the adjoints, if `code` has them) of index and name.
void add_layer(TemplateValues& values, const UnitLayer& layer, const LayerSpelling& spelling,
               const Statements& code);

// Returns the lines of these statements from one number to before another.
std::vector<std::string> lines_between(const Statements& code, std::size_t from, std::size_t to);

} // namespace frictab::codegen
