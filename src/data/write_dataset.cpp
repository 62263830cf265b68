// Formats CSV text by experiment in parallel; writes HDF5 columns through the wrapper.
#include "data/write_dataset.h"

#include <iterator>
#include <span>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/parallel.h"
#include "io/csv.h"
#include "io/hdf5.h"

namespace frictab::data {

namespace {

std::vector<std::string> quoted_levels(const Column& column) {
  std::vector<std::string> levels;
  for (const std::string& level : column.levels)
    levels.push_back(io::csv_cell(level));
  return levels;
}

void append_rows(const Dataset& data, const std::vector<std::vector<std::string>>& levels,
                 std::size_t experiment, std::string& out) {
  const std::string name = io::csv_cell(data.experiments[experiment]);
  const std::size_t end = data.first_row[experiment + 1];
  out.reserve((end - data.first_row[experiment]) * (name.size() + 10 * data.columns.size() + 2));
  for (std::size_t row = data.first_row[experiment]; row < end; ++row) {
    out += name;
    for (std::size_t c = 0; c < data.columns.size(); ++c) {
      const double value = data.columns[c].values[row];
      out += ',';
      if (levels[c].empty())
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"), value);
      else
        out += levels[c][static_cast<std::size_t>(value)];
    }
    out += '\n';
  }
}

} // namespace

std::string csv_text(const Dataset& data) {
  std::string text = "experiment";
  std::vector<std::vector<std::string>> levels;
  for (const Column& column : data.columns) {
    text += ',' + io::csv_cell(column.name);
    levels.push_back(quoted_levels(column));
  }
  text += '\n';
  std::vector<std::string> parts(data.experiments.size());
  parallel_for(parts.size(), [&](std::size_t e) { append_rows(data, levels, e, parts[e]); });
  std::size_t size = text.size();
  for (const std::string& part : parts)
    size += part.size();
  text.reserve(size);
  for (const std::string& part : parts)
    text += part;
  return text;
}

void write_hdf5_columns(const Dataset& data, const std::filesystem::path& file) {
  io::Hdf5Writer out(file);
  const std::size_t rows = data.rows();
  std::vector<std::string> text(rows);
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t row = data.first_row[e]; row < data.first_row[e + 1]; ++row)
      text[row] = data.experiments[e];
  out.dataset("experiment", text);
  for (const Column& column : data.columns) {
    if (column.levels.empty()) {
      out.dataset(column.name, std::span<const std::size_t>(&rows, 1), column.values, {0, 4, true});
    } else {
      for (std::size_t row = 0; row < rows; ++row)
        text[row] = column.levels[static_cast<std::size_t>(column.values[row])];
      out.dataset(column.name, text);
    }
    if (!column.unit.empty()) out.attribute(column.name, "units", column.unit);
  }
  out.attribute("/", "source", "frictab");
  out.close();
}

} // namespace frictab::data
