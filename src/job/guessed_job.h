// A job file composed from what was found in a lab's files: each guess is a line that can be read
// and corrected, each open point a question.
#pragma once

#include <string>
#include <vector>

#include "guess/guess.h"

namespace frictab::job {

struct GuessedJob {
  std::string text;                   // TOML
  std::vector<std::string> questions; // points to settle before the job runs
  std::vector<std::string> left;      // files that it does not read: "notes.txt: it has no ..."
};

// `training`: names, globs or folders of the files, as in data.training.
GuessedJob guessed_job(const guess::Campaign& campaign, const guess::NamePattern& names,
                       const std::vector<std::string>& training);

} // namespace frictab::job
