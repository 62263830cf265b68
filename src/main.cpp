// The command line: one subcommand per file in src/cli/, faults to exit codes.
#include "cli/command_line.h"

int main(int argc, char** argv) {
  return frictab::cli::run_command_line(argc, argv);
}
