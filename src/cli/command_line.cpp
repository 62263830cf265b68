// Builds the CLI11 application from the registered commands.
#include "cli/command_line.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <new>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/colour.h"
#include "cli/command.h"
#include "cli/command_tree.h"
#include "cli/help_format.h"
#include "cli/print.h"
#include "core/error.h"
#include "core/large_work.h"
#include "core/os/machine.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/version.h"
#include "io/atomic_file.h"

namespace frictab::cli {

namespace {

constexpr unsigned most_threads = 1024; // each thread takes memory, used or not
// the limit of a job file
constexpr std::uint64_t largest_seed = std::numeric_limits<std::int64_t>::max();

const char* const exit_codes = "Exit codes: 0 done; 1 a target was missed (drift over tolerance); "
                               "2 usage, job file or input data wrong; 3 anything else.";

// Parses an unsigned number strictly: the library wraps numbers around or limits them silently.
template <class Number>
Number whole_number(const char* option, const std::string& text, Number most) {
  Number value = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end || text.empty() || value > most)
    throw CLI::ConversionError(
        fmt::format("{}: '{}' is not a whole number from 0 to {}", option, text, most));
  return value;
}

// CLI11's own checks accept nan, and print the largest double with all its digits.
std::string fault_of_number(const std::string& text, const char* wanted, bool may_be_0) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  const bool good = error == std::errc() && stopped == end && std::isfinite(value) &&
                    (value > 0 || (may_be_0 && value == 0));
  return good ? "" : fmt::format("'{}' is not {}", text, wanted);
}

std::string footer_of(const Command& command) {
  std::string text;
  std::size_t width = 0;
  for (const Example& example : command.examples)
    width = std::max(width, example.command.size());
  for (const Example& example : command.examples)
    text += fmt::format("  {:<{}}  # {}\n", example.command, width, example.does);
  if (!text.empty()) text = "Examples:\n" + text + "\n";
  return text + exit_codes;
}

// Adds the options that the command does not use without a group: they are accepted and not shown.
void add_common(CLI::App& app, CommonOptions& common, unsigned uses) {
  const auto shown = [uses](CLI::Option* option, unsigned use) {
    if ((uses & use) == 0) option->group("");
  };
  const auto number = [&app](const char* names, const char* text, const auto& take) {
    return app.add_option_function<std::string>(names, take, text)->type_name("N");
  };
  shown(app.add_option("-o,--output", common.output, "Output directory, instead of the job's")
            ->type_name("DIR"),
        uses_output);
  shown(app.add_flag("--force", common.force, "Overwrite files that frictab would leave alone"),
        uses_force);
  shown(number("-j,--threads", "Threads; 0 = all cores",
               [&common](const std::string& text) {
                 common.threads = whole_number("--threads", text, most_threads);
               }),
        uses_threads);
  shown(app.add_flag("-q,--quiet", common.quiet, "Nothing on stderr unless something fails"),
        uses_quiet);
  shown(
      app.add_flag("-v,--verbose", common.verbose, "Say more: the whole summary, notes on stderr"),
      uses_verbose);
  shown(app.add_flag("--json", common.json, "Print the result as JSON"), uses_json);
  shown(number("--seed", "Random seed: the same seed gives the same bytes",
               [&common](const std::string& text) {
                 common.seed = whole_number("--seed", text, largest_seed);
               }),
        uses_seed);
  shown(app.add_option("--set", common.set, "Override a job key: --set table.tolerance_MPa=0.1")
            ->type_name("KEY=VALUE")
            ->take_all()
            ->allow_extra_args(false),
        uses_set);
  shown(app.add_flag_function(
            "--progress,!--no-progress",
            [&common](std::int64_t count) { common.progress = count > 0; },
            "Progress line on or off; otherwise on a terminal only"),
        uses_progress);
  shown(app.add_option_function<std::string>(
               "--color",
               [](const std::string& text) {
                 choose_colour(text == "always"  ? Colour::always
                               : text == "never" ? Colour::never
                                                 : Colour::automatic);
               },
               "Colours of the summary and of errors; auto: on a terminal, unless NO_COLOR is set")
            ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
            ->type_name("{auto,always,never}"),
        uses_progress);
  if (uses & uses_dry_run)
    app.add_flag("--dry-run", common.dry_run,
                 "Say what would run, what is kept and what would be written; write nothing");
}

