// From the rows of a file to a full grid.
#include "job/table_law.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/meaning.h"
#include "data/quantity.h"
#include "data/raw.h"
#include "effects/extended_law.h"
#include "io/csv.h"
#include "io/hdf5.h"
#include "table/table_file.h"

namespace frictab::job {

namespace {

using io::CsvColumn;
using models::LawTable;
using models::LawTableAxis;

constexpr const char* mu_column = "mu";
constexpr const char* stress_column = "tau_R_MPa";
constexpr double largest = 1e100;
constexpr std::uintmax_t largest_file = 16 << 20; // of what can have so few rows

bool is_value_column(const std::string& name) {
  return name == mu_column || name == stress_column;
}

// ---- columns of a file, row by row ----

class GridReader {
public:
  GridReader(const io::CsvTable& raw, FaultList& faults) : raw_(raw), faults_(faults) {}

  std::optional<LawTable> read() {
    const std::size_t before = faults_.size();
    read_columns();
    if (faults_.size() == before) check_numbers();
    if (faults_.size() == before) find_nodes();
    if (faults_.size() == before) fill();
    if (faults_.size() > before) return std::nullopt;
    return std::move(out_);
  }

private:
  Place header() const { return {raw_.file, raw_.header_line, 0}; }

  void read_columns() {
    for (const CsvColumn& column : raw_.columns) {
      io::HeaderName header_name = io::read_header_name(column.name);
      if (!column.unit.empty()) header_name.unit = io::without_brackets(column.unit);
      const std::string& name = header_name.name;
      if (is_value_column(name))
        take_value(column, header_name);
      else
        take_axis(column, header_name);
    }
    if (!has_value_)
      faults_.add(header(), "has no column mu or tau_R_MPa",
                  "a law that is a table has a column per axis and one of these");
    if (out_.axes.empty())
      faults_.add(header(), "has no axis", "columns of states beside mu or tau_R_MPa");
  }

  void take_value(const CsvColumn& column, const io::HeaderName& name) {
    if (has_value_)
      faults_.add(header(), "has more than one column mu or tau_R_MPa", "leave one of them");
    has_value_ = true;
    out_.quantity =
        name.name == mu_column ? models::PieceQuantity::mu : models::PieceQuantity::tau_R;
    value_ = in_unit(column, name, name.name == mu_column ? "1" : "MPa");
  }

  void take_axis(const CsvColumn& column, const io::HeaderName& name) {
    const std::string symbol = effects::symbol_of(name.name);
    const data::Quantity* quantity = data::find_quantity(symbol);
    const auto same = [&](const LawTableAxis& axis) { return axis.name == symbol; };
    if (std::any_of(out_.axes.begin(), out_.axes.end(), same))
      faults_.add(header(), fmt::format("there are two columns '{}'", name.name),
                  "leave one of them");
    else if (quantity && !quantity->state)
      faults_.add(header(), fmt::format("{} is no state of a contact, and no axis", symbol),
                  "leave the column out");
    out_.axes.push_back({symbol, false, {}, header()});
    positions_.push_back(in_unit(column, name, quantity ? quantity->unit : ""));
  }

  // The numbers in `unit`; what is no number is a fault. Without a unit, as they stand.
  std::vector<double> in_unit(const CsvColumn& column, const io::HeaderName& name,
                              const std::string& unit) {
    for (const CsvColumn::Text& cell : column.texts)
      faults_.add(data::row_place(raw_, cell.row, cell.column),
                  cell.text.empty() ? fmt::format("{}: the cell is empty", name.name)
                                    : fmt::format("{}: '{}' is not a number", name.name, cell.text),
                  "a number with a decimal point for every node");
    std::vector<double> numbers = column.numbers;
    if (unit.empty() || name.unit.empty()) return numbers;
    const auto conversion = convert(name.unit, unit);
    if (!conversion)
      faults_.add(header(), fmt::format("{} cannot be in '{}'", name.name, name.unit),
                  "one of: " + join(units_like(unit), ", "));
    else
      for (double& number : numbers)
        number = (*conversion)(number);
    return numbers;
  }

  void check_numbers() {
    for (std::size_t a = 0; a < out_.axes.size(); ++a)
      check_column(out_.axes[a].name, positions_[a], data::meaning_of(out_.axes[a].name).lowest);
    check_column(out_.quantity == models::PieceQuantity::mu ? mu_column : stress_column, value_, 0);
  }

  void check_column(const std::string& name, const std::vector<double>& numbers, double lowest) {
    FaultsByCause found;
    for (std::size_t row = 0; row < numbers.size(); ++row)
      if (!(std::abs(numbers[row]) < largest)) // so that no step between nodes overflows
        found.add("finite",
                  {data::row_place(raw_, row),
                   fmt::format("{}: {} is too large or no number", name, shortest(numbers[row])),
                   ""});
      else if (numbers[row] < lowest)
        found.add("low", {data::row_place(raw_, row),
                          fmt::format("{} = {} is below {}", name, shortest(numbers[row]),
                                      shortest(lowest)),
                          ""});
    found.tell(faults_, "rows");
  }

