// frictab process JOB CONTACT: the laws in a simulation of the user's own.
#include <filesystem>
#include <map>
#include <memory>
#include <ranges>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/job_commands.h"
#include "core/error.h"
#include "core/names.h"
#include "core/template.h"
#include "core/text.h"
#include "job/toml_tree.h"

namespace frictab::cli::process_command {

namespace fs = std::filesystem;

struct Options {
  std::string job;
  std::vector<std::string> contact, tool, add;
  std::string used, symmetry, tests, script;
};

// Files are named from the current folder; in a job, from the job's.
std::string from_job(const std::string& file, const std::string& job) {
  const fs::path folder = fs::absolute(job).parent_path();
  std::error_code error;
  const fs::path there = fs::proximate(fs::absolute(file), folder, error);
  return (error || fs::path(file).is_absolute() ? fs::absolute(file) : there).string();
}

std::string list_of(const std::vector<std::string>& files, const std::string& job) {
  std::vector<std::string> named;
  for (const std::string& file : files)
    named.push_back(from_job(file, job));
  return job::toml_list(named, false);
}

// A first argument without .toml is a contact file; the job is then that of this folder.
Options with_job(Options options) {
  if (!options.job.empty() && !options.job.ends_with(".toml")) {
    options.contact.insert(options.contact.begin(), options.job);
    options.job.clear();
  }
  options.job = job_file(options.job);
  return options;
}

// Keys of [process] from the command line.
CommonOptions with_keys(CommonOptions common, const Options& options) {
  const auto set = [&](const char* key, const std::string& value) {
    common.set.push_back(fmt::format("process.{}={}", key, value));
  };
  if (!options.contact.empty()) set("contact", list_of(options.contact, options.job));
  if (!options.tool.empty()) set("tool", list_of(options.tool, options.job));
  if (!options.add.empty()) set("add", list_of(options.add, options.job));
  if (!options.used.empty()) set("used", job::toml_quoted(options.used));
  if (!options.symmetry.empty()) set("symmetry", options.symmetry);
  if (!options.tests.empty()) set("tests", options.tests);
  return common;
}

// Scripts and recipes by which a solver's results become these files.
const std::map<std::string, std::string>& scripts() {
  static const std::map<std::string, std::string> all = {{"abaqus", "process/from_abaqus.py"},
                                                         {"calculix", "process/from_calculix.py"},
                                                         {"deform", "process/deform.md"},
                                                         {"getfem", "process/from_getfem.py"},
                                                         {"lsdyna", "process/lsdyna.md"}};
  return all;
}

int print_script(const std::string& solver) {
  const auto found = scripts().find(solver);
  if (found == scripts().end()) {
    const auto known = all_names(std::views::keys(scripts()));
    throw InputError({}, fmt::format("no script for '{}'", solver), suggest(solver, known));
  }
  show(std::string(embedded_template(found->second)));
  return 0;
}

int judge(const Options& given, const CommonOptions& common) {
  if (!given.script.empty()) return print_script(given.script);
  const Options options = with_job(given);
  const CommonOptions all = with_keys(common, options);
  if (read_job(options.job, all).process.contact.empty())
    throw InputError({}, "no CONTACT is given: the contact states of a simulation",
                     "frictab process JOB CONTACT.csv --tool TOOL.csv --used LAW, or "
                     "process.contact of the job; `frictab explain process` has the columns");
  return run_stage_command(options.job, all, "process");
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  add_job(app, options->job, "A job that is calibrated (or will be)");
  app.add_option("CONTACT", options->contact,
                 "Contact states of a simulation: one row per increment and facet or node that "
                 "touches; without it process.contact of the job");
  app.add_option("--tool", options->tool, "Force and speed of the tool over time")
      ->type_name("FILE");
  app.add_option("--used", options->used,
                 "Law that the simulation had: a calibrated one, or coulomb:MU, shear:M")
      ->type_name("LAW");
  app.add_option("--symmetry", options->symmetry,
                 "The tool's force acts on so many times the areas given")
      ->type_name("N")
      ->check(positive_number);
  app.add_option("--tests", options->tests, "Number of tests to propose")
      ->type_name("N")
      ->check(positive_number);
  app.add_option("--add", options->add,
                 "Results of further tests: what the laws say with them and without")
      ->type_name("FILE");
  app.add_option("--script", options->script,
                 "Print the script or recipe that makes these files from a solver's results: "
                 "abaqus, calculix, deform, getfem, lsdyna")
      ->type_name("SOLVER");
  return [options, &common] { return judge(*options, common); };
}

const Registered<Command> process{[] {
  Command command;
  command.name = "process";
  command.order = 10;
  command.title = "Judge the laws where a simulation of yours rubs, before it is rerun";
  command.declare = declare;
  command.uses = stage_uses | uses_verbose;
  command.examples = {
      {"frictab process job.toml contact.csv --tool tool.csv --used coulomb:0.08",
       "process.html, process.json, process_plan.csv"},
      {"frictab process --script abaqus > from_abaqus.py", "contact.csv and tool.csv from an ODB"},
      {"frictab process job.toml contact.csv --tool tool.csv --add new_tests.csv",
       "before and after the tests that it proposed"}};
  return command;
}};

} // namespace frictab::cli::process_command
