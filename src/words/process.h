// Texts about a process: in short, and its tables.
#pragma once

#include <string>

#include "process/process.h"
#include "words/document.h"

namespace frictab::words {

// One line each: what was read, where it rubs, what the laws say, which to take, what to test.
Section process_in_short(const process::Process& process);

Section process_coverage(const process::Process& process);
Section process_laws(const process::Process& process);
Section process_tests(const process::Process& process);
// Rows that were read, held and left out, and limits of the method.
Section process_reading(const process::Process& process);

// "+1.3 % +- 0.5" ; beyond 10 % "+31 %: rerun"; "+3 % of friction work" has no error.
std::string change_text(const process::Process& process, double percent);
// "force", or "friction work" where no force is predicted.
std::string result_name(const process::Process& process);

} // namespace frictab::words