  void find_nodes() {
    double count = 1;
    for (std::size_t a = 0; a < out_.axes.size(); ++a) {
      std::vector<double>& nodes = out_.axes[a].nodes;
      nodes = positions_[a];
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      check_distances(out_.axes[a]);
      count *= static_cast<double>(nodes.size());
    }
    const double rows = static_cast<double>(raw_.rows());
    if (count > rows && count > models::most_law_nodes)
      faults_.add(
          header(),
          fmt::format("is no full grid: {} rows for {} nodes", thousands(raw_.rows()), sizes()),
          "a row for every combination of the axes' values; fit scattered points with a "
          "law, or resample them");
    else if (count > models::most_law_nodes)
      faults_.add(header(), fmt::format("has {} nodes", sizes()),
                  fmt::format("a law that is a table has at most {}: take fewer nodes",
                              thousands(models::most_law_nodes)));
  }

  void check_distances(const LawTableAxis& axis) {
    const std::vector<double>& nodes = axis.nodes;
    if (nodes.size() < 2)
      faults_.add(header(),
                  fmt::format("{} has one value alone, {}", axis.name, shortest(nodes.front())),
                  "an axis has at least two; leave the column out");
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      if (nodes[i + 1] - nodes[i] < 1e-9 * std::max(std::abs(nodes[i]), std::abs(nodes[i + 1])))
        faults_.add(header(),
                    fmt::format("{} has the nodes {} and {}, which are as good as one", axis.name,
                                shortest(nodes[i]), shortest(nodes[i + 1])),
                    "write the same number in all rows of a node");
  }

  // "12 x 5 = 60".
  std::string sizes() const {
    std::vector<std::string> counts;
    double product = 1;
    for (const LawTableAxis& axis : out_.axes) {
      counts.push_back(std::to_string(axis.nodes.size()));
      product *= static_cast<double>(axis.nodes.size());
    }
    return fmt::format("{} = {:.6g}", join(counts, " x "), product);
  }

  void fill() {
    std::size_t count = 1;
    for (const LawTableAxis& axis : out_.axes)
      count *= axis.nodes.size();
    out_.value.assign(count, 0);
    std::vector<std::size_t> row_of(count, raw_.rows());
    for (std::size_t row = 0; row < raw_.rows(); ++row) {
      const std::size_t node = node_of(row);
      if (row_of[node] < raw_.rows())
        faults_.add(data::row_place(raw_, row),
                    fmt::format("the node {} stands already in {}", state_text(node),
                                raw_.header_line > 0
                                    ? fmt::format("line {}", raw_.line[row_of[node]])
                                    : fmt::format("row {}", raw_.line[row_of[node]])),
                    "one row for every node");
      row_of[node] = row;
      out_.value[node] = value_[row];
    }
    tell_missing(row_of);
  }

  std::size_t node_of(std::size_t row) const {
    std::size_t node = 0;
    for (std::size_t a = 0; a < out_.axes.size(); ++a) {
      const std::vector<double>& nodes = out_.axes[a].nodes;
      const auto at = std::lower_bound(nodes.begin(), nodes.end(), positions_[a][row]);
      node = node * nodes.size() + static_cast<std::size_t>(at - nodes.begin());
    }
    return node;
  }

  void tell_missing(const std::vector<std::size_t>& row_of) {
    const auto is_missing = [&](std::size_t row) { return row == raw_.rows(); };
    const auto missing = std::count_if(row_of.begin(), row_of.end(), is_missing);
    if (missing == 0) return;
    const auto first = std::find_if(row_of.begin(), row_of.end(), is_missing) - row_of.begin();
    faults_.add(
        header(),
        fmt::format("has no row for the node {}{}", state_text(static_cast<std::size_t>(first)),
                    missing > 1 ? fmt::format(" (and {} more of {})", missing - 1, row_of.size())
                                : ""),
        "a row for every combination of the axes' values");
  }

  std::string state_text(std::size_t node) const {
    std::string text;
    for (std::size_t a = out_.axes.size(); a-- > 0;) {
      const std::vector<double>& nodes = out_.axes[a].nodes;
      text = fmt::format("{} = {}{}{}", out_.axes[a].name, shortest(nodes[node % nodes.size()]),
                         text.empty() ? "" : ", ", text);
      node /= nodes.size();
    }
    return text;
  }

  const io::CsvTable& raw_;
  FaultList& faults_;
  LawTable out_;
  bool has_value_ = false;
  std::vector<double> value_;
  std::vector<std::vector<double>> positions_; // by axis and row
};

// ---- a table in frictab's own layout ----

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
                   ".log_axes: the table says itself which axes are "
                   "logarithmic",
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
  std::optional<LawTable> table = GridReader(raw, faults).read();
  if (!table) return std::nullopt;
  for (const std::string& name : text.log_axes) {
    const auto found = std::find_if(table->axes.begin(), table->axes.end(),
                                    [&](const LawTableAxis& axis) { return axis.name == name; });
    std::vector<std::string> names;
    for (const LawTableAxis& axis : table->axes)
      names.push_back(axis.name);
    if (found == table->axes.end())
      faults.add(place, fmt::format("{} has no axis '{}'", path, name),
                 "log_axes names some of: " + join(names, ", "));
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
    for (const Fault& fault : error.faults())
      faults.add(fault.place, fault.what, fault.hint);
  }
  if (!table) return std::nullopt;
  table->name = text.name;
  table->title = text.title;
  table->reference = text.reference;
  table->file = text.table;
  return table;
}

} // namespace frictab::job
