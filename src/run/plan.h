// Plan of a command (--dry-run): the stages it would run, given the job, its data and existing
// results.
#pragma once

#include <string>
#include <vector>

#include "job/job.h"

namespace frictab::run {

struct PlannedStage {
  enum class Action { run, keep, refuse };
  std::string name;
  Action action = Action::run;
  std::string why;                 // reason why it runs first, is kept, or is refused
  std::vector<std::string> writes; // relative to the output directory; NAME/ is a folder
};

struct Plan {
  std::string directory;
  std::vector<PlannedStage> stages; // in the order of a run
  bool refused() const;             // some stage has stale results
};

// Plans "run" or one stage. Reads and checks the data as the command would; writes nothing. Throws
// InputError.
Plan plan_of(const job::Job& job, const std::string& command);

std::string plan_text(const Plan& plan);
std::string plan_json(const Plan& plan);

} // namespace frictab::run
