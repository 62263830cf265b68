// frictab completion bash|zsh|fish|powershell: a script that completes commands, options and their
// values.
#include <array>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/command_tree.h"
#include "cli/print.h"
#include "core/error.h"
#include "core/text.h"

namespace frictab::cli::completion_command {

std::string quoted(const std::string& text) {
  return "'" + replace_all(text, "'", "'\\''") + "'";
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::vector<std::string> names_below(const CommandText& command) {
  std::vector<std::string> names;
  for (const CommandText& below : command.below)
    names.push_back(below.last_name());
  return names;
}

// The text of a script for the kind of value that an option or argument takes.
std::string by_kind(const OptionText& option, const std::string& words,
                    const std::string& directory, const std::string& file,
                    const std::string& other) {
  switch (option.kind()) {
  case OptionText::Kind::words:
    return words;
  case OptionText::Kind::directory:
    return directory;
  case OptionText::Kind::file:
    return file;
  case OptionText::Kind::other:
    break;
  }
  return other;
}

// ---- bash ----

// An option's value may begin after '=', and a list continues after a comma.
constexpr const char* bash_head = R"(# bash completion of frictab, made by `frictab completion bash`
_frictab_values() { # kind [WORD ...]
  local kind=$1
  shift
  case $kind in
  words)
    local before=
    [[ $cur != *,* ]] || before=${cur%,*},
    mapfile -t COMPREPLY < <(compgen -P "$before" -W "$*" -- "${cur##*,}")
    ;;
  directory)
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -d -- "$cur")
    ;;
  file)
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
    ;;
  esac
}

_frictab() {
  local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} at=frictab word
  if [[ $cur == = ]]; then
    cur=
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$at $word" in
)";

constexpr const char* bash_tail = R"(  esac
}
complete -F _frictab frictab
)";

std::string bash_value(const OptionText& option) {
  return by_kind(option, "words " + join(option.words, " "), "directory", "file", "other");
}

std::string bash_of(const CommandText& command) {
  std::string out = fmt::format("  {})\n    case $before in\n", quoted(command.name));
  std::vector<std::string> names;
  for (const OptionText& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (!option.value.empty())
      out += fmt::format("    {}) _frictab_values {}; return ;;\n", join(option.names, " | "),
                         bash_value(option));
  }
  out += fmt::format("    esac\n    if [[ $cur == -* ]]; then\n      _frictab_values words {}\n",
                     join(names, " "));
  if (!command.below.empty())
    out +=
        fmt::format("    else\n      _frictab_values words {}\n", join(names_below(command), " "));
  else if (!command.places.empty())
    out += fmt::format("    else\n      _frictab_values {}\n", bash_value(command.places.front()));
  return out + "    fi\n    ;;\n";
}

std::string bash(const std::vector<const CommandText*>& commands) {
  std::string out = bash_head;
  for (const CommandText* command : commands)
    if (command != commands.front())
      out += fmt::format("    {}) at+=\" $word\" ;;\n", quoted(command->name));
  out += "    esac\n  done\n  case $at in\n";
  for (const CommandText* command : commands)
    out += bash_of(*command);
  return out + bash_tail;
}

// ---- zsh ----

// Escapes text in "[...]" of a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : first_line(text)) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_action(const OptionText& option) {
  const std::string words = join(option.words, " ");
  return by_kind(option,
                 option.value == "TARGETS" ? "_values -s , target " + words : "(" + words + ")",
                 "_files -/", "_files", " "); // a blank: nothing to offer
}

std::string zsh_option(const OptionText& option) {
  std::string out;
  const std::string value =
      option.value.empty() ? "" : ":" + zsh_text(option.value) + ":" + zsh_action(option);
  for (const std::string& name : option.names)
    out += " \\\n      " + quoted("(" + join(option.names, " ") + ")" + name +
                                  (value.empty() || name.size() == 2 ? "" : "=") + "[" +
                                  zsh_text(option.description) + "]" + value);
  return out;
}

std::string zsh_of(const CommandText& command) {
  std::string out = fmt::format("  ({})\n", quoted(command.name));
  if (!command.below.empty()) {
    out += "    local -a commands=(";
    for (const CommandText& below : command.below)
      out += " \\\n      " + quoted(below.last_name() + ":" + replace_all(below.title, ":", "\\:"));
    out += ")\n    [[ $PREFIX == -* ]] || _describe command commands\n";
  }
  out += "    _arguments";
  for (const OptionText& option : command.options)
    out += zsh_option(option);
  for (const OptionText& place : command.places)
    out += " \\\n      " +
           quoted((place.many ? "*:" : ":") + zsh_text(place.value) + ":" + zsh_action(place));
  return out + "\n    ;;\n";
}

std::string zsh(const std::vector<const CommandText*>& commands) {
  std::string out = "#compdef frictab\n# zsh completion of frictab, made by `frictab completion "
                    "zsh`\n_frictab() {\n  local at=frictab word\n  integer i depth=1\n"
                    "  for ((i = 2; i < CURRENT; i++)); do\n    word=$words[i]\n"
                    "    case \"$at $word\" in\n";
  for (const CommandText* command : commands)
    if (command != commands.front())
      out += fmt::format("    ({}) at+=\" $word\"; depth=i ;;\n", quoted(command->name));
  out += "    esac\n  done\n  words=(\"${(@)words[depth,-1]}\")\n  ((CURRENT -= depth - 1))\n"
         "  case $at in\n";
  for (const CommandText* command : commands)
    out += zsh_of(*command);
  return out + "  esac\n}\n_frictab \"$@\"\n";
}

// ---- fish ----

std::string fish_quoted(const std::string& text) {
  return "'" + replace_all(replace_all(text, "\\", "\\\\"), "'", "\\'") + "'";
}

