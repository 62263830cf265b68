// What the commands that work on a job file share.
#pragma once

#include <functional>

#include "cli/command.h"
#include "run/pipeline.h"

namespace frictab::cli {

using Stages = std::function<void(run::Pipeline&)>;

// The job file with -o, --seed and --set.
job::Job read_job(const std::string& file, const CommonOptions& common);

// What a user should know of a run, to stderr.
void tell_notes(const run::Pipeline& pipeline, const CommonOptions& common);

// Reads the job, runs the stages, commits, prints the summary; the exit code.
int run_stages(const std::string& file, const CommonOptions& common, const Stages& stages);

} // namespace frictab::cli
