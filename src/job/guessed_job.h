// A job file made from what was found in a lab's files: every guess a line that can be read and
// mended, every open point a question.
#pragma once

#include <string>
#include <vector>

#include "data/sniff.h"

namespace frictab::job {

struct GuessedJob {
  std::string text;                   // TOML
  std::vector<std::string> questions; // what has to be answered before it runs
};

// `training`: names, globs or folders that stand for the files, as data.training.
GuessedJob guessed_job(const std::vector<data::GuessedFile>& files, const data::GuessedNames& names,
                       const std::vector<std::string>& training);

} // namespace frictab::job
