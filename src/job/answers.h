// Asks the user for what the guesses of a campaign leave open, before a job is made of them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "guess/guess.h"

namespace frictab::job {

// Shows some lines and returns the user's line; nullopt: there are no more.
using AskUser = std::function<std::optional<std::string>(const std::string& lines)>;

// Takes over each answer; what is left empty stays open. An answer that cannot be meant is asked
// for again. Columns get their meaning in every file that is read like most.
guess::Campaign with_answers(guess::Campaign campaign, const AskUser& ask);

} // namespace frictab::job
