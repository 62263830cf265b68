// Finds, converts and checks the columns of one file.
#include "data/mapping.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/quantity.h"

namespace frictab {

namespace {

const char* const experiment_column = "experiment";

std::string strip_brackets(std::string unit) {
  if (unit.size() >= 2 && std::string("[(").find(unit.front()) != std::string::npos &&
      std::string("])").find(unit.back()) != std::string::npos)
    unit = unit.substr(1, unit.size() - 2);
  return unit;
}

class Mapper {
public:
  Mapper(const CsvTable& raw, const DataOptions& options, FaultList& faults)
      : raw_(raw), options_(options), faults_(faults) {}

  MappedFile map() {
    for (const Quantity& quantity : quantities())
      map_quantity(quantity);
    map_experiment();
    multiply_coefficients();
    map_bystanders();
    return std::move(out_);
  }

private:
  Place header() const { return {raw_.file, raw_.header_line, 0}; }

  std::vector<std::string> present() const {
    std::vector<std::string> names;
    for (const CsvColumn& column : raw_.columns)
      if (!column.name.empty()) names.push_back(column.name);
    return names;
  }

  // The raw column a canonical name comes from; nullptr where it is not in the file. Adds a fault
  // where it is asked for and absent, or ambiguous.
  const CsvColumn* source(const std::string& canonical) {
    const auto mapped = options_.columns.find(canonical);
    if (mapped == options_.columns.end())
      return options_.constants.count(canonical) ? nullptr : by_name(canonical);
    const ColumnSource& from = mapped->second;
    if (from.number > 0) {
      if (from.number <= raw_.columns.size()) return &raw_.columns[from.number - 1];
      faults_.add(from.place, fmt::format("{}: column number {} is beyond the {} columns of {}",
                                          canonical, from.number, raw_.columns.size(), raw_.file));
      return nullptr;
    }
    for (const std::string& name : from.names)
      if (const CsvColumn* column = by_name(name)) return column;
    faults_.add(header(),
                fmt::format("there is no column '{}' (wanted for {})", join(from.names, "' or '"),
                            canonical),
                suggest(from.names.empty() ? canonical : from.names.front(), present()) +
                    "; mapped at " + format_place(from.place));
    return nullptr;
  }

  const CsvColumn* by_name(const std::string& name) {
    const CsvColumn* found = nullptr;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < raw_.columns.size(); ++i)
      if (raw_.columns[i].name == name) {
        if (!found) found = &raw_.columns[i];
        places.push_back(i + 1);
      }
    if (places.size() > 1 && ambiguous_.insert(name).second)
      faults_.add(header(),
                  fmt::format("there are {} columns '{}': {}", places.size(), name,
                              fmt::join(places, ", ")),
                  fmt::format("take one by its number: {{ column = {} }}", places.front()));
    return found;
  }

  // All cells of a column as numbers; a fault for each that is none.
  std::vector<double> numbers(const CsvColumn& column, const std::string& canonical) {
    for (const CsvColumn::Text& cell : column.texts) {
      const bool comma = options_.decimal == '.' && cell.text.find(',') != std::string::npos;
      faults_.add(row_place(raw_, cell.row),
                  cell.text.empty() ? fmt::format("{}: the cell is empty", canonical)
                                    : fmt::format("{}: '{}' is not a number", canonical, cell.text),
                  comma ? "a decimal comma? set data.decimal = \",\"" : "");
    }
    std::size_t text = 0;
    for (std::size_t i = 0; i < column.numbers.size(); ++i) {
      while (text < column.texts.size() && column.texts[text].row < i)
        ++text;
      const bool is_text = text < column.texts.size() && column.texts[text].row == i;
      if (!is_text && !std::isfinite(column.numbers[i]))
        faults_.add(row_place(raw_, i),
                    fmt::format("{}: {} is not a finite number{}", canonical, column.numbers[i],
                                row_text(i)),
                    "leave the row out, or repair it");
    }
    return column.numbers;
  }

  std::string row_text(std::size_t row) const {
    return raw_.header_line > 0 ? "" : fmt::format(" (row {})", raw_.line[row]);
  }

  void map_quantity(const Quantity& quantity) {
    const CsvColumn* column = source(quantity.name);
    if (!column) {
      if (const auto constant = options_.constants.find(quantity.name);
          constant != options_.constants.end())
        out_.columns.push_back(
            {quantity.name, quantity.unit, std::vector<double>(raw_.rows(), constant->second), {}});
      return;
    }
    used_.insert(column);
    Column mapped{quantity.name, quantity.unit, numbers(*column, quantity.name), {}};
    const auto found = options_.columns.find(quantity.name);
    const ColumnSource plain;
    convert_unit(mapped, quantity, *column,
                 found == options_.columns.end() ? plain : found->second);
    out_.columns.push_back(std::move(mapped));
  }

