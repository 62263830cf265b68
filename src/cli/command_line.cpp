// Builds the CLI11 application from the registered commands.
#include "cli/command_line.h"

#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "cli/command.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "io/atomic_file.h"

namespace frictab::cli {

namespace {

const char* const exit_codes = "Exit codes: 0 done; 1 a target was missed (drift over tolerance); "
                               "2 usage, job file or input data wrong; 3 anything else.";

void add_common(CLI::App& app, CommonOptions& common) {
  app.add_option("-o,--output", common.output, "Output directory, instead of the job's")
      ->type_name("DIR");
  app.add_flag("--force", common.force, "Overwrite files that frictab would leave alone");
  app.add_option("-j,--threads", common.threads, "Threads; 0 = all cores")->type_name("N");
  app.add_flag("-q,--quiet", common.quiet, "Nothing on stderr unless something fails");
  app.add_flag("-v,--verbose", common.verbose, "Say more on stderr");
  app.add_flag("--json", common.json, "Print the result as JSON");
  app.add_option("--seed", common.seed, "Seed of everything random")->type_name("N");
  app.add_option("--set", common.set, "Override a job key: --set table.tolerance_MPa=0.1")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  app.add_flag("--progress,!--no-progress", common.progress,
               "Progress line on or off; otherwise on a terminal only");
  app.footer(exit_codes);
}

// The runner of the subcommand that was called.
using Runners = std::vector<std::pair<CLI::App*, std::function<int()>>>;

int run_chosen(const Runners& runners, const CommonOptions& common) {
  set_threads(common.threads);
  enable_progress(common.progress.value_or(isatty(STDERR_FILENO) != 0) && !common.quiet);
  for (const auto& [app, run] : runners)
    if (app->parsed()) return run();
  return 2;
}

// Names of the commands below `group` ("" = at the top).
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

int usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
  std::string group;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    const std::vector<std::string> names = commands_of(group);
    if (names.empty()) break;
    if (std::find(names.begin(), names.end(), argv[i]) == names.end()) {
      fmt::print(stderr, "error: unknown command '{}{}{}'\n  hint: {}\n", group,
                 group.empty() ? "" : " ", argv[i], suggest(argv[i], names));
      return 2;
    }
    group += (group.empty() ? "" : " ") + std::string(argv[i]);
  }
  fmt::print(stderr, "error: {}\n  hint: run `frictab {}{}--help`\n", error.what(), group,
             group.empty() ? "" : " ");
  return 2;
}

} // namespace

void note(const CommonOptions& common, const std::string& line) {
  if (!common.quiet) fmt::print(stderr, "{}\n", line);
}

void commit(io::OutputFiles& files, const std::string& directory, const CommonOptions& common) {
  if (!common.force && files.would_change())
    throw InputError({directory, 0, 0}, "has other files of these names already",
                     "name another directory, or --force to replace them");
  files.commit();
}

int run_command_line(int argc, char** argv) {
  CLI::App app{"frictab - from tribometer data to a verified friction subroutine", "frictab"};
  app.set_version_flag("--version", "frictab " FRICTAB_VERSION);
  app.require_subcommand(1);
  app.footer(exit_codes);
  CommonOptions common;
  Runners runners;
  for (const Command& command : Registry<Command>::instance().all()) {
    const std::size_t blank = command.name.find(' ');
    CLI::App* above = blank == command.name.npos
                          ? &app
                          : app.get_subcommand(command.name.substr(0, blank)); // its order is less
    CLI::App* sub = above->add_subcommand(command.name.substr(blank + 1), command.title);
    if (command.declare) {
      add_common(*sub, common);
      runners.emplace_back(sub, command.declare(*sub, common));
    } else {
      sub->require_subcommand(1);
      sub->footer(exit_codes);
    }
  }
  try {
    app.parse(argc, argv);
    return run_chosen(runners, common);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: out of memory\n  hint: fewer nodes, or a smaller file\n");
    return 3;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 3;
  }
}

} // namespace frictab::cli
