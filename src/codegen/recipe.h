// recipe.json: the parts that all targets share.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"

namespace frictab::codegen {

// Lists the files of a bundle and its recipe, for the key `files`.
std::vector<std::string> recipe_files(const SourceBundle& files);

// Returns schema, target, model, form (table or direct), data_origin, units, entry, files,
// signature_source; prefix, if the request has one; values_file, if the files include one.
nlohmann::ordered_json recipe_head(const Exporter& exporter, const ExportRequest& request,
                                   const std::string& entry, const SourceBundle& files);

// Adds the description of a target whose entry is frictab_tau_R: arguments, each with `type` if the
// language has its own, result, derivatives; no state variables and no properties.
void describe_entry(nlohmann::ordered_json& recipe, const ExportRequest& request,
                    const std::vector<InputArgument>& inputs, const std::string& type);

// Returns the text of a recipe for a solver that reads a text instead of compiling a routine: adds
// the lines of the deck, recipe_table(), and empty state variables, properties and build commands.
std::string recipe_of_text(nlohmann::ordered_json recipe, const ExportRequest& request,
                           const std::string& input_deck);

// Adds the fixed states of a solver's own table: held, held_note.
void add_fixed_states(nlohmann::ordered_json& recipe, const table::FixedStates& fixed);

// Returns the table's axes with ranges, the step from the value to tau_R, and the known drift.
nlohmann::ordered_json recipe_table(const ExportRequest& request);

// Returns the name of the law in the recipe; empty if it has none.
std::string model_of_recipe(const std::string& text, const std::string& file);

// True if a recipe's sources have the law itself.
bool is_direct_recipe(const std::string& text, const std::string& file);

// Returns the files that a recipe lists, relative to its directory. Throws InputError if the text
// is not a recipe, or a name leads out of the directory.
std::vector<std::string> files_of_recipe(const std::string& text, const std::string& file);

} // namespace frictab::codegen
