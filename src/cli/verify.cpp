// frictab verify: a job's tables and sources, one table alone for CI pipelines, or several laws in
// one user file.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "calibrate/calibration_file.h"
#include "cli/combined.h"
#include "cli/job_commands.h"
#include "core/error.h"
#include "core/os/standard_streams.h"
#include "data/load.h"
#include "io/file_streams.h"
#include "run/compare_alone.h"
#include "run/results.h"
#include "run/summary.h"
#include "table/table_file.h"
#include "verify/verify.h"
#include "words/drift.h"
#include "words/render.h"

namespace frictab::cli::verify_command {

namespace fs = std::filesystem;

struct Options {
  std::string job;
  std::string table;
  std::string model;
  std::string data;
  std::string combined;
  std::string junit;
  std::optional<double> max_drift_MPa;
  bool require_proof = false;
  bool require_run = false;
};

// Data for the rows alone: canonical column names, or the mapping of a job file.
data::Dataset load_rows(const Options& options, const CommonOptions& common) {
  data::DataOptions mapping;
  if (!options.job.empty()) mapping = job::read_job(options.job, common.set).data;
  mapping.base = ""; // the file is relative to the current directory
  return data::load_dataset({options.data}, mapping);
}

void write_one(const fs::path& file, const std::string& xml) {
  io::OutputFiles out(file.has_parent_path() ? file.parent_path() : fs::path("."),
                      io::OutputFiles::Claim::one_file);
  out.write(file.filename().string(), xml);
  out.commit();
}

void write_junit(const Options& options, const verify::Verification& verification) {
  if (!options.junit.empty()) write_one(options.junit, verify::verification_junit(verification));
}

// Places, besides standard error, for the fault of a verification that cannot be carried out.
struct FailurePlaces {
  std::string junit;
  std::string directory; // of the job's results, as soon as it is known; else empty
  bool replaces_others = false;
};

// Writes what it can: the fault itself is the message that matters.
void write_failure(const FailurePlaces& places, const std::vector<Fault>& faults,
                   const CommonOptions& common) {
  const std::string xml = verify::failure_junit(faults);
  const auto attempt = [&](const std::function<void()>& write) {
    try {
      write();
    } catch (const std::exception& error) {
      note(common, std::string("no JUnit file: ") + error.what());
    }
  };
  if (!places.junit.empty()) attempt([&] { write_one(places.junit, xml); });
  if (!places.directory.empty())
    attempt([&] { run::write_verify_xml(places.directory, xml, places.replaces_others); });
}

// Makes sure that a routine which ends the program, by exit or by STOP, does not look like success.
class NoExit {
public:
  NoExit() {
    static const bool registered = std::atexit(refuse) == 0;
    running_ = registered;
  }
  ~NoExit() { running_ = false; }
  NoExit(const NoExit&) = delete;
  NoExit& operator=(const NoExit&) = delete;

private:
  static void refuse() {
    if (!running_) return;
    os::put(stderr, "error: a routine has ended the program while it was verified\n");
    std::_Exit(3);
  }
  static inline bool running_ = false;
};

// Runs `verify`. Whatever it throws is written as JUnit before it goes on. Until then the JUnit
// file says that the verification has not ended, for a routine or a signal that ends this process.
int with_failures_written(const FailurePlaces& places, const CommonOptions& common,
                          const std::function<int()>& verify) {
  if (!places.junit.empty() && !common.dry_run)
    write_one(places.junit,
              verify::failure_junit(
                  {{{},
                    "the verification has not ended: a routine or a signal ended the process",
                    "frictab verify without --junit shows how it ends"}}));
  try {
    const NoExit guarded;
    return verify();
  } catch (const InputError& error) {
    write_failure(places, error.faults(), common);
    throw;
  } catch (const std::exception& error) {
    write_failure(places, {{{}, error.what(), ""}}, common);
    throw;
  }
}

// Returns the tolerance of the command line, otherwise that of the table; computes one for a table
// made elsewhere, which may have none.
table::Tolerance tolerance_of(const Options& options, const models::AssembledLaw& law,
                              const table::Table& table, const data::Dataset* rows) {
  if (options.max_drift_MPa) return {*options.max_drift_MPa, ""};
  if (table.record.tolerance_MPa)
    return {*table.record.tolerance_MPa, table.record.tolerance_from.value_or("")};
  return table::auto_tolerance(law, table::table_ranges(table, rows, options.table));
}

int verify_alone(const Options& options, const CommonOptions& common) {
  const table::Table table = table::read_table(options.table);
  const calibrate::ModelFit fit =
      calibrate::parse_model_fit(io::read_file(options.model), options.model);
  const models::AssembledLaw law(
      calibrate::at_quantile(fit.model, table.quantile(), {options.table, 0, 0}));
  std::optional<data::Dataset> rows;
  if (!options.data.empty()) rows = load_rows(options, common);
  verify::VerifyInput input{law, table, options.table, rows ? &*rows : nullptr};
  const table::Tolerance allowed = tolerance_of(options, law, table, input.rows);
  input.max_drift_MPa = allowed.MPa;
  input.allowed_from = allowed.from;
  verify::Verification verification{allowed.MPa, {}, options.require_proof};
  verification.records = verify::verify(input, {});
  verification.findings =
      run::compare_alone(options.table, options.model, fit, input, verification.records.front());
  write_junit(options, verification);
  if (common.json)
    show(verify::verification_json(verification));
  else
    show(words::as_text(words::drift(verification, words::Detail::full)));
  return verification.passed() ? 0 : 1;
}

int verify_together(const Options& options, const CommonOptions& common) {
  verify::Verification verification = verify_combined(options.combined, options.max_drift_MPa);
  verification.require_run = options.require_run;
  write_junit(options, verification);
  show(common.json ? verify::verification_json(verification) : combined_drift_text(verification));
  return verification.passed() ? 0 : 1;
}

int verify_job(const Options& options, const CommonOptions& common, FailurePlaces& places) {
  if (!common.dry_run) places.directory = common.output;
  job::Job job = read_job(job_file(options.job), common);
  if (!common.dry_run) places.directory = job.directory;
  if (options.max_drift_MPa) job.verify.max_drift_MPa = options.max_drift_MPa;
  if (options.require_proof) job.verify.require_proof = true;
  if (options.require_run) job.verify.require_run = true;
  if (common.dry_run) return print_plan(job, "verify", common);
  run::Run run(std::move(job));
  run_stage(run, "verify");
  run.workspace.commit();
  print_notes(run, common);
  write_junit(options, *run.verification);
  show(common.json ? run::summary_json(run)
                   : words::as_text(words::drift(*run.verification, words::Detail::full)));
  return run.verification->passed() ? 0 : 1;
}

int verify_any(const Options& options, const CommonOptions& common, FailurePlaces& places) {
  if (!options.combined.empty()) {
    if (!options.job.empty() || !options.table.empty() || !options.model.empty())
      throw InputError({}, "--combined DIR stands alone", "without JOB, --table and --model");
    return verify_together(options, common);
  }
  const bool alone = !options.table.empty() || !options.model.empty();
  if (alone && (options.table.empty() || options.model.empty()))
    throw InputError({}, "--table and --model belong together",
                     "give both: --table tables/NAME.h5 --model models/NAME.json");
  if (!alone && !has_job(options.job))
    throw InputError({}, "nothing to verify",
                     "give a JOB file, --table FILE --model FILE [--data FILE], or --combined DIR");
  return alone ? verify_alone(options, common) : verify_job(options, common, places);
}

const Registered<Command> registered{[] {
  Command command;
  command.name = "verify";
  command.order = 6;
  command.title = "Prove how far tables and sources are from the law";
  command.declare = [](CLI::App& app, const CommonOptions& common) -> std::function<int()> {
    const auto options = std::make_shared<Options>();
    add_job(app, options->job, "Job file; its tables and sources are verified");
    app.add_option("--table", options->table, "A table file, without a job")->type_name("FILE");
    app.add_option("--model", options->model, "The model file it was made from")->type_name("FILE");
    app.add_option("--data", options->data, "Rows to compare on (CSV or HDF5)")->type_name("FILE");
    app.add_option("--combined", options->combined,
                   "Directory of `export --combine`: each law through the entry they share, "
                   "against its table")
        ->type_name("DIR");
    app.add_option("--max-drift-MPa", options->max_drift_MPa, "Largest drift allowed")
        ->type_name("X")
        ->check(positive_number);
    app.add_flag("--require-proof", options->require_proof,
                 "A table passes only where a bound within the tolerance is proven");
    app.add_flag("--require-run", options->require_run,
                 "A routine that cannot be compiled and run on this machine has failed");
    app.add_option("--junit", options->junit, "Write the result as JUnit XML")->type_name("FILE");
    return [options, &common]() -> int {
      FailurePlaces places{options->junit, "", common.force};
      return with_failures_written(places, common,
                                   [&] { return verify_any(*options, common, places); });
    };
  };
  command.uses = stage_uses;
  command.examples = {{"frictab verify job.toml --junit drift.xml", "tables and routines, for CI"},
                      {"frictab verify --table out/tables/coulomb.h5 --model "
                       "out/models/coulomb.json --data data/validation.csv --max-drift-MPa 0.5",
                       "one table"},
                      {"frictab verify --combined both", "what export --combine wrote"}};
  return command;
}};

} // namespace frictab::cli::verify_command
