// Parses the command line, runs one command, and turns faults into exit codes.
#pragma once

namespace frictab::cli {

// Returns an exit code, after a message, if the stack is too small to run; else 0.
int check_stack();

// Returns 0: done, 1: a target was missed, 2: usage, job file or data wrong, 3: anything else.
int run_command_line(int argc, char** argv);

} // namespace frictab::cli
