// Lines of an input deck that call a routine, as data: the recipe's input_deck, the include file,
// the script for a pre-processor and the README are made from them.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace frictab::codegen {

// A text of the deck for the user to replace. Only texts with a '<' are replaced in the include.
struct Placeholder {
  std::string text;    // "<flow stress of the workpiece, MPa>"
  std::string value;   // "480", its number in the include; empty: none is known
  std::string meaning; // "property 2: flow stress of the workpiece, MPa"; empty: in a comment
};

struct Deck {
  std::string file;      // of the include: "frictab.inp"
  std::string reference; // line by which a deck includes it: "*Include, input=frictab.inp"
  std::string comment;   // "** "
  std::string lines;
  std::string of_model = {}; // lines with names of the model, which no include can have
  std::string script = {};   // for the vendor's pre-processor, a template of his: "frictab_cae.py"
  std::vector<Placeholder> placeholders = {};
};

// Adds `input_deck`, and `include` if every placeholder of the lines has a number.
void add_deck(nlohmann::ordered_json& recipe, const Deck& deck);

// Returns the lines of a recipe's `include` with numbers for placeholders.
std::string include_lines(const nlohmann::ordered_json& include);

// Returns the placeholders that these lines have, "property 2: flow stress, MPa (480)".
std::vector<std::string> include_defaults(const nlohmann::ordered_json& include);

} // namespace frictab::codegen
