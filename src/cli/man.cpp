// frictab man: manual pages, made from the options themselves.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/command_tree.h"
#include "cli/print.h"
#include "cli/topics.h"
#include "core/error.h"
#include "core/text.h"
#include "core/version.h"
#include "io/atomic_file.h"

namespace frictab::cli::man_command {

// Escapes text for roff: no request at the start of a line, hyphens that can be searched for and
// copied. A long line of settings may be broken at its separators.
std::string roff(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool starts_line = out.empty() || out.back() == '\n';
    if (starts_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    const bool within = i + 1 < text.size() && text[i + 1] != ' ' && text[i + 1] != '\n';
    if ((c == ';' || c == ',') && within) out += "\\:";
  }
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + roff(text) + "\\fR";
}

std::string page_name(const CommandText& command) {
  return replace_all(command.name, " ", "-");
}

std::string synopsis(const CommandText& command) {
  std::string line = ".B " + roff(command.name) + "\n";
  if (!command.below.empty()) line += italic("COMMAND") + " ...\n";
  if (!command.options.empty()) line += "[" + italic("OPTIONS") + "]\n";
  for (const OptionText& place : command.places)
    line += "[" + italic(place.value) + "]" + (place.many ? " ..." : "") + "\n";
  return line;
}

std::string option_text(const OptionText& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names)
    names.push_back(bold(name));
  std::string head = names.empty() ? italic(option.value) : join(names, ", ");
  if (!names.empty() && !option.value.empty()) head += " " + italic(option.value);
  return ".TP\n" + head + "\n" + roff(option.description) + "\n";
}

// Converts "  frictab run   # what it does", the form of help's footer.
std::string examples(const std::string& footer) {
  std::string out;
  for (const std::string& line : pieces(footer, '\n'))
    if (const std::size_t mark = line.find("  # ");
        line.starts_with("  frictab ") && mark != line.npos) {
      const std::size_t end = line.find_last_not_of(' ', mark);
      out += ".TP\n" + bold(line.substr(2, end - 1)) + "\n" + roff(line.substr(mark + 4)) + "\n";
    }
  return out;
}

std::string exit_status() {
  std::string out = ".SH EXIT STATUS\n";
  const std::optional<Explanation> codes = explain_topic("exit-codes");
  for (const Explanation::Item& code : codes->items)
    out += ".TP\n" + bold(code.name) + "\n" + roff(code.text) + "\n";
  return out;
}

std::string page_of(const CommandText& command) {
  std::string out = fmt::format(
      ".TH {} 1 \"\" \"frictab {}\" \"User Commands\"\n.ad l\n.nh\n.SH NAME\n{} \\- {}\n",
      roff(page_name(command)), tool_version(), roff(page_name(command)), roff(command.title));
  out += ".SH SYNOPSIS\n" + synopsis(command);
  if (!command.below.empty()) {
    out += ".SH COMMANDS\n";
    for (const CommandText& below : command.below)
      out += ".TP\n" + bold(below.last_name()) + "\n" + roff(below.title) + "; see " +
             bold(page_name(below)) + "(1)\n";
  }
  out += ".SH OPTIONS\n";
  for (const std::vector<OptionText>* some : {&command.places, &command.options})
    for (const OptionText& option : *some)
      out += option_text(option);
  if (const std::string shown = examples(command.footer); !shown.empty())
    out += ".SH EXAMPLES\n" + shown;
  out += exit_status();
  const bool is_root = command.name.find(' ') == command.name.npos;
  return out + ".SH SEE ALSO\n" +
         (is_root ? "frictab help exit\\-codes, frictab explain job\n" : bold("frictab") + "(1)\n");
}

int write_all(const std::vector<const CommandText*>& commands, const CommonOptions& common) {
  io::OutputFiles files(common.output, io::OutputFiles::Claim::one_file);
  for (const CommandText* command : commands)
    files.write(page_name(*command) + ".1", page_of(*command));
  commit(files, common.output, common);
  return 0;
}

int run(const CommandText& root, const std::vector<std::string>& words,
        const CommonOptions& common) {
  const std::vector<const CommandText*> commands = all_commands(root);
  if (!common.output.empty()) return write_all(commands, common);
  const std::string name = words.empty() ? root.name : root.name + " " + join(words, " ");
  std::vector<std::string> known;
  for (const CommandText* command : commands) {
    known.push_back(command->name);
    if (command->name != name) continue;
    print_out("{}", page_of(*command));
    return 0;
  }
  throw InputError({}, fmt::format("there is no command '{}'", name), suggest(name, known));
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto words = std::make_shared<std::vector<std::string>>();
  app.add_option("COMMAND", *words, "Of this command; of frictab itself without one")
      ->type_name("COMMAND");
  return [words, &app, &common] { return run(command_tree(app), *words, common); };
}

const Registered<Command> registered{[] {
  return Command{"man",
                 83,
                 "Manual page of a command, as troff; with -o DIR of all commands",
                 declare,
                 uses_output | uses_force,
                 {{"frictab man table slice > slice.1", "to be read by man -l slice.1"},
                  {"frictab man -o man1", "one file per command"}}};
}};

} // namespace frictab::cli::man_command
