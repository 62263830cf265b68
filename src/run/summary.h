// Findings of a run, as text that is read in ten seconds, or as JSON.
#pragma once

#include <string>

#include "run/run.h"
#include "words/answer.h"

namespace frictab::run {

// The values of the first box; they refer to the run.
words::Answers answers_of(const Run& run);

// `brief` ends with the findings in a few lines; `full` has everything that the report has.
std::string summary_text(const Run& run, words::Detail detail);
std::string summary_json(const Run& run);

} // namespace frictab::run
