// The commands and options as plain data, read from the parser. Man pages and completion are made
// from them, so that neither can name what does not exist.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace frictab::cli {

struct OptionText {
  std::vector<std::string> names; // "-o", "--output"; empty: a positional argument
  std::string value;              // "DIR"; empty: a flag
  std::string description;
  std::vector<std::string> words; // possible values, where these are few or registered names
  bool many = false;              // positional: takes any number of values
  enum class Kind { words, directory, file, other };
  Kind kind() const;
};

struct CommandText {
  std::string name; // "frictab table slice"
  std::string title;
  std::string footer;
  std::vector<OptionText> options; // options that help shows
  std::vector<OptionText> places;  // positional arguments
  std::vector<CommandText> below;

  std::string last_name() const { return name.substr(name.rfind(' ') + 1); }
};

// Returns the tree of the root to which `app` belongs.
CommandText command_tree(const CLI::App& app);

// Splits the text at the separator.
std::vector<std::string> pieces(const std::string& text, char separator);

// Returns the command and all below it, in the order of help.
std::vector<const CommandText*> all_commands(const CommandText& root);

} // namespace frictab::cli