// Rejects -o "$OUT" of a script whose OUT is empty: the results would go to the job's directory.
void check_output(const CLI::App& app, const CommonOptions& common) {
  if (app.count("--output") > 0 && common.output.empty())
    throw InputError({"-o", 0, 0}, "the output directory has an empty name",
                     "give -o DIR a name; without -o the job says where");
}

void set_help_options(CLI::App& app) {
  app.set_help_flag("-h", "Short help");
  app.set_help_all_flag("--help", "Help with examples");
}

// Pairs each subcommand with the function that runs it.
using Runners = std::vector<std::pair<CLI::App*, std::function<int()>>>;

// Chooses the progress display; a terminal with TERM=dumb cannot replace a line.
ProgressStyle progress_style(const CommonOptions& common) {
  const char* const terminal = std::getenv("TERM");
  const bool draws =
      os::is_terminal(stderr) && terminal && *terminal && terminal != std::string_view("dumb");
  if (common.quiet || !common.progress.value_or(draws)) return ProgressStyle::off;
  return draws ? ProgressStyle::line : ProgressStyle::lines;
}

int run_chosen(const Runners& runners, const CommonOptions& common) {
  set_threads(common.threads);
  show_progress(progress_style(common));
  for (const auto& [app, run] : runners)
    if (app->parsed()) {
      check_output(*app, common);
      return run();
    }
  return 2;
}

// Names of the commands below `group` ("" for the top).
std::vector<std::string> commands_of(const std::string& group) {
  std::vector<std::string> names;
  const std::string before = group.empty() ? "" : group + " ";
  for (const Command& command : Registry<Command>::instance().all())
    if (command.name.starts_with(before)) {
      const std::string name = command.name.substr(before.size());
      if (name.find(' ') == name.npos) names.push_back(name);
    }
  return names;
}

// The command that the words name, as far as they do: "table slice". Options and their values may
// stand before it and between its words.
std::string command_in(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) {
    const std::vector<std::string> below = commands_of(command);
    if (std::ranges::find(below, word) != below.end())
      command += (command.empty() ? "" : " ") + word;
  }
  return command;
}

const CLI::App& app_of(const CLI::App& root, const std::string& command) {
  const CLI::App* app = &root;
  for (const std::string& word : pieces(command, ' '))
    app = app->get_subcommand(word);
  return *app;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
    for (const std::string& name : option->get_snames())
      names.push_back("-" + name);
  }
  return names;
}

// The first word that looks like an option, and that neither the command nor the program has;
// empty: none.
std::string unknown_option(const std::vector<std::string>& words,
                           const std::vector<std::string>& known) {
  for (const std::string& word : words) {
    if (word == "--") break;
    const bool is_long = word.starts_with("--");
    if (!is_long && !(word.size() > 1 && word[0] == '-' && std::isalpha(word[1] & 0xff))) continue;
    const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
    if (std::ranges::find(known, name) == known.end()) return is_long ? name : word;
  }
  return "";
}

// "frictab table slice" for the command "table slice", "frictab" for none.
std::string with_program(const std::string& command) {
  return command.empty() ? "frictab" : "frictab " + command;
}

// Returns the message for arguments that cannot be used, with its hint.
std::string usage_fault(const CLI::App& app, const CLI::ParseError& error,
                        const std::vector<std::string>& words) {
  const std::string command = command_in(words), program = with_program(command);
  const std::vector<std::string> below = commands_of(command);
  const std::vector<std::string> known = options_of(app_of(app, command));
  if (const std::string option = unknown_option(words, known); !option.empty()) {
    // Any letter is near any other.
    std::string near = option.starts_with("--") ? nearest_name(option, known) : "";
    if (!near.empty()) near = "did you mean " + near + "? ";
    return fmt::format("unknown option {}\n  hint: {}`{} --help` lists them", printable(option),
                       near, program);
  }
  if (!command.empty() && words[0][0] == '-')
    return fmt::format("{0} stands before the command\n  hint: {1} {0} ...", printable(words[0]),
                       program);
  const std::size_t named = pieces(command, ' ').size();
  const bool begins_with_it = join({words.begin(), words.begin() + long(named)}, " ") == command;
  if (!below.empty() && begins_with_it && words.size() > named && words[named][0] != '-')
    return fmt::format("unknown command '{}{}{}'\n  hint: {}", command, command.empty() ? "" : " ",
                       printable(words[named]), suggest(words[named], below));
  if (!command.empty() && !below.empty() && error.get_name() == "RequiredError")
    return fmt::format("{} needs a command\n  hint: one of {}", program, join(below, ", "));
  return fmt::format("{}\n  hint: run `{} --help`", printable(error.what()), program);
}

int usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
  if (argc == 1)
    print_error("{}",
                app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
  else
    print_error("error: {}\n", usage_fault(app, error, {argv + 1, argv + argc}));
  return 2;
}

// Flushes stdout and checks it: output is buffered until here, so that a full disk shows only now.
int finish(int exit_code) {
  std::cout.flush();
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout) && std::cout) return exit_code;
  const int why = errno;                           // 0 if an earlier write failed
  if (os::nobody_reads_stdout()) return exit_code; // as in `frictab list | head -1`
  print_error("error: what was to be printed cannot be written{}\n  hint: is the disk full, or the "
              "file or pipe of stdout closed?\n",
              why == 0 ? "" : std::string(": ") + std::strerror(why));
  return 3;
}

int run_parsed(CLI::App& app, const Runners& runners, const CommonOptions& common, int argc,
               char** argv) {
  try {
    app.parse(argc, argv);
    return run_chosen(runners, common);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, argc, argv);
  } catch (...) {
    return print_exception();
  }
}

} // namespace

std::string positive_number(const std::string& text) {
  return fault_of_number(text, "a number above 0", false);
}

std::string number_from_0(const std::string& text) {
  return fault_of_number(text, "a number from 0 on", true);
}

int print_exception() {
  try {
    throw;
  } catch (const InputError& error) {
    print_error("{}\n", colours_on(stderr) ? coloured_error(error.what()) : error.what());
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = printable(error.path1().string());
    print_error("{}: error: {}\n", path, error.code().message());
    return is_fault_of_path(error.code()) ? 2 : 3;
  } catch (const OutOfMemory& error) {
    print_error("error: {}\n  hint: {}\n", printable(error.what()), error.hint());
  } catch (const std::bad_alloc&) {
    print_error("error: out of memory\n  hint: fewer nodes, or a smaller file\n");
  } catch (const std::exception& error) {
    print_error("error: {}\n", printable(error.what()));
  }
  return 3;
}

void show(const std::string& text) {
  print_out("{}", printable(text));
}

void note(const CommonOptions& common, const std::string& line) {
  if (!common.quiet) print_error("{}\n", printable(line));
}

void commit(io::OutputFiles& files, const std::string& directory, const CommonOptions& common) {
  if (!common.force && files.would_change())
    throw InputError({directory, 0, 0}, "has other files of these names already",
                     "name another directory, or --force to replace them");
  files.commit();
}

int check_stack() {
  constexpr double least = 1 << 20; // of what threads get as well; the usual is eight times that
  const double stack = os::stack_limit();
  if (stack >= least) return 0;
  print_error("error: the stack is limited to {}, and at least {} are needed\n"
              "  hint: raise it in this shell: ulimit -s 8192\n",
              human_bytes(stack), human_bytes(least));
  return 3;
}

int run_command_line(int argc, char** argv) {
  CLI::App app{"frictab - from tribometer data to a verified friction subroutine", "frictab"};
  set_help_options(app);
  app.set_version_flag("-V,--version", std::string("frictab ") + tool_version());
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormat>(16));
  app.footer(std::string("`frictab help COMMAND` has the options of a command, with examples; "
                         "`frictab explain job` the keys of the job file.\n\n") +
             exit_codes);
  CommonOptions common;
  Runners runners;
  for (const Command& command : Registry<Command>::instance().all()) {
    const std::size_t blank = command.name.find(' ');
    CLI::App* above = blank == command.name.npos
                          ? &app
                          // added already: its order is smaller
                          : app.get_subcommand(command.name.substr(0, blank));
    CLI::App* sub = above->add_subcommand(command.name.substr(blank + 1), command.title);
    sub->formatter(std::make_shared<HelpFormat>(28));
    set_help_options(*sub);
    sub->footer(footer_of(command));
    if (command.declare) {
      add_common(*sub, common, command.uses);
      runners.emplace_back(sub, command.declare(*sub, common));
    } else {
      sub->require_subcommand(1);
    }
  }
  return finish(run_parsed(app, runners, common, argc, argv));
}

} // namespace frictab::cli