std::string fish_option(const OptionText& option, const std::string& here) {
  std::string out = here;
  for (const std::string& name : option.names)
    out += name.size() == 2 ? " -s " + name.substr(1) : " -l " + name.substr(2);
  out += " -d " + fish_quoted(first_line(option.description));
  if (option.value.empty()) return out + "\n";
  return out +
         by_kind(option, " -x -a " + fish_quoted(join(option.words, " ")),
                 " -x -a '(__fish_complete_directories)'", " -r -F", " -x") +
         "\n";
}

std::string fish_of(const CommandText& command) {
  const std::string here =
      fmt::format("complete -c frictab -n \"test (__frictab_at) = '{}'\"", command.name);
  std::string out;
  for (const CommandText& below : command.below)
    out += fmt::format("{} -f -a {} -d {}\n", here, below.last_name(), fish_quoted(below.title));
  for (const OptionText& option : command.options)
    out += fish_option(option, here);
  for (const OptionText& place : command.places)
    if (!place.words.empty())
      out += fmt::format("{} -f -a {}\n", here, fish_quoted(join(place.words, " ")));
  return out;
}

std::string fish(const std::vector<const CommandText*>& commands) {
  std::string out = "# fish completion of frictab, made by `frictab completion fish`\n"
                    "function __frictab_at\n  set -l at frictab\n"
                    "  for word in (commandline -opc)[2..-1]\n    switch \"$at $word\"\n      case";
  for (const CommandText* command : commands)
    if (command != commands.front()) out += " " + fish_quoted(command->name);
  out += "\n        set at \"$at $word\"\n    end\n  end\n  echo $at\nend\n";
  for (const CommandText* command : commands)
    out += fish_of(*command);
  return out;
}

// ---- PowerShell ----

constexpr const char* powershell_tail = R"(}
Register-ArgumentCompleter -Native -CommandName frictab -ScriptBlock {
  param($wordToComplete, $commandAst, $cursorPosition)
  $at = 'frictab'
  $before = ''
  foreach ($element in $commandAst.CommandElements | Select-Object -Skip 1) {
    if ($element.Extent.EndOffset -ge $cursorPosition) { break }
    $before = $element.ToString()
    if ($frictabCommands.ContainsKey("$at $before")) { $at = "$at $before" }
  }
  $known = $frictabCommands[$at]
  if ($known.Values.ContainsKey($before)) { $offered = $known.Values[$before] }
  elseif ($wordToComplete -like '-*') { $offered = $known.Options }
  else { $offered = $known.Words }
  $offered | Where-Object { $_ -like "$wordToComplete*" } | ForEach-Object {
    [System.Management.Automation.CompletionResult]::new($_, $_, 'ParameterValue', $_)
  }
}
)";

std::string powershell_list(const std::vector<std::string>& words) {
  std::vector<std::string> quoted_words;
  for (const std::string& word : words)
    quoted_words.push_back("'" + replace_all(word, "'", "''") + "'");
  return "@(" + join(quoted_words, ", ") + ")";
}

// Offers names of files (nothing of its own) where a value is one.
std::string powershell_of(const CommandText& command) {
  std::vector<std::string> options, words = names_below(command), values;
  for (const OptionText& option : command.options)
    for (const std::string& name : option.names) {
      options.push_back(name);
      if (!option.value.empty())
        values.push_back(fmt::format("'{}' = {}", name, powershell_list(option.words)));
    }
  for (const OptionText& place : command.places)
    words.insert(words.end(), place.words.begin(), place.words.end());
  return fmt::format("  '{}' = @{{\n    Options = {}\n    Words = {}\n    Values = @{{ {} }}\n"
                     "  }}\n",
                     command.name, powershell_list(options), powershell_list(words),
                     join(values, "; "));
}

std::string powershell(const std::vector<const CommandText*>& commands) {
  std::string out = "# PowerShell completion of frictab, made by `frictab completion "
                    "powershell`\n$frictabCommands = @{\n";
  for (const CommandText* command : commands)
    out += powershell_of(*command);
  return out + powershell_tail;
}

// ---- the command ----

struct Shell {
  const char* name;
  std::string (*script)(const std::vector<const CommandText*>& commands);
};
constexpr std::array<Shell, 4> shells = {
    {{"bash", bash}, {"zsh", zsh}, {"fish", fish}, {"powershell", powershell}}};

int run(const CLI::App& app, const std::string& shell) {
  const CommandText root = command_tree(app);
  const std::vector<const CommandText*> commands = all_commands(root);
  for (const Shell& known : shells)
    if (shell == known.name) {
      print_out("{}", known.script(commands));
      return 0;
    }
  throw InputError({}, fmt::format("there is no completion for '{}'", shell),
                   "frictab completion bash, zsh, fish or powershell");
}

std::function<int()> declare(CLI::App& app, const CommonOptions&) {
  const auto shell = std::make_shared<std::string>();
  app.add_option("SHELL", *shell, "bash, zsh, fish or powershell")
      ->required()
      ->type_name("{bash,zsh,fish,powershell}");
  return [shell, &app] { return run(app, *shell); };
}

const Registered<Command> registered{[] {
  return Command{
      "completion",
      84,
      "Completion of commands, options and their values for a shell",
      declare,
      0,
      {{"frictab completion bash > ~/.local/share/bash-completion/completions/frictab", "bash"},
       {"frictab completion fish > ~/.config/fish/completions/frictab.fish", "fish"},
       {"frictab completion powershell > frictab.ps1",
        "PowerShell; $PROFILE then has: . ./frictab.ps1"},
       {"frictab completion zsh > ~/.zfunc/_frictab", "zsh, with ~/.zfunc in fpath"}}};
}};

} // namespace frictab::cli::completion_command
