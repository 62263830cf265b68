// Expands one row per experiment to one value per row.
#include "data/test_table.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/quantity.h"

namespace frictab::data {

namespace {

// Takes mapped columns that the table has from it, and leaves all others to the data files.
DataOptions take_over(DataOptions& options, const io::CsvTable& raw) {
  const auto is_here = [&](const std::string& name) {
    return std::any_of(raw.columns.begin(), raw.columns.end(), [&](const io::CsvColumn& column) {
      return column.name == name || io::read_header_name(column.name).name == name;
    });
  };
  DataOptions own = options;
  own.constants.clear();
  own.bystanders.reset();
  own.experiment.clear();
  for (const auto& [canonical, from] : options.columns)
    if (from.number > 0 || std::none_of(from.names.begin(), from.names.end(), is_here))
      own.columns.erase(canonical);
  for (const auto& [canonical, from] : own.columns)
    if (canonical != "experiment") options.columns.erase(canonical);
  return own;
}

} // namespace

TestTable read_test_table(DataOptions& options) {
  TestTable table;
  table.file = options.tests;
  FaultList faults;
  const auto path = std::filesystem::path(options.base) / options.tests;
  DataOptions dialect = options;
  dialect.skip_rows = dialect.skip_footer = 0;
  dialect.units_row = false;
  io::CsvTable raw = read_raw(path.string(), options.tests, dialect, faults);
  table.header_line = raw.header_line;
  table.columns = map_columns(raw, ReadRequest(take_over(options, raw)), "", faults);
  FaultsByCause causes;
  for (MappedFile::CellFault& cell : table.columns.cell_faults)
    causes.add(cell.cause, std::move(cell.fault));
  causes.tell(faults, "cell");
  if (table.columns.experiment.empty())
    faults.add({options.tests, raw.header_line, 0}, "there is no column experiment",
               "a table of tests names each test as the data files do; [data.columns] experiment "
               "may give the column's own name");
  for (std::size_t i = 0; i < table.columns.experiment.size(); ++i)
    if (const auto [found, is_new] = table.row.emplace(table.columns.experiment[i], i); !is_new)
      faults.add(row_place(raw, i), fmt::format("test '{}' stands here again", found->first),
                 fmt::format("it stands in line {} already", raw.line[found->second]));
  faults.throw_if_any();
  return table;
}

void add_test_columns(Part& part, const TestTable& table) {
  const Dataset& data = part.data;
  std::vector<std::size_t> row; // row of the table for each experiment
  std::vector<std::string> missing, known;
  for (const std::string& name : data.experiments) {
    const auto found = table.row.find(name);
    row.push_back(found == table.row.end() ? 0 : found->second);
    if (found == table.row.end()) missing.push_back(name);
  }
  for (const auto& [name, at] : table.row)
    known.push_back(name);
  for (const std::string& name : missing)
    part.faults.add({table.file, table.header_line, 0},
                    fmt::format("test '{}' of {} is not in this table", name, part.raw.file),
                    "add a row for it (a cell may be empty); " + suggest(name, known));
  if (!missing.empty()) return;
  std::set<std::string> there;
  for (const Column& column : part.data.columns)
    there.insert(column.name);
  std::vector<std::string> names;
  for (const Column& column : table.columns.columns) {
    if (there.count(column.name) > 0) {
      part.faults.add({table.file, table.header_line, 0},
                      fmt::format("column {} is in {} as well", column.name, part.raw.file),
                      "keep one of the two");
      continue;
    }
    Column out{column.name, column.unit, std::vector<double>(data.rows()), column.levels};
    for (std::size_t e = 0; e < row.size(); ++e)
      std::fill(out.values.begin() + static_cast<long>(data.first_row[e]),
                out.values.begin() + static_cast<long>(data.first_row[e + 1]),
                column.values[row[e]]);
    names.push_back(column.name);
    part.data.columns.push_back(std::move(out));
  }
  part.data.notes.push_back(fmt::format("{}: {}, by test", table.file, join(names, ", ")));
  for (const std::string& note : table.columns.notes)
    part.data.notes.push_back(fmt::format("{}: {}", table.file, note));
}

} // namespace frictab::data
