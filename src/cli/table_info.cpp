// frictab table info FILE: the contents of a table file.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/table_command.h"
#include "core/text.h"
#include "table/info.h"

namespace frictab::cli::table_info_command {

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto file = std::make_shared<std::string>();
  app.add_option("FILE", *file,
                 "Table file (HDF5); `frictab explain table-layout` says what is in one")
      ->required();
  output_is_a_file(app);
  return [file, &common] {
    const table::TableDescription table = table::read_description(*file);
    write_result(common, [&](std::ostream& out) {
      out << printable(common.json ? table::info_json(table, *file)
                                   : table::info_text(table, *file));
    });
    return 0;
  };
}

const Registered<Command> registered{[] {
  return Command{"table info",
                 11,
                 "Describe a table: axes, formula, drift, storage",
                 declare,
                 uses_output | uses_force | uses_json,
                 {{"frictab table info out/tables/coulomb.h5", "axes, formula, drift"}}};
}};

} // namespace frictab::cli::table_info_command
