// Writes tables, asks Python what it says.
#include "support/rebuilt.h"

#include <fmt/format.h>

#include "data/quantity.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "table/table_file.h"

namespace frictab::test {
namespace {

// 500 random states and tau_R there.
std::string states_csv(const table::Table& table) {
  const table::TableFunction function(table);
  auto states = random_states(function.inputs(), 500, 17);
  for (std::size_t c = 0; c < states.size(); ++c) // what an effect brought in
    if (const std::string& name = function.inputs()[c]; !data::find_quantity(name))
      if (const auto range = table.range(name))
        for (double& x : states[c])
          x = range->first + x * (range->second - range->first);
  std::string csv;
  for (const std::string& name : function.inputs())
    csv += name + ",";
  csv += "tau_R_MPa\n";
  for (std::size_t i = 0; i < 500; ++i) {
    std::vector<double> state;
    for (const auto& column : states) {
      state.push_back(column[i]);
      csv += fmt::format("{},", column[i]);
    }
    csv += fmt::format("{}\n", function(state));
  }
  return csv;
}

} // namespace

std::string rebuilt_by_python(const std::vector<table::Table>& tables) {
  const TemporaryDirectory directory;
  std::vector<std::string> command = {FRICTAB_PYTHON,
                                      FRICTAB_SOURCE_DIR "/tests/support/rebuild_tau.py"};
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string name = std::to_string(i);
    table::write_table(tables[i], directory.path(name + ".h5"));
    command.push_back(directory.path(name + ".h5"));
    command.push_back(directory.write(name + ".csv", states_csv(tables[i])));
  }
  const auto result = run_command(command);
  return result.exit_code == 0 ? result.out : result.err;
}

std::string rebuilt_by_python(const table::Table& table) {
  return rebuilt_by_python(std::vector{table});
}

} // namespace frictab::test
