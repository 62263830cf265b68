// frictab table diff A B: the difference between two tables.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/table_command.h"
#include "core/error.h"
#include "table/difference.h"
#include "table/table_file.h"

namespace frictab::cli::table_diff_command {

struct Options {
  std::string a, b;
  std::vector<std::string> at;
  std::optional<double> max_MPa;
};

int run(const Options& options, const CommonOptions& common) {
  const table::Table a = table::read_table(options.a), b = table::read_table(options.b);
  std::vector<std::string> inputs = a.inputs();
  const std::vector<std::string> others = b.inputs();
  inputs.insert(inputs.end(), others.begin(), others.end());
  const table::FixedStates held = table::fixed_states(options.at, inputs);
  for (const table::Table* table : {&a, &b})
    for (const std::string& line : table::check_fixed_states(*table, held))
      note(common, "note: " + line);
  const table::TableDifference apart = table::difference(a, b, held);
  const std::array<std::string, 2> names{options.a, options.b};
  const bool over = options.max_MPa && !(apart.drift.max_abs <= *options.max_MPa);
  write_result(common, [&](std::ostream& out) {
    out << (common.json ? table::difference_json(apart, names)
                        : table::difference_text(apart, names));
    if (options.max_MPa && !common.json)
      out << fmt::format("Allowed: {:g} MPa: {}\n", *options.max_MPa, over ? "EXCEEDED" : "ok");
  });
  return over ? 1 : 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  app.add_option("A", options->a, "Table file (HDF5)")->required();
  app.add_option("B", options->b, "Another one")->required();
  add_fixed_states_option(app, options->at);
  app.add_option("--max-MPa", options->max_MPa, "Exit with 1 where they are further apart")
      ->type_name("X")
      ->check(number_from_0);
  output_is_a_file(app);
  return [options, &common] { return run(*options, common); };
}

const Registered<Command> registered{[] {
  return Command{
      "table diff",
      13,
      "Difference of two tables as tau_R over their common range",
      declare,
      uses_output | uses_force | uses_quiet | uses_json | uses_threads,
      {{"frictab table diff out/tables/coulomb.h5 out/tables/shear.h5", "how far apart, and where"},
       {"frictab table diff out/tables/coulomb.h5 loose/tables/coulomb.h5 --max-MPa 5",
        "exit code 1 where it is more"}}};
}};

} // namespace frictab::cli::table_diff_command
