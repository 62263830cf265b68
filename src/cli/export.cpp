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

int export_alone(const ExportArguments& arguments, const CommonOptions& common) {
  need_directory(common, "--table FILE");
  const auto exporters = codegen::exporters_named(arguments.targets);
  codegen::check_request_size(table::read_description(arguments.table).table, exporters, {});
  const table::Table table = table::read_table(arguments.table);
  io::OutputFiles output(common.output);
  write_sources(output, exporters, table, {arguments.units, arguments.temperature});
  commit_and_list(output, common);
  return 0;
}

int write(const ExportArguments& arguments, const CommonOptions& common) {
  codegen::exporters_named(arguments.targets); // a mistyped target is a fault of any export
  if (!arguments.combine.empty()) {
    if (!arguments.table.empty())
      throw InputError({}, "--combine and --table exclude each other",
                       "--combine NAME=FILE takes the tables itself");
    return export_combined(arguments, common);
  }
  if (!common.set.empty() && (!arguments.law.empty() || !arguments.table.empty()))
    throw InputError({}, "--set overrides keys of a job, and here is none",
                     "--units, --temperature, and of --law --param and --range; other options take "
                     "a job, whose table.model may be a law of constants");
  if (!arguments.system.empty()) {
    if (!arguments.job.empty() || !arguments.table.empty() || !arguments.law.empty() ||
        !arguments.parameters.empty())
      throw InputError({}, "--system has its law and parameters",
                       "without JOB, --table, --law, --param");
    return export_system(arguments, common);
  }
  if (!arguments.law.empty()) {
    if (!arguments.job.empty() || !arguments.table.empty())
      throw InputError({}, "--law stands alone", "without JOB and --table");
    return export_law(arguments, common);
  }
  if (!arguments.parameters.empty() || !arguments.ranges.empty())
    throw InputError({}, "--param and --range belong to --law", "--law coulomb --param mu=0.08");
  const std::string how =
      "give a JOB file, --table FILE -o DIR [--targets c,abaqus_vfric], --law NAME --param P=V ... "
      "-o DIR, --system NAME -o DIR, or --combine NAME=FILE ... -o DIR --targets abaqus_vfric";
  if (arguments.table.empty() && !has_job(arguments.job))
    throw InputError({}, "nothing to export", how);
  if (!arguments.table.empty() && !arguments.job.empty())
    throw InputError({}, "JOB and --table exclude each other", how);
  if (!arguments.table.empty()) return export_alone(arguments, common);
  return run_stage_command(arguments.job, common, "export");
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto arguments = std::make_shared<ExportArguments>();
  add_job(app, arguments->job, "Job file; the sources of its tables are written");
  app.add_option("--table", arguments->table, "A table file, without a job; needs -o DIR")
      ->type_name("FILE");
  app.add_option("--targets", arguments->targets,
                 "Without a JOB: FE codes, a list or all (frictab list targets)")
      ->delimiter(',')
      ->take_all()
      ->allow_extra_args(false) // or it takes a JOB that follows
      ->type_name("TARGETS");
  app.add_option("--units", arguments->units, "Without a JOB: " + codegen::unit_systems_text())
      ->type_name("SYSTEM");
  app.add_option("--temperature", arguments->temperature,
                 "Without a JOB: degC or K, in which the simulation has temperatures")
      ->type_name("UNIT");
  app.add_option("--combine", arguments->combine,
                 "Several laws in one user file, by the names of their contacts in the deck "
                 "(PUNCH=A.h5 DIE=B.h5); needs -o DIR. A JOB's [export] holds for all of them")
      ->type_name("NAME=TABLE");
  app.add_option("--law", arguments->law,
                 "A friction law with known constants, without data; needs -o DIR")
      ->type_name("LAW");
  app.add_option("--system", arguments->system,
                 "A tribosystem of `frictab list systems`, or a file in their form; needs -o DIR")
      ->type_name("NAME|FILE");
  app.add_option("--param", arguments->parameters, "With --law: one of its parameters")
      ->type_name("NAME=NUMBER");
  app.add_option("--range", arguments->ranges,
                 "With --law: over which states; usual are those of Table 1. With a range of "
                 "sigma_f_MPa the shear limit holds")
      ->type_name("STATE=LOW..HIGH");
  app.add_flag("--check", arguments->check,
               "Then compile each source on its own, with the compiler that is here; with -o DIR "
               "alone those that DIR has");
  return [arguments, &common]() -> int {
    if (!arguments->check) return write(*arguments, common);
    const bool of_job = arguments->is_of_job();
    if (of_job && arguments->job.empty() && !common.output.empty())
      return check_sources(common.output);
    const int code = write(*arguments, common);
    if (code != 0 || common.dry_run) return code;
    return check_sources(of_job ? read_job(job_file(arguments->job), common).directory + "/export"
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

} // namespace frictab::cli::export_command
