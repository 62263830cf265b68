// How a generated routine is wired into its solver, as its recipe.json says.
#pragma once

#include <string>
#include <vector>

#include "words/document.h"

namespace frictab::words {

// The text of a recipe.json and its path, relative to the output directory.
struct Recipe {
  std::string path;
  std::string text;
};

// A section per recipe: entry, units, files, compile command; in full also the lines of the input
// deck and where each state comes from. Throws InputError where a text is not a recipe.
Section wiring(const std::vector<Recipe>& recipes, Detail detail);

} // namespace frictab::words
