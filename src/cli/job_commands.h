// What the commands that work on a job file share.
#pragma once

#include <functional>

#include "cli/command.h"
#include "run/run.h"

namespace frictab::cli {

// JOB, which may be left out where the current folder has a job.toml.
void add_job(CLI::App& app, std::string& file, const std::string& description = "Job file (TOML)");

// Whether there is one to work on: `given`, or job.toml of the current folder.
bool has_job(const std::string& given);

// `given`, else job.toml of the current folder. Throws InputError where there is none.
std::string job_file(const std::string& given);

// The job file with -o, --seed and --set.
job::Job read_job(const std::string& file, const CommonOptions& common);

// What a user should know of a run, to stderr.
void tell_notes(const run::Run& run, const CommonOptions& common);

// "frictab COMMAND JOB" of a stage, or of "run", which is all of them: reads the job, runs,
// commits, prints the summary; `afterwards` sees what was found. Gives the exit code.
int run_stage_command(const std::string& file, const CommonOptions& common,
                      const std::string& command,
                      const std::function<void(const run::Run&)>& afterwards = {});

// --dry-run of a command that runs stages of a job.
int tell_plan(const job::Job& job, const std::string& command, const CommonOptions& common);

} // namespace frictab::cli
