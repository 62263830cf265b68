// Turns recipes into text.
#include "codegen/read_me.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/deck.h"
#include "codegen/number_text.h"
#include "codegen/recipe.h"
#include "codegen/source_check.h"
#include "core/template.h"
#include "core/text.h"
#include "core/version.h"
#include "io/json.h"

namespace frictab::codegen {

namespace {

using json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

constexpr std::size_t page_width = 98;

std::string text_at(const json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

Texts texts_at(const json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_array() ? at->get<Texts>() : Texts{};
}

std::string wrapped(const std::string& text) {
  return join(wrap_text(text, page_width), "\n");
}

std::string bullets(const Texts& texts) {
  Texts items;
  for (const std::string& text : texts)
    items.push_back("* " + join(wrap_text(text, page_width - 2, "  "), "\n"));
  return join(items, "\n");
}

std::string with_unit(const std::string& meaning, const std::string& unit) {
  return unit.empty() || unit == "1" ? meaning : meaning + ", " + unit;
}

// ---- laws ----

// One law alone, or each of several; the units are those of the recipe.
std::vector<json> laws_of(const json& recipe) {
  return recipe.contains("laws") ? recipe.at("laws").get<std::vector<json>>()
                                 : std::vector<json>{recipe};
}

std::string name_of(const json& law) {
  const std::string name = text_at(law, "name");
  return name.empty() ? "FRICTAB" : name;
}

std::string units_text(const json& units) {
  std::string text;
  for (const auto& [what, unit] : units.items())
    text += what == "system" ? unit.get<std::string>() + " ("
                             : what + " " + unit.get<std::string>() + ", ";
  return text.substr(0, text.size() - 2) + ")";
}

std::string law_section(const json& law, const json& recipe) {
  const json& table = law.at("table");
  const std::string tolerance =
      table.contains("tolerance_MPa")
          ? fmt::format("; tolerance {:g} MPa", table["tolerance_MPa"].get<double>())
          : "";
  TemplateValues values;
  values.text["heading"] = law.contains("name") ? "The law of " + name_of(law) : "The law";
  Texts facts = {
      fmt::format("Law: `{}`, tau_R_MPa = `{}`{}", text_at(law, "model"), text_at(table, "combine"),
                  text_at(law, "form") == "table" ? ", where `value` is from the table" : ""),
      "Data: " + text_at(law, "data_origin"),
      "Worst drift from the law: " + text_at(table, "drift") + tolerance,
      "Units: " + units_text(recipe.at("units"))};
  if (const std::string loss = text_at(law, "loss_text"); !loss.empty())
    facts.push_back("THE NEAREST CLOSED FORM, NOT THE LAW: " + loss);
  values.text["facts"] = bullets(facts);
  Texts rows;
  for (const json& state : law.at("arguments"))
    if (state.value("used", true)) {
      const std::string source = text_at(state, "source");
      rows.push_back(fmt::format("| `{}`, {} | {} | {} |", text_at(state, "quantity"),
                                 text_at(state, "meaning"), text_at(state, "range"),
                                 source.empty() ? "argument of the call" : source));
    }
  if (law.contains("held"))
    for (const auto& [state, value] : law.at("held").items())
      rows.push_back(
          fmt::format("| `{}` | {:.6g} | held at this value |", state, value.get<double>()));
  values.text["ranges"] = rows.empty() ? "| none | | |" : join(rows, "\n");
  values.text["outside"] = bullets(texts_at(table, "beyond_range"));
  return render_template("read_me_law.md", values);
}

std::string states_table(const json& law) {
  Texts rows;
  for (const json& state : law.at("state_variables"))
    rows.push_back(fmt::format("| {} | {} |", state.at("number").get<int>(),
                               with_unit(text_at(state, "meaning"), text_at(state, "unit"))));
  if (rows.empty()) return "";
  return fmt::format("{}By {}:\n\n| number | meaning |\n|--:|---|\n{}",
                     law.contains("name") ? name_of(law) + ". " : "",
                     text_at(law, "state_variables_by"), join(rows, "\n"));
}

// ---- the deck ----

std::string deck_section(const json& law, const json& recipe) {
  const bool several = law.contains("name"), included = recipe.contains("include_file");
  const json include = included ? law.at("include") : json();
  TemplateValues values;
  values.flags["several"] = several;
  values.flags["included"] = included;
  values.text["name"] = name_of(law);
  std::string deck = text_at(law, "input_deck");
  if (included) {
    deck = text_at(include, "of_model");
    const std::string script = text_at(include, "script");
    Texts numbers;
    for (const std::string& one : include_defaults(include))
      numbers.push_back(one);
    values.text["what"] = wrapped(fmt::format(
        "Include `{}`{}:", text_at(include, "file"),
        script.empty() ? "" : fmt::format(", or run `{}` in the pre-processor", script)));
    values.text["reference"] = text_at(include, "reference");
    values.text["defaults"] =
        (numbers.empty()
             ? ""
             : "Replace its numbers by those of your process:\n\n" + bullets(numbers) + "\n\n") +
        (deck.empty() ? "" : "Lines with names of your model, for your own deck:");
  }
  values.flags["lines"] = !deck.empty();
  values.text["deck"] = without_last_break(deck);
  std::string note = text_at(law, "input_deck_note");
  if (note.empty()) note = text_at(recipe, "input_deck_note");
  if (note.empty() && text_at(law, "input_deck").empty()) note = "your own program calls it";
  values.text["note"] = wrapped(note.empty() ? "" : "Note: " + note + ".");
  return render_template("read_me_deck.md", values);
}

std::string include_text(const json& recipe) {
  Texts comments = {fmt::format("{}; units {}. Written by frictab {}", text_at(recipe, "title"),
                                units_text(recipe.at("units")), tool_version())};
  comments.push_back("Copy this file before you change it: the next export writes it again.");
  std::string lines, mark;
  for (const json& law : laws_of(recipe)) {
    const json& include = law.at("include");
    mark = text_at(include, "comment");
    comments.push_back(name_of(law) + ": law \"" + text_at(law, "model") + "\"");
    for (const std::string& one : include_defaults(include))
      comments.push_back("  " + one + ": replace it by the one of your process");
    lines += include_lines(include);
  }
  std::string head;
  for (const std::string& comment : comments)
    for (const std::string& line : wrap_text(comment, 76))
      head += mark + line + "\n";
  return head + lines;
}

std::string script_text(const json& recipe) {
  TemplateValues values;
  const std::vector<json> laws = laws_of(recipe);
  for (const json& law : laws) {
    std::string numbers;
    for (const json& one : law.at("include").at("placeholders"))
      numbers += text_at(one, "value") + ", ";
    values.lists["laws"].push_back(
        {.text = {{"name", name_of(law)},
                  {"interactions", laws.size() == 1 ? "None" : "()"},
                  {"states", std::to_string(law.at("state_variables").size())},
                  {"values", numbers.substr(0, numbers.empty() ? 0 : numbers.size() - 1)},
                  {"lines", without_last_break(include_lines(law.at("include")))}},
         .flags = {},
         .lists = {}});
  }
  const std::string target = text_at(recipe, "target");
  return render_template(target.substr(0, target.find('_')) + "/" +
                             text_at(laws.front().at("include"), "script"),
                         values);
}

// ---- compiling ----

void add_compiling(TemplateValues& values, const json& recipe) {
  const auto commands = recipe.find("compile_on");
  values.flags["compiles"] = commands != recipe.end();
  Texts alone, in_solver, build;
  if (commands != recipe.end())
    for (const char* platform : {"linux", "windows"}) {
      alone.push_back(fmt::format("# {}:", platform));
      for (const auto& [compiler, line] : commands->at(platform).items())
        for (const std::string& one : line.is_array() ? line.get<Texts>() : Texts{line})
          alone.push_back(one);
    }
  for (const std::string& line : texts_at(recipe, "compile"))
    if (std::find(alone.begin(), alone.end(), line) == alone.end()) in_solver.push_back(line);
  for (const json& law : laws_of(recipe))
    for (const std::string& step : texts_at(law, "build"))
      if (std::find(build.begin(), build.end(), step) == build.end()) build.push_back(step);
  std::string stand_ins;
  if (const auto includes = recipe.find("stand_ins"); includes != recipe.end())
    for (const auto& [name, text] : includes->items())
      stand_ins += fmt::format("A `{}` next to it stands for that of the solver:\n```\n{}```\n",
                               name, text.get<std::string>());
  values.flags["in_solver"] = !in_solver.empty();
  values.text["in_solver"] = join(in_solver, "\n");
  values.text["build"] = bullets(build);
  values.text["alone"] = join(alone, "\n");
  values.text["stand_ins"] = without_last_break(stand_ins);
  values.text["compile_note"] = "";
  if (commands != recipe.end()) {
    Texts notes = {commands->at("note")};
    if (const std::string note = text_at(recipe, "compile_note"); !note.empty())
      notes.push_back("`compile` in recipe.json: " + note);
    values.text["compile_note"] = bullets(notes);
  }
}

std::string read_me(const json& recipe, const Exporter& exporter) {
  Texts models, laws, decks, states;
  for (const json& law : laws_of(recipe)) {
    models.push_back("`" + text_at(law, "model") + "`");
    laws.push_back(law_section(law, recipe));
    decks.push_back(deck_section(law, recipe));
    if (const std::string table = states_table(law); !table.empty()) states.push_back(table);
  }
  std::string notes = exporter.notes;
  for (const char* const of_several : {"user_file", "laws_note", "told_apart_by"})
    if (const std::string note = text_at(recipe, of_several); !note.empty())
      notes = "Several laws: " + note + ". " + notes;
  TemplateValues values;
  values.text = {{"title", text_at(recipe, "title")},
                 {"version", tool_version()},
                 {"models", join(models, ", ")},
                 {"laws", without_last_break(join(laws, "\n"))},
                 {"decks", without_last_break(join(decks, "\n"))},
                 {"states", join(states, "\n\n")},
                 {"notes", wrapped(notes)},
                 {"source", wrapped("Argument list: " + exporter.signature_source)}};
  values.flags["states"] = !states.empty();
  add_compiling(values, recipe);
  return render_template("read_me.md", values);
}

} // namespace

SourceBundle explained(SourceBundle files, const Exporter& exporter) {
  json recipe = io::parse_json(files.at("recipe.json"), "recipe.json");
  Texts sources;
  for (const auto& [path, text] : files)
    if (!compilers_of(path).empty()) sources.push_back(path);
  if (!sources.empty()) recipe["compile_on"] = compile_lines(sources);
  const std::vector<json> laws = laws_of(recipe);
  if (std::all_of(laws.begin(), laws.end(),
                  [](const json& law) { return law.contains("include"); })) {
    recipe["include_file"] = laws.front()["include"]["file"];
    files[recipe["include_file"]] = include_text(recipe);
    if (const std::string script = text_at(laws.front()["include"], "script"); !script.empty())
      files[script] = script_text(recipe);
  }
  files["README.md"] = read_me(recipe, exporter);
  recipe["files"] = recipe_files(files);
  files["recipe.json"] = io::json_text(recipe);
  return files;
}

} // namespace frictab::codegen
