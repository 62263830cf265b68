// frictab export: the sources of a job's tables, of one table file alone, or of several laws in one
// user file.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/check_sources.h"
#include "cli/combined.h"
#include "cli/job_commands.h"
#include "cli/law_alone.h"
#include "cli/sources.h"
#include "codegen/exporter.h"
#include "codegen/values_file.h"
#include "core/error.h"
#include "table/table_file.h"

namespace frictab::cli::export_command {

namespace {

struct Options {
  std::string job;
  std::string table;
  std::vector<std::string> targets{"c", "abaqus_vfric"};
  std::string units = "mm-t-s", temperature = "degC";
  std::vector<std::string> combine;
  std::string law, system;
  std::vector<std::string> parameters, ranges;
  bool check = false;
};

int export_alone(const Options& options, const CommonOptions& common) {
  need_directory(common, "--table FILE");
  const auto exporters = codegen::exporters_named(options.targets);
  codegen::check_request_size(table::read_description(options.table).table, exporters, {});
  const table::Table table = table::read_table(options.table);
  io::OutputFiles output(common.output);
  write_sources(output, exporters, table, {options.units, options.temperature});
  commit_and_list(output, common);
  return 0;
}

int write(const Options& options, const CommonOptions& common) {
  codegen::exporters_named(options.targets); // a mistyped target is a fault of any export
  if (!options.combine.empty()) {
    if (!options.table.empty())
      throw InputError({}, "--combine and --table exclude each other",
                       "--combine NAME=FILE takes the tables itself");
    return export_combined(
        {options.combine, options.job, options.targets, options.units, options.temperature},
        common);
  }
  if (!common.set.empty() && (!options.law.empty() || !options.table.empty()))
    throw InputError({}, "--set overrides keys of a job, and here is none",
                     "--units, --temperature, and of --law --param and --range; other options take "
                     "a job, whose table.model may be a law of constants");
  if (!options.system.empty()) {
    if (!options.job.empty() || !options.table.empty() || !options.law.empty() ||
        !options.parameters.empty())
      throw InputError({}, "--system has its law and parameters",
                       "without JOB, --table, --law, --param");
    return export_system(
        {options.system, options.ranges, options.targets, options.units, options.temperature},
        common);
  }
  if (!options.law.empty()) {
    if (!options.job.empty() || !options.table.empty())
      throw InputError({}, "--law stands alone", "without JOB and --table");
    return export_law({options.law, options.parameters, options.ranges, options.targets,
                       options.units, options.temperature},
                      common);
  }
  if (!options.parameters.empty() || !options.ranges.empty())
    throw InputError({}, "--param and --range belong to --law", "--law coulomb --param mu=0.08");
  const std::string how =
      "give a JOB file, --table FILE -o DIR [--targets c,abaqus_vfric], --law NAME --param P=V "
      "... -o DIR, --system NAME -o DIR, or --combine NAME=FILE ... -o DIR --targets abaqus_vfric";
  if (options.table.empty() && !has_job(options.job))
    throw InputError({}, "nothing to export", how);
  if (!options.table.empty() && !options.job.empty())
    throw InputError({}, "JOB and --table exclude each other", how);
  if (!options.table.empty()) return export_alone(options, common);
  return run_stage_command(options.job, common, "export");
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  add_job(app, options->job, "Job file; the sources of its tables are written");
  app.add_option("--table", options->table, "A table file, without a job; needs -o DIR")
      ->type_name("FILE");
  app.add_option("--targets", options->targets,
                 "Without a JOB: FE codes, a list or all (frictab list targets)")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false) // or it takes a JOB that follows
      ->type_name("TARGETS");
  app.add_option("--units", options->units, "Without a JOB: " + codegen::unit_systems_text())
      ->type_name("SYSTEM");
  app.add_option("--temperature", options->temperature,
                 "Without a JOB: degC or K, in which the simulation has temperatures")
      ->type_name("UNIT");
  app.add_option("--combine", options->combine,
                 "Several laws in one user file, by the names of their contacts in the deck "
                 "(PUNCH=A.h5 DIE=B.h5); needs -o DIR. A JOB's [export] holds for all of them")
      ->type_name("NAME=TABLE");
  app.add_option("--law", options->law,
                 "A friction law with known constants, without data; needs -o DIR")
      ->type_name("LAW");
  app.add_option("--system", options->system,
                 "A tribosystem of `frictab list systems`, or a file in their form; needs -o DIR")
      ->type_name("NAME|FILE");
  app.add_option("--param", options->parameters, "With --law: one of its parameters")
      ->type_name("NAME=NUMBER");
  app.add_option("--range", options->ranges,
                 "With --law: over which states; usual are those of Table 1. With a range of "
                 "sigma_f_MPa the shear limit holds")
      ->type_name("STATE=LOW..HIGH");
  app.add_flag("--check", options->check,
               "Then compile each source on its own, with the compiler that is here; with -o DIR "
               "alone those that DIR has");
  return [options, &common]() -> int {
    if (!options->check) return write(*options, common);
    const bool nothing_new = options->job.empty() && options->table.empty() &&
                             options->law.empty() && options->system.empty() &&
                             options->combine.empty();
    if (nothing_new && !common.output.empty()) return check_sources(common.output);
    const int code = write(*options, common);
    if (code != 0 || common.dry_run) return code;
    const bool of_job = options->combine.empty() && options->table.empty() &&
                        options->law.empty() && options->system.empty();
    return check_sources(of_job ? read_job(job_file(options->job), common).directory + "/export"
                                : common.output);
  };
}

const Registered<Command> registered{[] {
  return Command{
      "export",
      5,
      "Generate the friction subroutines from the tables",
      declare,
      stage_uses | uses_verbose,
      {{"frictab export job.toml", "the routines of the job's tables"},
       {"frictab export --table out/tables/coulomb.h5 --targets c,marc_ufric -o routines",
        "of one table"},
       {"frictab export --law coulomb --param mu=0.08 -o literature", "of known constants"},
       {"frictab export job.toml --check", "and compile each of them on its own"},
       {"frictab export --combine PUNCH=out/tables/coulomb.h5 DIE=out/tables/shear.h5 --targets "
        "abaqus_vfric -o both",
        "two laws in one user file"}}};
}};

} // namespace

} // namespace frictab::cli::export_command
