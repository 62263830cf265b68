// Runs a program on a terminal of its own.
#pragma once

#include <string>
#include <vector>

#include "support/run_command.h"

namespace frictab::test {

// As run_command, with stdin, stdout and stderr on a terminal of `columns` columns; `out` is what
// reached it, `err` stays empty. Where `interrupt_at` has reached it, Ctrl-C is typed once.
CommandResult run_on_terminal(const std::vector<std::string>& argv, unsigned columns,
                              const std::string& directory,
                              const std::vector<std::string>& environment = {},
                              const std::string& interrupt_at = "");

} // namespace frictab::test
