// frictab table convert FILE: plain-text grids for codes that read those.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/table_command.h"
#include "core/text.h"
#include "table/plain_text.h"
#include "table/table_file.h"

namespace frictab::cli::table_convert_command {

struct Options {
  std::string file;
  std::string to;
  std::vector<std::string> at;
};

int run(const Options& options, const CommonOptions& common) {
  const table::PlainFormat& format = table::plain_format(options.to);
  const table::Table table = table::read_table(options.file);
  const table::FixedStates held = table::fixed_states(options.at, table.inputs());
  for (const std::string& line : table::check_fixed_states(table, held))
    note(common, "note: " + line);
  write_result(common, [&](std::ostream& out) { format.write({table, held}, out); });
  return 0;
}

std::string formats_text() {
  std::string text = "Formats:\n";
  for (const table::PlainFormat& format : Registry<table::PlainFormat>::instance().all())
    text += fmt::format("  {:<8} {}\n           ({})\n", format.name, format.title, format.source);
  return text;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "Table file (HDF5)")->required();
  app.add_option("--to", options->to, "Format, see below")->type_name("FORMAT")->required();
  add_fixed_states_option(app, options->at);
  output_is_a_file(app);
  app.footer(formats_text() + "\n" + app.get_footer());
  return [options, &common] { return run(*options, common); };
}

const Registered<Command> registered{[] {
  return Command{"table convert",
                 14,
                 "Plain-text grids: csv, txt, Abaqus *FRICTION, LS-DYNA tables",
                 declare,
                 uses_output | uses_force | uses_quiet,
                 {{"frictab table convert out/tables/coulomb.h5 --to csv -o grid.csv",
                   "every node, with tau_R"}}};
}};

} // namespace frictab::cli::table_convert_command
