// frictab schema: the keys of the job file for editors.
#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/print.h"
#include "job/json_schema.h"

namespace frictab::cli::schema_command {

std::function<int()> declare(CLI::App&, const CommonOptions&) {
  return [] {
    print_out("{}", job::json_schema());
    return 0;
  };
}

const Registered<Command> registered{[] {
  return Command{
      "schema",
      85,
      "JSON Schema of the job file: editors complete and check its keys",
      declare,
      0,
      {{"frictab schema > job.schema.json", "then `#:schema job.schema.json` on top of the job"}}};
}};

} // namespace frictab::cli::schema_command
