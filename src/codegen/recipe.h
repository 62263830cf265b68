// recipe.json: the parts every target has in common.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/entry_arguments.h"
#include "codegen/exporter.h"

namespace frictab::codegen {

// schema, target, model, form (table or direct), data_origin, units, entry, files,
// signature_source; values_file, where the files hold one.
nlohmann::ordered_json recipe_head(const Exporter& exporter, const ExportRequest& request,
                                   const std::string& entry, const SourceBundle& files);

// Of a target whose entry is frictab_tau_R: arguments, each of `type` where the language has its
// own, result, derivatives; no state variables and no properties.
void describe_entry(nlohmann::ordered_json& recipe, const ExportRequest& request,
                    const std::vector<InputArgument>& inputs, const std::string& type = "");

// The table's axes with ranges, how the value becomes tau_R, and the drift it is known for.
nlohmann::ordered_json recipe_table(const ExportRequest& request);

// Whose law it is about; empty where it does not say.
std::string model_of_recipe(const std::string& text, const std::string& file);

// Whether a recipe's sources hold the law itself.
bool is_direct_recipe(const std::string& text, const std::string& file);

// The files that a recipe lists, relative to its directory. Throws InputError where the text is no
// recipe, or a name leads out of the directory.
std::vector<std::string> files_of_recipe(const std::string& text, const std::string& file);

} // namespace frictab::codegen
