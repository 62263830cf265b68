// Writes decks into recipes, and the include files of recipes.
#include "codegen/deck.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/text.h"

namespace frictab::codegen {

using json = nlohmann::ordered_json;

void add_deck(json& recipe, const Deck& deck) {
  recipe["input_deck"] = deck.lines + deck.of_model;
  if (std::any_of(deck.placeholders.begin(), deck.placeholders.end(),
                  [](const Placeholder& one) { return one.value.empty(); }))
    return;
  json& include = recipe["include"];
  include = {{"file", deck.file},
             {"reference", deck.reference},
             {"comment", deck.comment},
             {"lines", deck.lines},
             {"of_model", deck.of_model}};
  if (!deck.script.empty()) include["script"] = deck.script;
  include["placeholders"] = json::array();
  for (const Placeholder& one : deck.placeholders)
    include["placeholders"].push_back(
        {{"text", one.text}, {"value", one.value}, {"meaning", one.meaning}});
}

std::string include_lines(const json& include) {
  std::string lines = include.at("lines");
  for (const json& one : include.at("placeholders"))
    if (const std::string text = one.at("text"); text.find('<') != text.npos)
      lines = replace_all(lines, text, one.at("value").get<std::string>());
  return lines;
}

std::vector<std::string> include_defaults(const json& include) {
  const std::string lines = include.at("lines");
  std::vector<std::string> out;
  for (const json& one : include.at("placeholders")) {
    const std::string text = one.at("text"), value = one.at("value"), meaning = one.at("meaning");
    if (!meaning.empty() && lines.find(text) != lines.npos)
      out.push_back(meaning + " (" + value.substr(value.find_first_not_of(' ')) + ")");
  }
  return out;
}

} // namespace frictab::codegen
