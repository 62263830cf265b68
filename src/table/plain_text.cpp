// Plain-text formats that store the table as it is.
#include "table/plain_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace frictab::table {

const PlainFormat& plain_format(const std::string& name) {
  const PlainFormat* format = Registry<PlainFormat>::instance().find(name);
  if (format) return *format;
  std::vector<std::string> names;
  for (const PlainFormat& one : Registry<PlainFormat>::instance().all())
    names.push_back(one.name);
  throw InputError({}, fmt::format("there is no format '{}'", name), suggest(name, names));
}

namespace {

constexpr std::size_t rows_at_once = 4096;

// Passes the values to `body`, a block at a time.
template <class Body> void for_values(const Table& table, const Body& body) {
  std::vector<double> block;
  for (std::size_t first = 0; first < table.nodes(); first += rows_at_once) {
    block.resize(std::min(rows_at_once, table.nodes() - first));
    std::copy_n(table.value.begin() + static_cast<long>(first), block.size(), block.begin());
    body(first, block);
  }
}

// Writes one line per node: axes, the tabulated quantity, and tau_R if every state is known.
void write_csv(const PlainRequest& request, std::ostream& out) {
  const Table& table = request.table;
  const auto inputs = table.inputs();
  std::vector<std::string> held, row;
  for (const std::string& name : inputs)
    if (!find_axis(table, name) && request.fixed.count(name)) held.push_back(name);
  const bool known = held.size() + table.axes.size() == inputs.size();
  for (const TableAxis& axis : table.axes)
    row.push_back(axis.name);
  for (const std::string& name : held)
    row.push_back(name);
  row.push_back(table.quantity == models::PieceQuantity::mu ? "mu" : "value_MPa");
  if (known) row.push_back("tau_R_MPa");
  out << join(row, ",") << '\n';
  const TableFunction function(table);
  std::vector<double> state(inputs.size());
  for_values(table, [&](std::size_t first, const std::vector<double>& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      row.clear();
      std::size_t rest = first + i;
      for (std::size_t a = table.axes.size(); a-- > 0;) {
        const std::vector<double>& nodes = table.axes[a].nodes;
        const double x = nodes[rest % nodes.size()];
        rest /= nodes.size();
        row.insert(row.begin(), shortest(x));
        state[static_cast<std::size_t>(std::ranges::find(inputs, table.axes[a].name) -
                                       inputs.begin())] = x;
      }
      for (const std::string& name : held) {
        const double x = request.fixed.at(name);
        row.push_back(shortest(x));
        state[static_cast<std::size_t>(std::ranges::find(inputs, name) - inputs.begin())] = x;
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
