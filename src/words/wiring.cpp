// Reads recipes and describes them.
#include "words/wiring.h"

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "io/json.h"
#include "words/tables.h"

namespace frictab::words {

namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

std::vector<std::string> texts_at(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_array() ? at->get<std::vector<std::string>>()
                                              : std::vector<std::string>{};
}

Table inputs_of(const Json& recipe, const std::string& title) {
  Table table{"Inputs of " + title, {{"state"}, {"unit"}, {"where it comes from"}}};
  if (const auto arguments = recipe.find("arguments"); arguments != recipe.end())
    for (const Json& argument : *arguments) {
      const std::string source = text_at(argument, "source");
      table.rows.push_back(
          {{code(text_at(argument, "quantity")), unit_text(text_at(argument, "unit")),
            source.empty() ? "argument of the call" : source}});
    }
  return table;
}

Section recipe_section(const Json& recipe, const std::string& path, Detail detail) {
  const std::string title =
      recipe.at("title").get<std::string>() + ": " + recipe.at("model").get<std::string>();
  Section section{"", "", title};
  section.foldable = true;
  section.open = false;
  const Json& units = recipe.at("units");
  const std::string temperature = text_at(units, "temperature");
  section.say("Entry " + code(text_at(recipe, "entry")) + ", units " + text_at(units, "system") +
              (temperature == "K" ? ", K" : "") + ". Files: " +
              code(join(texts_at(recipe, "files"), ", ")) + "; all of it in " + code(path) + ".");
  if (const auto compile = texts_at(recipe, "compile"); !compile.empty())
    section.add(Code{detail == Detail::brief ? compile.front() : join(compile, "\n")});
  if (detail == Detail::brief) return section;
  if (const std::string deck = text_at(recipe, "input_deck"); !deck.empty()) {
    section.say("In the input deck:");
    section.add(Code{deck});
  }
  if (Table inputs = inputs_of(recipe, title); !inputs.rows.empty()) section.add(std::move(inputs));
  return section;
}

} // namespace

Section wiring(const std::vector<Recipe>& recipes, Detail detail) {
  Section section{"wiring", "FE codes", "The routines in their FE codes"};
  for (const Recipe& one : recipes) {
    const Json recipe = io::parse_json(one.text, one.path);
    io::read_json(one.path, "export again",
                  [&] { section.add(recipe_section(recipe, one.path, detail)); });
  }
  return section;
}

} // namespace frictab::words
