// What a command would do with a job, from the job, its data and the results that are there.
#pragma once

#include <string>
#include <vector>

#include "job/job.h"

namespace frictab::run {

struct PlannedStage {
  enum class Action { run, keep, refuse };
  std::string name;
  Action action = Action::run;
  std::string why;                 // why it runs first, is kept, or is refused
  std::vector<std::string> writes; // below the output directory; NAME/ is a folder
};

struct Plan {
  std::string directory;
  std::vector<PlannedStage> stages; // in the order of a run
  bool refused() const;             // by a stage whose results are stale
};

// Of "run" or of one stage. Reads the data and checks them as the command would; writes nothing.
// Throws InputError.
Plan plan_of(const job::Job& job, const std::string& command);

std::string plan_text(const Plan& plan);
std::string plan_json(const Plan& plan);

} // namespace frictab::run