  void convert_unit(Column& column, const Quantity& quantity, const CsvColumn& raw,
                    const ColumnSource& from) {
    std::string unit = !from.unit.empty() ? from.unit : strip_brackets(raw.unit);
    std::string wanted = quantity.unit;
    if (!from.times.empty()) wanted = "1";
    if (from.area_mm2 > 0) wanted = "N";
    if (from.slope_rows > 0) wanted = quantity.unit == "mm/s" ? "mm" : quantity.unit;
    if (unit.empty()) unit = wanted;
    const auto conversion = convert(unit, wanted);
    if (!conversion) {
      faults_.add(
          from.place.file.empty() ? header() : from.place,
          fmt::format("{}: the unit '{}' does not convert to {}", quantity.name, unit, wanted),
          "units that do: " + join(units_like(wanted), ", "));
      return;
    }
    const double area = from.area_mm2 > 0 ? from.area_mm2 : 1;
    if (unit == wanted && area == 1) return; // the file's own bits
    for (double& value : column.values)
      value = (*conversion)(value) / area;
  }

  void map_experiment() {
    const CsvColumn* column = source(experiment_column);
    if (!column) return;
    used_.insert(column);
    out_.experiment.resize(raw_.rows());
    std::size_t text = 0;
    for (std::size_t i = 0; i < raw_.rows(); ++i) {
      while (text < column->texts.size() && column->texts[text].row < i)
        ++text;
      const bool is_text = text < column->texts.size() && column->texts[text].row == i;
      out_.experiment[i] = is_text ? column->texts[text].text : shortest(column->numbers[i]);
      if (out_.experiment[i].empty())
        faults_.add(row_place(raw_, i), "experiment: the cell is empty",
                    "every row needs the name of its test");
    }
  }

  Column* find(const std::string& name) {
    for (Column& column : out_.columns)
      if (column.name == name) return &column;
    return nullptr;
  }

  void multiply_coefficients() {
    for (const auto& [canonical, from] : options_.columns) {
      if (from.times.empty()) continue;
      Column* target = find(canonical);
      const Column* factor = find(from.times);
      if (!factor)
        faults_.add(from.place, fmt::format("{}: times = '{}', which the data do not have",
                                            canonical, from.times));
      if (!target || !factor || target->values.size() != factor->values.size()) continue;
      for (std::size_t i = 0; i < target->values.size(); ++i)
        target->values[i] *= factor->values[i];
      out_.notes.push_back(canonical + " = measured coefficient times " + from.times);
    }
  }

  void map_bystanders() {
    if (options_.bystanders)
      for (const std::string& name : *options_.bystanders)
        if (!by_name(name))
          faults_.add(header(), fmt::format("there is no column '{}' (data.bystanders)", name),
                      suggest(name, present()));
    for (const CsvColumn& column : raw_.columns) {
      if (used_.count(&column) || column.name.empty()) continue;
      if (find_quantity(column.name)) continue; // its canonical name is mapped from elsewhere
      const auto& keep = options_.bystanders;
      if (keep && std::find(keep->begin(), keep->end(), column.name) == keep->end()) continue;
      if (by_name(column.name) != &column) continue; // a duplicate: the fault is told already
      add_bystander(column);
    }
  }

  void add_bystander(const CsvColumn& raw) {
    const auto empty = static_cast<std::size_t>(
        std::count_if(raw.texts.begin(), raw.texts.end(),
                      [](const CsvColumn::Text& cell) { return cell.text.empty(); }));
    Column column{raw.name, "", raw.numbers, {}};
    if (raw.texts.size() > empty) {
      if (raw.texts.size() - empty < raw_.rows() / 2) {
        for (const CsvColumn::Text& cell : raw.texts)
          if (!cell.text.empty())
            faults_.add(row_place(raw_, cell.row),
                        fmt::format("{}: '{}' is not a number, as most of the column is", raw.name,
                                    cell.text),
                        "repair the cell, or leave the column out by listing the others in "
                        "data.bystanders");
        return;
      }
      make_categorical(column, raw);
    } else if (empty > 0)
      out_.notes.push_back(fmt::format("{}: {} cells are empty", raw.name, thousands(empty)));
    out_.columns.push_back(std::move(column));
  }

  void make_categorical(Column& column, const CsvColumn& raw) {
    std::vector<std::string> cells(raw_.rows());
    for (std::size_t i = 0; i < cells.size(); ++i)
      cells[i] = shortest(raw.numbers[i]);
    for (const CsvColumn::Text& cell : raw.texts)
      cells[cell.row] = cell.text;
    std::set<std::string> levels(cells.begin(), cells.end());
    column.levels.assign(levels.begin(), levels.end());
    for (std::size_t i = 0; i < cells.size(); ++i)
      column.values[i] = static_cast<double>(
          std::lower_bound(column.levels.begin(), column.levels.end(), cells[i]) -
          column.levels.begin());
  }

  const CsvTable& raw_;
  const DataOptions& options_;
  FaultList& faults_;
  MappedFile out_;
  std::set<const CsvColumn*> used_;
  std::set<std::string> ambiguous_;
};

} // namespace

MappedFile map_columns(const CsvTable& raw, const DataOptions& options, FaultList& faults) {
  return Mapper(raw, options, faults).map();
}

} // namespace frictab
