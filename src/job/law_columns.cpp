// Finds columns by their headers, and checks every number.
#include "job/law_columns.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/meaning.h"
#include "data/quantity.h"
#include "data/raw.h"
#include "effects/extended_law.h"

namespace frictab::job {

namespace {

using io::CsvColumn;
using models::LawTableAxis;

constexpr const char* mu_column = "mu";
constexpr const char* stress_column = "tau_R_MPa";
constexpr double largest = 1e100;

bool is_value_column(const std::string& name) {
  return name == mu_column || name == stress_column;
}

class LawColumnReader {
public:
  LawColumnReader(const io::CsvTable& raw, FaultList& faults) : raw_(raw), faults_(faults) {}

  std::optional<LawColumns> read() {
    const std::size_t before = faults_.size();
    read_columns();
    if (faults_.size() == before) check_numbers();
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
    if (out_.table.axes.empty())
      faults_.add(header(), "has no axis", "columns of states next to mu or tau_R_MPa");
  }

  void take_value(const CsvColumn& column, const io::HeaderName& name) {
    if (has_value_)
      faults_.add(header(), "has more than one column mu or tau_R_MPa", "leave one of them");
    has_value_ = true;
    out_.table.quantity =
        name.name == mu_column ? models::PieceQuantity::mu : models::PieceQuantity::tau_R;
    out_.value = in_unit(column, name, name.name == mu_column ? "1" : "MPa");
  }

  void take_axis(const CsvColumn& column, const io::HeaderName& name) {
    const std::string symbol = effects::symbol_of(name.name);
    const data::Quantity* quantity = data::find_quantity(symbol);
    const auto same = [&](const LawTableAxis& axis) { return axis.name == symbol; };
    if (std::ranges::any_of(out_.table.axes, same))
      faults_.add(header(), fmt::format("there are two columns '{}'", name.name),
                  "leave one of them");
    else if (quantity && !quantity->state)
      faults_.add(header(), fmt::format("{} is not a state of a contact and not an axis", symbol),
                  "leave the column out");
    out_.table.axes.push_back({symbol, false, {}, header()});
    out_.positions.push_back(in_unit(column, name, quantity ? quantity->unit : ""));
  }

  // Converts the cells to `unit`, or leaves them unconverted if it is empty; a cell that is not a
  // number is a fault.
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
    for (std::size_t a = 0; a < out_.table.axes.size(); ++a)
      check_column(out_.table.axes[a].name, out_.positions[a],
                   data::meaning_of(out_.table.axes[a].name).lowest);
    check_column(out_.table.quantity == models::PieceQuantity::mu ? mu_column : stress_column,
                 out_.value, 0);
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

  const io::CsvTable& raw_;
  FaultList& faults_;
  LawColumns out_;
  bool has_value_ = false;
};

} // namespace

std::optional<LawColumns> read_law_columns(const io::CsvTable& raw, FaultList& faults) {
  return LawColumnReader(raw, faults).read();
}

} // namespace frictab::job
