// Plain-text formats that store the table as it is.
#include "table/plain_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/names.h"
#include "core/text.h"

namespace frictab::table {

const PlainFormat& plain_format(const std::string& name) {
  const PlainFormat* format = Registry<PlainFormat>::instance().find(name);
  if (format) return *format;
  throw InputError({}, fmt::format("there is no format '{}'", name),
                   suggest(name, all_names(Registry<PlainFormat>::instance().all())));
}

namespace {

constexpr std::size_t rows_at_once = 4096;

// Passes the values to `body`, a block at a time.
template <class Body> void for_values(const Table& table, const Body& body) {
  std::vector<double> block;
  for (std::size_t first = 0; first < table.nodes(); first += rows_at_once) {
    block.resize(std::min(rows_at_once, table.nodes() - first));
    std::copy_n(table.value.begin() + first, block.size(), block.begin());
    body(first, block);
  }
}

// Writes one line per node: axes, the tabulated quantity, and tau_R if every state is known.
void write_csv(const PlainRequest& request, std::ostream& out) {
  const Table& table = request.table;
  const auto inputs = table.inputs();
  std::vector<std::string> row = all_names(table.axes);
  std::vector<double> fixed;
  for (const std::string& name : inputs)
    if (!find_axis(table, name) && request.fixed.count(name)) {
      row.push_back(name);
      fixed.push_back(request.fixed.at(name));
    }
  const bool known = row.size() == inputs.size();
  std::vector<std::size_t> input; // of each column
  for (const std::string& name : row)
    input.push_back(static_cast<std::size_t>(std::ranges::find(inputs, name) - inputs.begin()));
  row.push_back(table.quantity == models::PieceQuantity::mu ? "mu" : "value_MPa");
  if (known) row.push_back("tau_R_MPa");
  out << join(row, ",") << '\n';
  const TableFunction function(table);
  std::vector<double> state(inputs.size());
  for_values(table, [&](std::size_t first, const std::vector<double>& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      std::vector<double> columns = values_at(table.axes, first + i);
      columns.insert(columns.end(), fixed.begin(), fixed.end());
      row.clear();
      for (std::size_t c = 0; c < columns.size(); ++c) {
        row.push_back(shortest(columns[c]));
        state[input[c]] = columns[c];
      }
      row.push_back(shortest(block[i]));
      if (known) row.push_back(shortest(function(state)));
      out << join(row, ",") << '\n';
    }
  });
}

// Writes the axes, then all values row-major, one line per run of the last axis.
void write_txt(const PlainRequest& request, std::ostream& out) {
  const Table& table = request.table;
  out << "# " << table.model << ": " << models::quantity_name(table.quantity) << " on a grid, "
      << interpolation_name(table.interpolation) << "; tau_R_MPa = " << expr::to_text(table.combine)
      << '\n';
  for (const auto& [name, value] : table.constants)
    out << "# constant " << name << ' ' << shortest(value) << '\n';
  for (const TableAxis& axis : table.axes) {
    out << "axis " << axis.name << ' ' << axis.unit << ' ' << (axis.log ? "log" : "linear") << ' '
        << axis.nodes.size() << '\n';
    for (const double x : axis.nodes)
      out << shortest(x) << '\n';
  }
  out << "value " << table.nodes() << '\n';
  const std::size_t last = table.axes.empty() ? 1 : table.axes.back().nodes.size();
  for_values(table, [&](std::size_t first, const std::vector<double>& block) {
    for (std::size_t i = 0; i < block.size(); ++i)
      out << shortest(block[i]) << ((first + i + 1) % last == 0 ? '\n' : ' ');
  });
}

const Registered<PlainFormat> csv{[] {
  return PlainFormat{"csv", 1, "a line per node: axes, value; tau_R where --at holds the rest",
                     "ours", write_csv};
}};
const Registered<PlainFormat> txt{[] {
  return PlainFormat{"txt", 2, "axes, then the values row-major, last axis fastest", "ours",
                     write_txt};
}};

} // namespace

} // namespace frictab::table
