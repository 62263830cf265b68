// The command line: one subcommand per file in src/cli/, faults to exit codes.
#include "cli/command_line.h"
#include "core/os/interrupt.h"
#include "core/os/standard_streams.h"

int main(int argc, char** argv) {
  frictab::os::keep_standard_streams();
  if (const int code = frictab::cli::check_stack()) return code;
  frictab::os::tidy_up_when_interrupted();
  return frictab::cli::run_command_line(argc, argv);
}
