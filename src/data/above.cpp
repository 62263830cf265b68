#include "data/above.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "core/units.h"
#include "data/computed.h"
#include "io/number.h"

namespace frictab::data {

namespace {

bool is_called(const std::string& whole, const std::string& name) {
  return whole == name || io::read_header_name(whole).name == name;
}

bool has_column(const io::CsvTable& raw, const std::string& name) {
  return std::any_of(raw.columns.begin(), raw.columns.end(),
                     [&](const io::CsvColumn& column) { return is_called(column.name, name); });
}

// Names that the job takes from its files. A quantity with several possible names needs none where
// one of them is a column.
std::set<std::string> names_of_job(const io::CsvTable& raw, const Reading& options) {
  std::set<std::string> names(options.above.begin(), options.above.end());
  for (const auto& [canonical, source] : options.columns)
    if (std::none_of(source.names.begin(), source.names.end(),
                     [&](const std::string& name) { return has_column(raw, name); }))
      names.insert(source.names.begin(), source.names.end());
  for (const Quantity& quantity : options.quantities)
    if ((quantity.state || quantity.name == "F_N_N") && !options.columns.count(quantity.name) &&
        !options.constants.count(quantity.name))
      names.insert(quantity.name);
  return names;
}

void add_column(io::CsvTable& raw, const io::CsvAbove& line, char decimal) {
  const ValueAbove value = read_value_above(line.value, decimal);
  io::CsvColumn column{line.name, value.unit, {}, {}};
  column.numbers.assign(raw.rows(), value.is_number ? value.number : no_value);
  for (std::size_t row = 0; !value.is_number && row < raw.rows(); ++row)
    column.texts.push_back({row, line.value, 0});
  raw.columns.push_back(std::move(column));
}

} // namespace

ValueAbove read_value_above(const std::string& text, char decimal) {
  std::size_t end = text.find_first_not_of("+-.,0123456789eE");
  if (end == text.npos) end = text.size();
  ValueAbove value;
  std::string number = text.substr(0, end);
  while (number.ends_with(',')) // of the cells "1.961,N"
    number.pop_back();
  if (!io::read_number(number, decimal, value.number) &&
      !io::read_number(number, decimal == '.' ? ',' : '.', value.number))
    return {};
  const std::size_t unit = text.find_first_not_of(" \t;,", end);
  value.is_number = true;
  if (unit == text.npos) return value;
  value.unit = io::without_brackets(text.substr(unit));
  return convert(value.unit, value.unit) ? value : ValueAbove();
}

void add_values_above(io::CsvTable& raw, const Reading& options, FaultList& faults) {
  const std::set<std::string> wanted = names_of_job(raw, options),
                              listed(options.above.begin(), options.above.end());
  const std::set<std::string> in_formulas = names_in_formulas(options);
  std::vector<std::string> taken;
  for (const io::CsvAbove& line : raw.above) {
    const std::string bare = io::read_header_name(line.name).name;
    const bool is_named =
        wanted.count(line.name) || wanted.count(bare) || is_named_by(in_formulas, line.name);
    const bool is_column =
        has_column(raw, line.name) || (has_column(raw, bare) && listed.count(line.name) == 0);
    if (!is_named || is_column) continue;
    add_column(raw, line, options.decimal);
    taken.push_back(line.name);
  }
  if (!taken.empty()) raw.notes.push_back("from lines above the rows: " + join(taken, ", "));
  for (const std::string& name : options.above) {
    if (has_column(raw, name)) continue;
    std::vector<std::string> known;
    for (const io::CsvAbove& line : raw.above)
      known.push_back(line.name);
    faults.add({raw.file, raw.header_line, 0},
               raw.header_line > 0
                   ? fmt::format("no line above the rows gives '{}' (data.above)", name)
                   : fmt::format("no value of the whole file is called '{}' (data.above)", name),
               known.empty() ? "there are no such lines or values" : suggest(name, known));
  }
}

} // namespace frictab::data
