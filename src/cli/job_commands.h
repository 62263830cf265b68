// What the commands that work on a job file share.
#pragma once

#include <functional>

#include "cli/command.h"
#include "run/pipeline.h"

namespace frictab::cli {

using Stages = std::function<void(run::Pipeline&)>;

// Reads the job, runs the stages, commits, prints the summary; the exit code.
int run_stages(const std::string& file, const CommonOptions& common, const Stages& stages);

} // namespace frictab::cli
