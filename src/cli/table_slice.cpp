// frictab table slice FILE: tau_R along one or two states.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/table_command.h"
#include "core/error.h"
#include "report/slice_plot.h"
#include "table/slice.h"
#include "table/table_file.h"

namespace frictab::cli::table_slice_command {

struct Options {
  std::string file;
  std::vector<std::string> at;
  std::vector<std::string> along;
  std::size_t points = 0;
  bool csv = false;
  std::string svg; // file, "-" for -o or stdout; empty: no plot
  bool plot = false;
};

int run(const Options& options, const CommonOptions& common) {
  if (options.along.size() > 2)
    throw InputError({}, "--along is given more than twice", "hold the other states by --at");
  const table::Table table = table::read_table(options.file);
  table::FixedStates held = table::fixed_states(options.at, table.inputs());
  const std::vector<std::string> middle = table::hold_others(table, options.along, held);
  std::size_t points = options.points;
  if (points == 0) points = options.along.size() == 2 ? 41 : 101;
  const table::Slice result = table::slice(table, held, options.along, points);
  for (const std::string& line : middle)
    note(common, "note: " + line);
  for (const std::string& line : table::check_fixed_states(table, held))
    note(common, "note: " + line);
  CommonOptions output = common;
  if (!options.svg.empty()) output.output = options.svg;
  write_result(output, [&](std::ostream& out) {
    out << (options.plot ? report::slice_svg(result) : table::slice_csv(result));
  });
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "Table file (HDF5)")->required();
  add_fixed_states_option(app, options->at);
  app.add_option("--along", options->along, "A state that runs over its range; twice for two")
      ->type_name("NAME")
      ->required()
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--points", options->points,
                 "Places per state, evenly in the axis' coordinate [101; 41 for two]")
      ->type_name("N")
      ->check(CLI::Range(2, 100000));
  CLI::Option* csv = app.add_flag("--csv", options->csv, "States and tau_R_MPa (default)");
  app.add_option_function<std::string>(
         "--svg",
         [options](const std::string& file) {
           options->plot = true;
           options->svg = file;
         },
         "A plot, in this file; without a name to -o or stdout")
      ->type_name("[FILE]")
      ->expected(0, 1)
      ->excludes(csv);
  output_is_a_file(app);
  return [options, &common] { return run(*options, common); };
}

const Registered<Command> registered{[] {
  return Command{
      "table slice",
      12,
      "tau_R along one or two states, as CSV or SVG",
      declare,
      uses_output | uses_force | uses_quiet,
      {{"frictab table slice out/tables/coulomb.h5 --along sigma_n_MPa --at sigma_f_MPa=480",
        "CSV"},
       {"frictab table slice out/tables/coulomb.h5 --along sigma_n_MPa --svg mu.svg", "a plot"}}};
}};

} // namespace frictab::cli::table_slice_command
