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

namespace frictab {

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

int usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
  std::string hint = "run `frictab --help`";
  const auto& commands = Registry<Command>::instance().all();
  std::vector<std::string> names;
  for (const Command& command : commands)
    names.push_back(command.name);
  if (argc > 1 && argv[1][0] != '-') {
    const bool known = std::find(names.begin(), names.end(), argv[1]) != names.end();
    if (!known) {
      fmt::print(stderr, "error: unknown command '{}'\n  hint: {}\n", argv[1],
                 suggest(argv[1], names));
      return 2;
    }
    hint = fmt::format("run `frictab {} --help`", argv[1]);
  }
  fmt::print(stderr, "error: {}\n  hint: {}\n", error.what(), hint);
  return 2;
}

} // namespace

void note(const CommonOptions& common, const std::string& line) {
  if (!common.quiet) fmt::print(stderr, "{}\n", line);
}

int run_command_line(int argc, char** argv) {
  CLI::App app{"frictab - from tribometer data to a verified friction subroutine", "frictab"};
  app.set_version_flag("--version", "frictab " FRICTAB_VERSION);
  app.require_subcommand(1);
  app.footer(exit_codes);
  CommonOptions common;
  Runners runners;
  for (const Command& command : Registry<Command>::instance().all()) {
    CLI::App* sub = app.add_subcommand(command.name, command.title);
    add_common(*sub, common);
    runners.emplace_back(sub, command.declare(*sub, common));
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

} // namespace frictab
