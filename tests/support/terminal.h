// Runs a program on a terminal of its own.
#pragma once

#include <string>
#include <vector>

#include "support/run_command.h"

namespace frictab::test {

// As run_command, with stdin, stdout and stderr on a terminal of `columns` columns; `out` is what
// reached it, `err` stays empty.
CommandResult run_on_terminal(const std::vector<std::string>& argv, unsigned columns,
                              const std::string& directory,
                              const std::vector<std::string>& environment = {});

} // namespace frictab::test
