// The commands and options as plain data, read off the parser: what man pages and completion are
// made from, so that neither can name what is not there.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace frictab::cli {

struct OptionText {
  std::vector<std::string> names; // "-o", "--output"; none: it is given by its place
  std::string value;              // "DIR"; empty: a flag
  std::string description;
  std::vector<std::string> words; // what a value may be, where these are few or known by name
  bool many = false;              // values by place: any number of them
  enum class Kind { words, directory, file, other };
  Kind kind() const;
};

struct CommandText {
  std::string name; // "frictab table slice"
  std::string title;
  std::string footer;
  std::vector<OptionText> options; // those that help shows
  std::vector<OptionText> places;  // values by place
  std::vector<CommandText> below;

  std::string last_name() const { return name.substr(name.rfind(' ') + 1); }
};

// Of the root that `app` belongs to.
CommandText command_tree(const CLI::App& app);

// What stands between separators.
std::vector<std::string> pieces(const std::string& text, char separator);

// It and all below it, in the order of help.
std::vector<const CommandText*> all_commands(const CommandText& root);

} // namespace frictab::cli
