// Reads a data file of either format into named columns.
#include "data/raw.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "data/quantity.h"
#include "io/atomic_file.h"
#include "io/hdf5.h"

namespace frictab::data {

namespace {

// Every 1-D dataset of the root group is a column; other shapes are no data columns.
io::CsvTable read_hdf5(const std::string& path, const std::string& named, FaultList& faults) {
  const io::Hdf5Reader in(path, named);
  io::CsvTable table;
  table.file = named;
  std::string first;
  std::size_t rows = 0;
  for (const std::string& name : in.datasets()) {
    const auto shape = in.shape(name);
    if (shape.size() != 1) continue;
    if (first.empty()) {
      first = name;
      rows = shape[0];
    }
    if (shape[0] != rows) {
      faults.add({named, 0, 0},
                 fmt::format("column '{}' has {} rows, '{}' has {}", name, shape[0], first, rows));
      continue;
    }
    io::CsvColumn column{name, in.text_attribute(name, "units").value_or(""), {}, {}};
    if (in.is_text(name)) {
      column.numbers.assign(rows, std::numeric_limits<double>::quiet_NaN());
      std::size_t row = 0;
      for (std::string& text : in.texts(name))
        column.texts.push_back({row++, std::move(text), 0});
    } else
      column.numbers = in.values(name);
    table.columns.push_back(std::move(column));
  }
  if (rows == 0)
    throw InputError({named, 0, 0}, "holds no data columns",
                     "a data file has one 1-D dataset per column");
  for (std::size_t i = 0; i < rows; ++i)
    table.line.push_back(i + 1);
  return table;
}

// What columns may be called: as the job maps them, and by their canonical names.
std::vector<std::string> wanted_names(const DataOptions& options) {
  std::vector<std::string> names = {"experiment"};
  for (const Quantity& quantity : quantities())
    names.push_back(quantity.name);
  for (const auto& [canonical, source] : options.columns)
    names.insert(names.end(), source.names.begin(), source.names.end());
  return names;
}

} // namespace

Place row_place(const io::CsvTable& table, std::size_t row, std::size_t column) {
  if (table.header_line == 0) return {table.file, 0, 0};
  return {table.file, table.line[row], column};
}

io::CsvTable read_raw(const std::string& path, const std::string& named, const DataOptions& options,
                      FaultList& faults) {
  if (io::looks_like_hdf5(path)) return read_hdf5(path, named, faults);
  io::CsvFormat format{options.delimiter,
                       options.decimal,
                       options.skip_rows,
                       options.skip_footer,
                       options.units_row,
                       {"experiment"},
                       0,
                       {}};
  if (const auto named_so = options.columns.find("experiment"); named_so != options.columns.end()) {
    format.text_columns = named_so->second.names;
    format.text_number = named_so->second.number;
  }
  if (const std::string column = experiment_column_of(options); !column.empty())
    format.text_columns.push_back(column);
  format.wanted = wanted_names(options);
  return io::parse_csv(io::read_file(path), named, format, faults);
}

} // namespace frictab::data
