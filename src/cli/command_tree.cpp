// Walks CLI11's options.
#include "cli/command_tree.h"

#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>

#include "cli/explanation.h"
#include "codegen/exporter.h"
#include "core/names.h"
#include "job/literature.h"

namespace frictab::cli {

namespace {

std::vector<std::string> target_names() {
  std::vector<std::string> names = all_names(codegen::all_exporters(), &codegen::Exporter::name);
  names.insert(names.begin(), "all");
  return names;
}

const CLI::App& root_of(const CLI::App& app) {
  const CLI::App* root = &app;
  while (root->get_parent())
    root = root->get_parent();
  return *root;
}

std::vector<std::string> command_names(const CLI::App& app) {
  return all_names(root_of(app).get_subcommands({}), &CLI::App::get_name);
}

// Possible values: "TEXT:{csv,hdf5}" of CLI::IsMember, "{models,effects}", or registered names.
std::vector<std::string> words_of(const CLI::App& app, const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open != type.npos && close != type.npos)
    return pieces(type.substr(open + 1, close - open - 1), ',');
  if (type == "LAW") return job::literature().names();
  if (type == "TARGETS") return target_names();
  if (type == "NAME" && option.get_positional()) return explainable();
  if (type == "COMMAND") return command_names(app);
  return {};
}

// Returns the name of the value; CLI11's own "TEXT" is less clear than the option's name.
std::string value_name(const CLI::Option& option) {
  std::string type = option.get_type_name();
  type.resize(std::min(type.size(), type.find(':'))); // removes the description of a check
  const bool unsaid = type.starts_with("TEXT") || type.starts_with("FLOAT") ||
                      type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("{");
  if (option.get_positional()) return option.get_name(true);
  if (!unsaid) return type;
  return type.starts_with("TEXT") || type.starts_with("{") ? "TEXT" : "X";
}

OptionText text_of(const CLI::App& app, const CLI::Option& option) {
  OptionText out;
  for (const std::string& name : option.get_snames())
    out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames())
    out.names.push_back("--" + name);
  out.description = option.get_description();
  if (option.get_items_expected_max() > 0) {
    out.value = value_name(option);
    out.words = words_of(app, option);
  }
  out.many = option.get_expected_max() > 1;
  return out;
}

CommandText text_of(const CLI::App& app, const std::string& above) {
  CommandText out{above + app.get_name(), app.get_description(), app.get_footer(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? out.places : out.options).push_back(text_of(app, *option));
  }
  for (const CLI::App* sub : app.get_subcommands({}))
    out.below.push_back(text_of(*sub, out.name + " "));
  return out;
}

void add(std::vector<const CommandText*>& all, const CommandText& command) {
  all.push_back(&command);
  for (const CommandText& below : command.below)
    add(all, below);
}

} // namespace

OptionText::Kind OptionText::kind() const {
  if (!words.empty()) return Kind::words;
  if (value == "DIR" || value == "OUT") return Kind::directory;
  for (const char* file : {"FILE", "FILES", "JOB", "JOB|MODEL", "STUDY", "DATA", "A", "B"})
    if (value == file) return Kind::file;
  return Kind::other;
}

std::vector<std::string> pieces(const std::string& text, char separator) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string piece; std::getline(stream, piece, separator);)
    out.push_back(piece);
  return out;
}

CommandText command_tree(const CLI::App& app) {
  return text_of(root_of(app), "");
}

std::vector<const CommandText*> all_commands(const CommandText& root) {
  std::vector<const CommandText*> all;
  add(all, root);
  return all;
}

} // namespace frictab::cli
