// frictab table: the group of commands that inspect table files.
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/table_command.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/file_streams.h"

namespace frictab::cli {

namespace fs = std::filesystem;

void output_is_a_file(CLI::App& app) {
  app.get_option("--output")->description("Output file, instead of stdout")->type_name("FILE");
}

void write_result(const CommonOptions& common, const std::function<void(std::ostream&)>& write) {
  if (common.output.empty()) {
    write(std::cout);
    std::cout.flush();
    return;
  }
  const fs::path file(common.output);
  io::OutputFiles output(file.has_parent_path() ? file.parent_path() : fs::path("."),
                         io::OutputFiles::Claim::one_file);
  const std::string name = file.filename().string();
  io::OutputFile out(output.stage(name));
  write(out);
  out.finish();
  if (!common.force && output.would_change())
    throw InputError({file.string(), 0, 0}, "is there already",
                     "name another file, or --force to replace it");
  output.commit();
}

void add_fixed_states_option(CLI::App& app, std::vector<std::string>& at) {
  app.add_option("--at", at, "A state that is held, in its canonical unit; once per state")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

const Registered<Command> registered{[] {
  return Command{"table", 10, "Look into table files: info, slice, diff, convert",
                 nullptr, 0,  {{"frictab help table slice", "options of a command below it"}}};
}};

} // namespace frictab::cli
