// The parts of recipe.json that do not depend on the target.
#include "codegen/recipe.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "codegen/combine.h"
#include "codegen/prefix.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "core/error.h"
#include "core/version.h"
#include "io/json.h"
#include "table/outside.h"

namespace frictab::codegen {

namespace {

using json = nlohmann::ordered_json;

constexpr const char* schema = "frictab/recipe/1";

json unit_names(const SolverUnits& units) {
  return {{"system", units.system().name},
          {"stress", solver_unit("MPa", units).name},
          {"speed", solver_unit("mm/s", units).name},
          {"length", solver_unit("mm", units).name},
          {"time", solver_unit("s", units).name},
          {"force", solver_unit("N", units).name},
          {"temperature", solver_unit("degC", units).name}};
}

json axis_json(const table::TableAxis& axis, std::size_t bit, const InputArgument& input) {
  return {{"name", axis.name},
          {"unit", axis.unit},
          {"meaning", input.meaning},
          {"range", {axis.nodes.front(), axis.nodes.back()}},
          {"nodes", axis.nodes.size()},
          {"transform", axis.log ? "log" : "linear"},
          {"outside_bit", bit},
          {"outside", {table::outside_name(axis.below), table::outside_name(axis.above)}}};
}

} // namespace

std::vector<std::string> recipe_files(const SourceBundle& files) {
  std::vector<std::string> names;
  for (const auto& [path, content] : files)
    if (path != "recipe.json") names.push_back(path);
  names.push_back("recipe.json");
  return names;
}

json recipe_head(const Exporter& exporter, const ExportRequest& request, const std::string& entry,
                 const SourceBundle& files) {
  json out = {{"schema", schema},
              {"target", exporter.name},
              {"title", exporter.title},
              {"tool_version", tool_version()},
              {"model", request.table.model},
              {"form", request.table.is_direct() ? "direct" : "table"},
              {"data_origin", origin_text(request.table)},
              {"units", unit_names(request.units)},
              {"entry", entry},
              {"files", recipe_files(files)},
              {"signature_source", exporter.signature_source}};
  if (has_prefix(request)) out["prefix"] = prefix(request);
  if (const auto values = files.find(values_file_name); values != files.end())
    out["values_file"] = values_file_json(values->second);
  return out;
}

void describe_entry(json& recipe, const ExportRequest& request,
                    const std::vector<InputArgument>& inputs, const std::string& type) {
  recipe["arguments"] = json::array();
  for (const InputArgument& input : inputs) {
    json argument = {{"name", input.argument}, {"quantity", input.name}};
    if (!type.empty()) argument["type"] = type;
    argument["unit"] = input.solver.name;
    argument["meaning"] = input.meaning;
    argument["used"] = input.used;
    argument["range"] = range_text(input, request.table);
    recipe["arguments"].push_back(std::move(argument));
  }
  recipe["result"] = {{"unit", solver_unit("MPa", request.units).name},
                      {"meaning", "frictional shear stress tau_R"}};
  recipe["derivatives"] = {{"meaning", "of tau_R by every argument, in the order of the arguments"},
                           {"unit", "unit of the result per unit of the argument"},
                           {"where_not_used", 0}};
  recipe["state_variables"] = json::array();
  recipe["properties"] = json::array();
}

json recipe_table(const ExportRequest& request) {
  const table::Table& table = request.table;
  const std::vector<InputArgument> inputs = entry_arguments(table, request.units);
  json axes = json::array();
  for (const table::TableAxis& axis : table.axes)
    axes.push_back(axis_json(axis, axes.size(), argument_named(inputs, axis.name)));
  json held = json::array();
  for (const table::AxisEnds& end : table::clamped_input_ends(table))
    held.push_back({{"name", end.name},
                    {"range", {end.low, end.high}},
                    {"outside_bit", axes.size() + held.size()}});
  json out = {{"axes", axes},
              {"held_inputs", held},
              {"quantity", models::quantity_name(table.quantity)},
              {"transform", table.log_value ? "log" : "linear"},
              {"interpolation", table::interpolation_name(table.interpolation)},
              {"combine", expr::to_text(table.combine)},
              {"constants", table.constants},
              {"worst_case_MPa", nullptr},
              {"outside",
               "[below, above] each axis' range: clamp = the value at that end, error = NaN, law = "
               "the law's own formula; what stands in combine enters it unchanged"}};
  if (table.is_direct())
    for (const char* of_the_table : {"transform", "interpolation", "worst_case_MPa"})
      out.erase(of_the_table);
  if (table.is_direct())
    for (json& axis : out["axes"])
      axis.erase("nodes"), axis.erase("transform");
  const table::TableRecord& record = table.record;
  out["drift"] = drift_text(table);
  if (record.tolerance_MPa) out["tolerance_MPa"] = *record.tolerance_MPa;
  out["beyond_range"] = outside_rule(table, "NaN, or the end of the analysis");
  if (record.worst_case_MPa) out["worst_case_MPa"] = *record.worst_case_MPa;
  if (record.proven_drift_MPa) out["proven_drift_MPa"] = *record.proven_drift_MPa;
  if (table.drift_is_claimed && record.worst_case_MPa)
    out["drift_is_claimed_by"] = "the table's file";
  return out;
}

std::string recipe_of_text(json recipe, const ExportRequest& request,
                           const std::string& input_deck) {
  for (const char* none : {"state_variables", "properties", "compile"})
    recipe[none] = json::array();
  recipe["input_deck"] = input_deck;
  recipe["table"] = recipe_table(request);
  return io::json_text(recipe);
}

void add_fixed_states(json& recipe, const table::FixedStates& fixed) {
  recipe["held"] = json::object();
  for (const auto& [name, value] : fixed)
    recipe["held"][name] = value;
  recipe["held_note"] =
      "in canonical units; what that costs on the validation rows is in verify.json";
}

namespace {

// Reads the recipe of one law, or of several in one user file.
json read_recipe(const std::string& text, const std::string& file) {
  json recipe = io::parse_json(text, file);
  const bool combined = recipe.is_object() && recipe.value("schema", json()) == combined_schema;
  io::check_schema(recipe, combined ? combined_schema : schema, file, "export again");
  return recipe;
}

} // namespace

bool is_direct_recipe(const std::string& text, const std::string& file) {
  return read_recipe(text, file).value("form", json("table")) == "direct";
}

std::string model_of_recipe(const std::string& text, const std::string& file) {
  const json model = read_recipe(text, file).value("model", json(""));
  return model.is_string() ? model.get<std::string>() : "";
}

std::vector<std::string> files_of_recipe(const std::string& text, const std::string& file) {
  const json recipe = read_recipe(text, file);
  std::vector<std::string> files;
  if (recipe.contains("files") && recipe.at("files").is_array())
    for (const json& name : recipe.at("files"))
      if (name.is_string()) files.push_back(name.get<std::string>());
  for (const std::string& name : files) {
    const std::filesystem::path path = name;
    if (path.is_absolute() || name.find("..") != std::string::npos)
      throw InputError({file, 0, 0}, "the file name '" + name + "' leads out of the directory");
  }
  if (files.empty())
    throw InputError({file, 0, 0}, "this is not a recipe of generated sources: it lists no files",
                     "export again");
  return files;
}

} // namespace frictab::codegen
