// Writes "How to wire the routine": compile command, source of each state, lines of the deck.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "io/json.h"
#include "report/sections.h"
#include "report/svg.h"
#include "report/wiring.h"

namespace frictab::report {

namespace {

using recipe_json = nlohmann::ordered_json;

std::string text_at(const recipe_json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

std::vector<std::string> texts_at(const recipe_json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_array() ? at->get<std::vector<std::string>>()
                                              : std::vector<std::string>{};
}

std::string escaped_lines(const std::vector<std::string>& lines) {
  return svg::escape(join(lines, "\n"));
}

} // namespace

Wiring wiring_of(const Recipe& recipe) {
  const recipe_json json = io::parse_json(recipe.text, recipe.path);
  Wiring out;
  io::read_json(recipe.path, "export again", [&] {
    out.path = recipe.path;
    out.title = json.at("title").get<std::string>();
    out.model = json.at("model").get<std::string>();
    out.entry = text_at(json, "entry");
    out.units = json.at("units").at("system").get<std::string>();
    out.files = texts_at(json, "files");
    out.compile = texts_at(json, "compile");
    out.input_deck = text_at(json, "input_deck");
    const auto arguments = json.find("arguments");
    if (arguments == json.end()) return;
    for (const recipe_json& argument : *arguments)
      out.arguments.push_back(
          {text_at(argument, "quantity"), text_at(argument, "unit"), text_at(argument, "source")});
  });
  return out;
}

void add_wiring(TemplateValues& page, const ReportInput& input) {
  std::vector<TemplateValues>& recipes = page.lists["recipes"];
  for (const Recipe& recipe : input.recipes) {
    const Wiring w = wiring_of(recipe);
    TemplateValues values{{{"title", svg::escape(w.title)},
                           {"model", svg::escape(w.model)},
                           {"path", svg::escape(w.path)},
                           {"entry", svg::escape(w.entry)},
                           {"units", svg::escape(w.units)},
                           {"files", svg::escape(join(w.files, ", "))},
                           {"compile", escaped_lines(w.compile)},
                           {"deck", svg::escape(w.input_deck)}},
                          {{"has_compile", !w.compile.empty()},
                           {"has_deck", !w.input_deck.empty()},
                           {"has_arguments", !w.arguments.empty()}},
                          {}};
    std::vector<TemplateValues>& arguments = values.lists["arguments"];
    for (const WiringLine& line : w.arguments)
      arguments.push_back(
          {{{"quantity", svg::escape(line.quantity)},
            {"unit", shown_unit(line.unit)},
            {"source", line.source.empty() ? "argument of the call" : svg::escape(line.source)}},
           {},
           {}});
    recipes.push_back(std::move(values));
  }
  page.flags["has_recipes"] = !recipes.empty();
  page.text["wiring_link"] = recipes.empty() ? "" : "<a href=\"#wiring\">Wiring</a> ";
}

} // namespace frictab::report
