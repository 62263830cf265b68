// The command line: one subcommand per file in src/cli/, faults to exit codes.
#include "cli/command_line.h"
#include "core/os/interrupt.h"

int main(int argc, char** argv) {
  frictab::os::tidy_up_when_interrupted();
  return frictab::cli::run_command_line(argc, argv);
}
