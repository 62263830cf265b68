// Conditions that stand above the rows.
#include "guess/conditions.h"

#include <algorithm>
#include <cctype>

#include "core/text.h"
#include "core/units.h"
#include "data/above.h"
#include "data/name_words.h"
#include "guess/column_names.h"
#include "guess/columns.h"
#include "io/number.h"

namespace frictab::guess {

namespace {

// A radius or diameter of a body in contact among the conditions.
void take_radius(File& guess, const Column& column, const data::ValueAbove& value) {
  const auto to_mm = convert(column.unit, "mm");
  const std::string name = data::words_of_name(column.name);
  const auto has = [&](const char* part) { return name.find(part) != name.npos; };
  const bool diameter =
      has("diameter") || has("durchmesser") || data::has_word(name, {"dia", "diam", "ø", "Ø"});
  if (!value.is_number || !to_mm || (!diameter && !has("radius"))) return;
  const double radius = (*to_mm)(value.number) / (diameter ? 2 : 1);
  double& known = has("inner") || has("innen") ? guess.inner_radius_mm : guess.radius_mm;
  if (known == 0) known = radius;
}

// The last number that stands alone in a line; 0 if there is none. The 2 of mm2 does not.
double last_number(std::string line, char decimal) {
  for (const std::string_view unit : {"mm2", "mm^2", "cm2", "cm^2"})
    line = replace_all(line, unit, "");
  while (!line.empty() && !std::isdigit(static_cast<unsigned char>(line.back())))
    line.pop_back();
  std::string number = line.substr(line.find_last_not_of("0123456789.,") + 1);
  number.erase(0, number.find_first_not_of(".,")); // the comma of "area,40"
  double value = 0;
  for (const char sign : {decimal, decimal == '.' ? ',' : '.'})
    if (io::read_number(number, sign, value)) return value;
  return 0;
}

// True for "cm2" and "cm²" in any encoding, but not for "g/cm2".
bool is_in_cm2(const std::string& line) {
  const std::size_t at = line.find("cm");
  if (at == line.npos || at == 0 || line[at - 1] == '/' || at + 2 >= line.size()) return false;
  const char next = line[at + 2];
  return next == '2' || next == '^' || (next & 0x80) != 0;
}

} // namespace

void doubt_load(File& guess, const io::CsvTable& table) {
  Column* const load = find_column(guess.columns, "F_N_N");
  if (!load ||
      !data::has_word(data::words_of_name(io::read_header_name(load->name).name),
                      {"load", "last"}) ||
      guess.find("F_R_N") || guess.find("tau_R_MPa"))
    return;
  const auto is_of_sled = [](const io::CsvAbove& line) {
    const std::string name = data::words_of_name(line.name),
                      value = data::words_of_name(line.value);
    return data::has_word(name, {"sled", "weight", "schlitten", "gewicht"}) ||
           name.starts_with("schlitten") || data::has_word(value, {"d1894", "8295", "cof"});
  };
  if (std::any_of(table.above.begin(), table.above.end(), is_of_sled)) load->canonical.clear();
}

void add_conditions(File& guess, const io::CsvTable& table) {
  std::vector<Column> conditions;
  for (const io::CsvAbove& line : table.above) {
    const std::string bare = io::read_header_name(line.name).name;
    if (std::any_of(table.columns.begin(), table.columns.end(), [&](const io::CsvColumn& column) {
          return io::read_header_name(column.name).name == bare;
        }))
      continue; // the rows have it themselves
    const data::ValueAbove value = data::read_value_above(line.value, guess.decimal);
    Column column;
    column.name = line.name;
    column.unit = value.unit.empty() ? io::read_header_name(line.name).unit : value.unit;
    column.above = true;
    column.text = !value.is_number;
    column.counts_rows = value.is_number && value.unit.empty() && guess.row_count > 0 &&
                         value.number == static_cast<double>(guess.row_count);
    column.first_values = line.value;
    take_radius(guess, column, value);
    conditions.push_back(std::move(column));
  }
  std::vector<Column> named = conditions;
  name_columns(named);
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const std::string& canonical = named[i].canonical;
    const bool is_held = canonical == "F_N_N" || canonical == "sigma_n_MPa" ||
                         canonical == "v_rel_mm_s" || canonical == "T_tool_C" ||
                         canonical == "T_contact_C" || canonical == "sigma_f_MPa";
    if (is_held && !named[i].text && !guess.find(canonical)) conditions[i].canonical = canonical;
    guess.columns.push_back(std::move(conditions[i]));
  }
}

double area_in(std::string_view preamble, char decimal) {
  for (std::size_t begin = 0; begin < preamble.size();) {
    const std::size_t end = std::min(preamble.find('\n', begin), preamble.size());
    const std::string line = lower_case(preamble.substr(begin, end - begin));
    const auto has = [&](const char* text) { return line.find(text) != line.npos; };
    const double unit = has("mm") ? 1 : is_in_cm2(line) ? 100 : 0;
    if ((has("area") || (has("fl") && has("che"))) && unit > 0)
      return unit * last_number(line, decimal);
    begin = end + 1;
  }
  return 0;
}

} // namespace frictab::guess
