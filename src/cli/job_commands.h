// Functions that the commands on a job file share.
#pragma once

#include <functional>

#include "cli/command.h"
#include "run/run.h"

namespace frictab::cli {

// Adds the argument JOB, which may be omitted if the current folder has a job.toml.
void add_job(CLI::App& app, std::string& file, const std::string& description = "Job file (TOML)");

// True if `given` names a job file, or the current folder has a job.toml.
bool has_job(const std::string& given);

// Returns `given`, otherwise job.toml of the current folder. Throws InputError if there is none.
std::string job_file(const std::string& given);

// Reads the job file and applies -o, --seed and --set.
job::Job read_job(const std::string& file, const CommonOptions& common);

// Writes the notes of a run for the user to stderr.
void print_notes(const run::Run& run, const CommonOptions& common);

// Runs "frictab COMMAND JOB" for one stage, or for "run", which is all stages: reads the job, runs,
// commits and prints the summary. `afterwards` gets the finished run. Returns the exit code.
int run_stage_command(const std::string& file, const CommonOptions& common,
                      const std::string& command,
                      const std::function<void(const run::Run&)>& afterwards = {});

// Handles --dry-run for a command that runs stages of a job.
int print_plan(const job::Job& job, const std::string& command, const CommonOptions& common);

} // namespace frictab::cli
