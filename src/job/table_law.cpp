// Reads a tabulated law: from columns, or from a table in frictab's own layout.
#include "job/table_law.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/names.h"
#include "core/text.h"
#include "data/raw.h"
#include "io/hdf5.h"
#include "job/law_grid.h"
#include "table/table_file.h"

namespace frictab::job {

namespace {

using models::LawTable;
using models::LawTableAxis;

constexpr std::uintmax_t largest_file = 16 << 20; // bytes; the rows are few

std::optional<LawTable> of_frictab_table(const models::LawText& text, const std::string& path,
                                         const Place& place, FaultList& faults) {
  const Place whole{path, 0, 0};
  const table::Table described = table::read_description(path).table;
  if (described.interpolation != table::Interpolation::linear)
    faults.add(whole, "is interpolated by cubic splines, and a law that is a table is linear",
               "table.interpolation = \"linear\" where it is made");
  else if (described.axes.empty())
    faults.add(whole, "has no axis",
               "a constant is a law of its own: formula = \"0.1*sigma_n_MPa\"");
  else if (described.nodes() > models::most_law_nodes)
    faults.add(
        whole, fmt::format("has {} nodes", thousands(described.nodes())),
        fmt::format("a law that is a table has at most {}", thousands(models::most_law_nodes)));
  else if (!text.log_axes.empty())
    faults.add(place,
               "models." + text.name +
                   ".log_axes: the table says itself which axes are logarithmic",
               "leave log_axes out");
  else {
    const table::Table table = table::read_table(path);
    LawTable out;
    out.quantity = table.quantity;
    out.log_value = table.log_value;
    for (const table::TableAxis& axis : table.axes)
      out.axes.push_back({axis.name, axis.log, axis.nodes, whole});
    out.value = table.value;
    std::map<std::string, expr::Expr> numbers;
    for (const auto& [name, number] : table.constants)
      numbers.emplace(name, number);
    out.combine = substitute(table.combine, numbers);
    return out;
  }
  return std::nullopt;
}

std::optional<LawTable> of_rows(const models::LawText& text, const std::string& path,
                                const Place& place, FaultList& faults) {
  const std::size_t before = faults.size();
  std::error_code unknown;
  if (std::filesystem::file_size(path, unknown) > largest_file && !unknown)
    throw InputError({path, 0, 0}, "is too large for a law that is a table",
                     fmt::format("at most {} nodes and {}", thousands(models::most_law_nodes),
                                 human_bytes(static_cast<double>(largest_file))));
  const io::CsvTable raw = data::read_raw(path, path, {}, faults);
  if (faults.size() > before) return std::nullopt;
  std::optional<LawColumns> columns = read_law_columns(raw, faults);
  if (!columns) return std::nullopt;
  std::optional<LawTable> table = full_grid(std::move(*columns), raw, faults);
  if (!table) return std::nullopt;
  for (const std::string& name : text.log_axes) {
    const auto found = std::ranges::find(table->axes, name, &LawTableAxis::name);
    if (found == table->axes.end())
      faults.add(place, fmt::format("{} has no axis '{}'", path, name),
                 "log_axes names some of: " +
                     join(all_names(table->axes, &LawTableAxis::name), ", "));
    else if (found->nodes.front() <= 0)
      faults.add(place,
                 fmt::format("the axis {} cannot be logarithmic: it starts at {}", name,
                             shortest(found->nodes.front())),
                 "leave it out of log_axes, or begin above 0");
    else
      found->log = true;
  }
  if (faults.size() > before) return std::nullopt;
  return table;
}

bool has_frictab_layout(const std::string& path) {
  return io::looks_like_hdf5(path) && io::Hdf5Reader(path, path).has("value");
}

} // namespace

std::optional<LawTable> read_law_table(const models::LawText& text, const std::string& path,
                                       const Place& place, FaultList& faults) {
  std::optional<LawTable> table;
  try {
    table = has_frictab_layout(path) ? of_frictab_table(text, path, place, faults)
                                     : of_rows(text, path, place, faults);
  } catch (const InputError& error) {
    faults.add(error);
  }
  if (!table) return std::nullopt;
  table->name = text.name;
  table->title = text.title;
  table->reference = text.reference;
  table->file = text.table;
  return table;
}

} // namespace frictab::job
