// Writes a table, asks Python what it says.
#include "support/rebuilt.h"

#include <fmt/format.h>

#include "data/quantity.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "table/table_file.h"

namespace frictab::test {

std::string rebuilt_by_python(const table::Table& table) {
  const TemporaryDirectory directory;
  table::write_table(table, directory.path("table.h5"));
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
  const std::string file = directory.write("states.csv", csv);
  const std::string script = std::string(FRICTAB_SOURCE_DIR) + "/tests/support/rebuild_tau.py";
  const auto result = run_command({FRICTAB_PYTHON, script, directory.path("table.h5"), file});
  return result.exit_code == 0 ? result.out : result.err;
}

} // namespace frictab::test
