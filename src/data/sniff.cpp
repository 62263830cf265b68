// Guesses the dialect by trial: the one whose header is text and whose cells are mostly numbers.
#include "data/sniff.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"
#include "data/above.h"
#include "data/checks.h"
#include "data/column_names.h"
#include "data/computed.h"
#include "data/quantity.h"
#include "data/raw.h"
#include "data/rig_files.h"
#include "data/test_table.h"
#include "data/time_stamps.h"
#include "data/workbooks.h"
#include "io/hdf5.h"
#include "io/number.h"
#include "io/text_file.h"
#include "io/workbook.h"

namespace frictab::data {

namespace {

// ---- dialects ----

bool is_number_column(const io::CsvColumn& column) {
  std::size_t empty = 0;
  for (const io::CsvColumn::Text& cell : column.texts)
    empty += cell.text.empty();
  const std::size_t texts = column.texts.size() - empty, all = column.numbers.size();
  return all > empty && 10 * texts <= all - empty;
}

// Whether texts differ only in their digits, as S01 to S06 do: names of tests, though siemens is a
// unit.
bool are_numbered(const std::vector<std::string>& texts) {
  constexpr std::size_t least = 3;
  std::set<std::string> letters;
  for (std::string text : texts) {
    std::erase_if(text, [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
    letters.insert(text);
  }
  return texts.size() >= least && letters.size() == 1 &&
         std::set<std::string>(texts.begin(), texts.end()).size() == texts.size();
}

// Whether rows without a line of names may be a table: numbers in several rows, in most columns. A
// sentence has neither.
bool may_lack_names(const io::CsvTable& table) {
  const auto numbers = std::count_if(table.columns.begin(), table.columns.end(), is_number_column);
  return table.rows() > 1 && 2 * static_cast<std::size_t>(numbers) >= table.columns.size();
}

// Score of a dialect: numeric cells minus a penalty for text and faults.
double worth(const io::CsvTable& table, std::size_t faults, const io::CsvFormat& format) {
  if (!format.header && !may_lack_names(table)) return -1;
  double sum = -10.0 * static_cast<double>(faults);
  std::size_t units = 0, unit_cells = 0;
  std::vector<std::string> below_no_name;
  for (const io::CsvColumn& column : table.columns) {
    double ignored = 0;
    if (column.name.empty() && !column.unit.empty()) below_no_name.push_back(column.unit);
    const bool named = column.name.empty() ? format.units_row && !column.unit.empty()
                                           : !io::read_number(column.name, '.', ignored) &&
                                                 !io::read_number(column.name, ',', ignored);
    const auto texts = static_cast<double>(column.texts.size());
    const auto rows = static_cast<double>(column.numbers.size());
    if (named && is_number_column(column)) sum += rows - 2 * texts;
    if (column.unit.empty()) continue;
    ++unit_cells;
    const std::string unit = io::without_brackets(column.unit);
    units += !io::read_number(unit, '.', ignored) && convert(unit, unit).has_value();
  }
  if (!format.units_row) return sum;
  if (2 * units < std::max<std::size_t>(unit_cells, 1) || are_numbered(below_no_name)) return -1;
  // Below units of all columns, other dialects see a row in a line of zero values.
  if (units == table.columns.size())
    sum += static_cast<double>(units * table.passed_over.below_units);
  // A units row that covers every column is preferred to a header that is equally good.
  constexpr double more_than_as_good = 0.5;
  return sum + more_than_as_good;
}

class Dialects {
  static constexpr std::size_t longest_preamble = 60;

public:
  explicit Dialects(std::string_view text, const std::string& named, bool workbook)
      : text_(text), named_(named) {
    if (text.find_first_not_of(" \t\r\n") == text.npos)
      throw InputError({named, 0, 0}, "the file is empty");
    io::CsvFormat plain, with_units, without_header;
    with_units.units_row = true;
    without_header.header = false;
    attempt_all(plain, workbook);
    attempt_all(with_units, workbook);
    if (!(most_ > 0)) attempt_all(without_header, workbook);
    attempt_two_lines();
    for (const char between : {'.', ',', '\'', ' '}) {
      io::CsvFormat format = best;
      format.thousands = between;
      if (between != best.decimal) attempt(format);
    }
    any_decimal = best.thousands == 0 && reads_as_well(best.decimal == '.' ? ',' : '.');
    if (best.decimal == '.' && best.thousands == 0 && text.find(';') != text.npos &&
        reads_as_well(',', '.'))
      grouped = first_fraction();
    if (!(most_ > 0))
      throw InputError({named, 0, 0}, "no table of numbers under a line of names was found",
                       "frictab init DIR writes a job with every key, to be filled in by hand");
  }

  io::CsvFormat best;
  io::CsvTable table;       // by the best dialect
  bool any_decimal = false; // only whole numbers, so either decimal sign works
  double grouped = 0;       // a number whose point may stand between groups of digits; 0: none

private:
  // Tries decimal signs and numbers of lines before the table. A sheet has points and commas.
  void attempt_all(io::CsvFormat format, bool workbook) {
    if (workbook) format.delimiter = ',';
    format.sheet = workbook;
    for (const char decimal : {'.', ','})
      for (format.skip_rows = 0; format.skip_rows < longest_preamble; ++format.skip_rows) {
        format.decimal = decimal;
        if (!workbook || decimal == '.') attempt(format);
      }
  }

  // Names of two lines, where one line leaves columns without a name or with equal ones.
  void attempt_two_lines() {
    std::set<std::string> names;
    for (const io::CsvColumn& column : table.columns)
      names.insert(column.name);
    names.erase("");
    if (names.size() == table.columns.size() || table.header_line < 2) return;
    io::CsvFormat format = best;
    format.skip_rows = table.header_line - 2;
    format.header_rows = 2;
    attempt(format);
  }

  void attempt(const io::CsvFormat& format) {
    try {
      FaultList faults;
      io::CsvTable tried = io::parse_csv(text_, named_, format, faults);
      const double value = worth(tried, faults.size(), format);
      if (value <= most_) return;
      most_ = value;
      best = format;
      table = std::move(tried);
    } catch (const InputError&) { // not this dialect
    }
  }

  double first_fraction() const {
    for (const io::CsvColumn& column : table.columns)
      for (const double value : column.numbers)
        if (value > 0 && value != std::floor(value)) return value;
    return 0;
  }

  bool reads_as_well(char decimal, char thousands = 0) const {
    io::CsvFormat format = best;
    format.decimal = decimal;
    format.thousands = thousands;
    try {
      FaultList faults;
      const io::CsvTable tried = io::parse_csv(text_, named_, format, faults);
      return worth(tried, faults.size(), format) >= most_;
    } catch (const InputError&) {
      return false;
    }
  }

  std::string_view text_;
  const std::string& named_;
  double most_ = 0;
};

std::string first_values(const io::CsvColumn& column) {
  std::vector<std::string> shown;
  std::size_t text = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(column.numbers.size(), 3); ++i) {
    const bool is_text = text < column.texts.size() && column.texts[text].row == i;
    shown.push_back(is_text ? column.texts[text++].text : fmt::format("{:.6g}", column.numbers[i]));
  }
  return join(shown, ", ");
}

bool is_clock_column(const io::CsvColumn& column) {
  constexpr std::size_t enough = 5;
  for (std::size_t i = 0; i < std::min(column.texts.size(), enough); ++i)
    if (!looks_like_time(column.texts[i].text)) return false;
  return column.texts.size() == column.numbers.size();
}

std::vector<std::string> cells_of(const io::CsvColumn& column) {
  std::vector<std::string> cells;
  for (const double value : column.numbers)
    cells.push_back(shortest(value));
  for (const io::CsvColumn::Text& cell : column.texts)
    cells[cell.row] = cell.text;
  return cells;
}

std::set<std::string> set_of(const std::vector<std::string>& cells) {
  return {cells.begin(), cells.end()};
}

// The cells of a column as texts, if they all differ.
std::vector<std::string> names_in(const io::CsvColumn& column) {
  std::vector<std::string> names = cells_of(column);
  if (set_of(names).size() < names.size()) names.clear();
  return names;
}

const io::CsvColumn& raw_of(const GuessedColumn& column, const io::CsvTable& table) {
  if (column.number > 0) return table.columns[column.number - 1];
  return *std::find_if(table.columns.begin(), table.columns.end(),
                       [&](const io::CsvColumn& raw) { return raw.name == column.name; });
}

GuessedColumn* find_column(std::vector<GuessedColumn>& columns, const std::string& canonical) {
  for (GuessedColumn& column : columns)
    if (column.canonical == canonical) return &column;
  return nullptr;
}

// The duration of each stop or stroke often falls from row to row, as clocks do not.
void reject_durations(std::vector<GuessedColumn>& columns, const io::CsvTable& table) {
  GuessedColumn* const clock = find_column(columns, "time_s");
  if (!clock || clock->text || clock->name == clock->canonical) return;
  constexpr std::size_t share = 3; // a clock falls only from test to test
  const std::vector<double>& values = raw_of(*clock, table).numbers;
  std::size_t falls = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    falls += values[i] < values[i - 1];
  if (share * falls > values.size()) clock->canonical.clear();
}

// The clock, where no name says so: a first column that only ascends, without a name but in units
// of time, or called X as in the reports of Abaqus.
void name_clock(std::vector<GuessedColumn>& columns, const io::CsvTable& table) {
  if (columns.empty() || find_column(columns, "time_s")) return;
  GuessedColumn& first = columns.front();
  const bool in_time = first.name.empty() && convert(first.unit, "s");
  if (!first.canonical.empty() || first.text || (!in_time && lower_case(first.name) != "x")) return;
  const std::vector<double>& values = raw_of(first, table).numbers;
  if (std::is_sorted(values.begin(), values.end())) first.canonical = "time_s";
}

// Whether the numbers are as small as coefficients of friction, and not all the same.
bool as_small_as_coefficients(const io::CsvColumn& raw) {
  constexpr double least = 0.01, most = 1;
  const auto [low, high] = std::minmax_element(raw.numbers.begin(), raw.numbers.end());
  return raw.texts.empty() && !raw.numbers.empty() && *low < *high && *low >= least &&
         *high <= most;
}

// Takes a friction column for a coefficient where it has no unit, no normal force goes with it, and
// it is as small as coefficients are.
void name_coefficient(std::vector<GuessedColumn>& columns, const io::CsvTable& table) {
  constexpr double largest = 1.5;
  GuessedColumn* const friction = find_column(columns, "F_R_N");
  if (!friction || !friction->unit.empty() || friction->name == friction->canonical ||
      find_column(columns, "F_N_N") || find_column(columns, "tau_R_MPa"))
    return;
  const std::vector<double>& values = raw_of(*friction, table).numbers;
  if (std::any_of(values.begin(), values.end(),
                  [](double value) { return std::abs(value) > largest; }))
    return;
  friction->canonical = "tau_R_MPa";
  friction->coefficient = true;
}

// Whether a column of numbers is named as tests are.
bool is_named_as_id(const GuessedColumn& column) {
  return has_word(words_of_name(column.name),
                  {"id", "no", "nr", "number", "nummer", "run", "test", "versuch", "specimen",
                   "sample", "probe", "experiment", "trial", "exp", "pack", "lauf", "messung"});
}

bool are_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return value == std::floor(value); });
}

// Rejects a column that numbers the rows as the name of a test.
void check_experiment(std::vector<GuessedColumn>& columns, const io::CsvTable& table) {
  GuessedColumn* const tests = find_column(columns, "experiment");
  if (!tests || !find_column(columns, "time_s")) return;
  const io::CsvColumn& raw = raw_of(*tests, table);
  if (raw.texts.empty() &&
      std::set<double>(raw.numbers.begin(), raw.numbers.end()).size() == raw.numbers.size())
    tests->canonical.clear();
}

// The rows at which the values fall, as those of a clock do where the next test begins.
std::vector<std::size_t> falls_of(const std::vector<double>& values) {
  std::vector<std::size_t> falls;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] < values[i - 1]) falls.push_back(i);
  return falls;
}

// The column of tests by its cells, where no name gives it: the first one that changes where the
// clock or the path begins again and nowhere else, and never comes back to a value.
void find_tests_by_blocks(std::vector<GuessedColumn>& columns, const io::CsvTable& table) {
  if (find_column(columns, "experiment")) return;
  const GuessedColumn* const time = find_column(columns, "time_s");
  const GuessedColumn* const counter = time ? time : find_column(columns, "s_mm");
  if (!counter || counter->text) return;
  const std::vector<std::size_t> begins = falls_of(raw_of(*counter, table).numbers);
  for (GuessedColumn& column : columns) {
    if (begins.empty() || !column.canonical.empty() || column.clock) continue;
    const io::CsvColumn& raw = raw_of(column, table);
    if (!column.text && !(is_named_as_id(column) && are_whole(raw.numbers))) continue;
    const std::vector<std::string> cells = cells_of(raw);
    std::vector<std::size_t> changes;
    for (std::size_t i = 1; i < cells.size(); ++i)
      if (cells[i] != cells[i - 1]) changes.push_back(i);
    if (changes != begins || set_of(cells).size() != begins.size() + 1) continue;
    column.canonical = "experiment";
    return;
  }
}

std::vector<GuessedColumn> columns_of(const io::CsvTable& table) {
  std::vector<GuessedColumn> columns;
  std::map<std::string, std::size_t> alike;
  for (const io::CsvColumn& raw : table.columns)
    ++alike[raw.name];
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const io::CsvColumn& raw = table.columns[i];
    GuessedColumn column;
    column.as_small = as_small_as_coefficients(raw);
    if (raw.name.empty() && raw.unit.empty() && !column.as_small) continue;
    column.name = raw.name;
    if (alike[raw.name] > 1 || raw.name.empty()) column.number = i + 1;
    column.unit =
        raw.unit.empty() ? io::read_header_name(raw.name).unit : io::without_brackets(raw.unit);
    column.text = !is_number_column(raw);
    column.clock = column.text && is_clock_column(raw);
    column.first_values = first_values(raw);
    if (column.text || (is_named_as_id(column) && are_whole(raw.numbers)))
      column.names = names_in(raw);
    columns.push_back(std::move(column));
  }
  name_columns(columns);
  reject_durations(columns, table);
  name_clock(columns, table);
  check_experiment(columns, table);
  find_tests_by_blocks(columns, table);
  if (GuessedColumn* const tests = find_column(columns, "experiment")) {
    tests->names = names_in(raw_of(*tests, table));
    const std::set<std::string> cells = set_of(cells_of(raw_of(*tests, table)));
    if (tests->names.empty()) tests->tests.assign(cells.begin(), cells.end());
  }
  name_coefficient(columns, table);
  return columns;
}

// True if the names identify the header line: then skip_rows, which differs from file to file, is
// not needed.
bool is_found_by_names(std::string_view text, const GuessedFile& guess, const io::CsvTable& table,
                       io::CsvFormat format) {
  format.skip_rows = 0;
  for (const Quantity& quantity : quantities())
    format.wanted.emplace_back(quantity.name);
  for (const GuessedColumn& column : guess.columns)
    if (!column.canonical.empty() && column.number == 0)
      format.wanted.push_back(io::read_header_name(column.name).name);
  try {
    FaultList faults;
    return io::parse_csv(text, guess.file, format, faults).header_line == table.header_line;
  } catch (const InputError&) {
    return false;
  }
}

// Replaces each text by the number of its first row.
std::vector<double> levels_of(const io::CsvColumn& raw) {
  std::vector<double> levels = raw.numbers;
  std::map<std::string, double> known;
  for (const io::CsvColumn::Text& cell : raw.texts)
    levels[cell.row] = known.emplace(cell.text, static_cast<double>(cell.row)).first->second;
  return levels;
}

bool each_row_is_a_test(const GuessedFile& guess, const io::CsvTable& table) {
  if (guess.find("experiment") || guess.find("time_s")) return false;
  for (const GuessedColumn& column : guess.columns)
    if (counts_rows_of_a_test(column.name)) return false;
  std::vector<std::vector<double>> settings;
  for (const GuessedColumn& column : guess.columns)
    for (const io::CsvColumn& raw : table.columns)
      if (raw.name == column.name && !raw.name.empty() && !column.coefficient &&
          column.canonical != "tau_R_MPa" && column.canonical != "F_R_N")
        settings.push_back(levels_of(raw));
  return rows_look_like_tests(settings, table.rows());
}

} // namespace

const GuessedColumn* GuessedFile::find(const std::string& canonical) const {
  for (const GuessedColumn& column : columns)
    if (column.canonical == canonical) return &column;
  return nullptr;
}

bool GuessedFile::is_read_as(const GuessedFile& other) const {
  const auto named = [](const GuessedFile& guess) {
    std::set<std::string> names;
    for (const GuessedColumn& column : guess.columns)
      if (!column.canonical.empty())
        names.insert(column.canonical + "=" + column.name + "/" + column.unit);
    return names;
  };
  return (any_decimal || own_decimal || decimal == other.decimal) &&
         (thousands == 0 || thousands == other.thousands) && units_row == other.units_row &&
         skip_footer == other.skip_footer && header == other.header &&
         header_rows == other.header_rows && intervals == other.intervals && rows == other.rows &&
         side_by_side == other.side_by_side && skip_rows == other.skip_rows &&
         named(*this) == named(other);
}

std::string GuessedFile::label() const {
  return sheet.empty() ? std::filesystem::path(file).stem().string() : sheet;
}

namespace {

// The normal stress of Abaqus' history output, in its files' own units.
std::string pressure_of_abaqus(const GuessedFile& guess) {
  const GuessedColumn* const force = guess.find("F_N_N");
  if (guess.find("sigma_n_MPa") || !force || force->number > 0) return "";
  for (const GuessedColumn& column : guess.columns)
    if (words_of_name(column.name).starts_with("carea"))
      return fmt::format("F_N_N/{}", name_in_formulas(column.name));
  return "";
}

// Whether all columns come again, under equal names, for another test.
bool are_side_by_side(const io::CsvTable& table) {
  std::vector<std::string> names;
  for (const io::CsvColumn& column : table.columns)
    if (!column.name.empty()) names.push_back(column.name);
  if (names.empty()) return false;
  const auto again = std::find(names.begin() + 1, names.end(), names.front());
  const auto period = static_cast<std::size_t>(again - names.begin());
  if (again == names.end() || period < 2 || names.size() % period != 0) return false;
  for (std::size_t i = period; i < names.size(); ++i)
    if (names[i] != names[i - period]) return false;
  return true;
}

// Leaves the columns of the first test, which stand for those of all.
void take_first_test(GuessedFile& guess) {
  std::vector<GuessedColumn> first;
  for (GuessedColumn& column : guess.columns) {
    if (!first.empty() && column.name == first.front().name) break;
    column.number = 0;
    first.push_back(std::move(column));
  }
  guess.columns = std::move(first);
  guess.side_by_side = true;
}

// A radius or diameter of a body in contact among the conditions.
void take_radius(GuessedFile& guess, const GuessedColumn& column, const ValueAbove& value) {
  const auto to_mm = convert(column.unit, "mm");
  const std::string name = words_of_name(column.name);
  const auto has = [&](const char* part) { return name.find(part) != name.npos; };
  const bool diameter =
      has("diameter") || has("durchmesser") || has_word(name, {"dia", "diam", "ø", "Ø"});
  if (!value.is_number || !to_mm || (!diameter && !has("radius"))) return;
  const double radius = (*to_mm)(value.number) / (diameter ? 2 : 1);
  double& known = has("inner") || has("innen") ? guess.inner_radius_mm : guess.radius_mm;
  if (known == 0) known = radius;
}

// A pulling force, where the lines above the rows give the weight on a sled: the only force of such
// a rig, called Load, is friction.
void doubt_load(GuessedFile& guess, const io::CsvTable& table) {
  GuessedColumn* const load = find_column(guess.columns, "F_N_N");
  if (!load || !has_word(words_of_name(io::read_header_name(load->name).name), {"load", "last"}) ||
      guess.find("F_R_N") || guess.find("tau_R_MPa"))
    return;
  const auto is_of_sled = [](const io::CsvAbove& line) {
    const std::string name = words_of_name(line.name), value = words_of_name(line.value);
    return has_word(name, {"sled", "weight", "schlitten", "gewicht"}) ||
           name.starts_with("schlitten") || has_word(value, {"d1894", "8295", "cof"});
  };
  if (std::any_of(table.above.begin(), table.above.end(), is_of_sled)) load->canonical.clear();
}

// Quantities that rigs hold, and write above the rows.
void add_conditions(GuessedFile& guess, const io::CsvTable& table) {
  std::vector<GuessedColumn> conditions;
  for (const io::CsvAbove& line : table.above) {
    const std::string bare = io::read_header_name(line.name).name;
    if (std::any_of(table.columns.begin(), table.columns.end(), [&](const io::CsvColumn& column) {
          return io::read_header_name(column.name).name == bare;
        }))
      continue; // the rows have it themselves
    const ValueAbove value = read_value_above(line.value, guess.decimal);
    GuessedColumn column;
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
  std::vector<GuessedColumn> named = conditions;
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

std::string as_pattern(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += std::string_view(".^$*+?()[{|\\").find(c) == std::string_view::npos
               ? std::string(1, c)
               : std::string("\\") + c;
  return out;
}

// Finds columns called "mu T1 10MPa", "mu T2 20MPa": a word for friction, and a test's own name.
void find_tests_in_columns(GuessedFile& guess) {
  std::map<std::string, std::vector<std::string>> columns; // by their first word
  for (const GuessedColumn& column : guess.columns) {
    const std::size_t end = column.name.find_first_of(" _");
    if (column.text || column.above || end == column.name.npos || end == 0) continue;
    const std::string word = words_of_name(column.name.substr(0, end));
    const bool is_friction = has_word(
        word, {"µ", "μ", "mu", "cof", "friction", "reibung", "reibzahl", "fr", "ff", "tau"});
    if (is_friction && column.name.find_first_of("0123456789", end) != column.name.npos)
      columns[column.name.substr(0, end + 1)].push_back(column.name);
  }
  for (auto& [word, names] : columns)
    if (names.size() >= 3 && names.size() > guess.wide.size()) {
      guess.wide_pattern = "^" + as_pattern(word) + "(?<experiment>.+)";
      guess.wide = std::move(names);
    }
}

// Numbers that recorders write for no value, where all others of a column are far from them.
std::vector<std::string> markers_in(const io::CsvTable& table) {
  constexpr double known[] = {-99,    -999, -999.25, -9999,  -99999, -999999,
                              999.25, 9999, 99999,   999999, 1e30,   9.91e37};
  constexpr double far = 10;
  std::set<std::string> found;
  for (const io::CsvColumn& column : table.columns) {
    double most = 0; // of the others
    std::set<double> markers;
    for (const double value : column.numbers)
      if (std::find(std::begin(known), std::end(known), value) != std::end(known))
        markers.insert(value);
      else if (std::isfinite(value))
        most = std::max(most, std::abs(value));
    for (const double marker : markers)
      if (markers.size() == 1 && most > 0 && std::abs(marker) > far * most)
        found.insert(shortest(marker));
  }
  return {found.begin(), found.end()};
}

// A number for what each row has of the quantities; nothing of less than two of them.
std::set<std::size_t> rows_of(const GuessedFile& guess, const io::CsvTable& table) {
  std::vector<std::string> rows(table.rows());
  std::size_t quantities = 0;
  for (const GuessedColumn& column : guess.columns) {
    if (!find_quantity(column.canonical) || column.text) continue;
    ++quantities;
    const std::vector<double>& values = raw_of(column, table).numbers;
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] += fmt::format("{} {};", column.canonical, shortest(values[i]));
  }
  std::set<std::size_t> seen;
  for (const std::string& row : rows)
    if (quantities > 1) seen.insert(std::hash<std::string>()(row));
  return seen;
}

void finish(GuessedFile& guess, const io::CsvTable& table) {
  guess.missing = markers_in(table);
  find_tests_in_columns(guess);
  if (are_side_by_side(table)) take_first_test(guess);
  doubt_load(guess, table);
  guess.pressure = pressure_of_abaqus(guess);
  guess.rows_seen = rows_of(guess, table);
  guess.rows = !guess.side_by_side && !guess.intervals && each_row_is_a_test(guess, table);
  add_conditions(guess, table);
}

// The lines before the `line`th, from 1.
std::string_view lines_before(std::string_view text, std::size_t line) {
  std::size_t end = 0;
  while (line-- > 1 && end != text.npos)
    end = text.find('\n', end == 0 ? 0 : end + 1);
  return text.substr(0, end);
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

// The area of contact in mm2 that a line of a preamble gives ("Area [mm2]: 78.5", "Kontaktfläche;4;
// cm2" in any encoding); 0: none does.
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

// Number of lines below the last row: means, remarks. They hold fewer than half as many numbers as
// a row, a text where rows begin with a number, or a word for sums.
std::size_t footer_of(std::string_view text, const io::CsvTable& table,
                      const io::CsvFormat& format) {
  constexpr std::size_t most = 10;
  const auto numeric = std::count_if(table.columns.begin(), table.columns.end(), is_number_column);
  const bool begins_with_number = is_number_column(table.columns.front());
  std::size_t lines = 0;
  bool has_text = false;
  std::size_t end = text.find_last_not_of(" \t\r\n") + 1;
  while (end > 0 && lines <= most) {
    const std::size_t begin = text.find_last_of('\n', end - 1) + 1; // 0: the first line
    const std::string_view line = text.substr(begin, end - begin);
    double ignored = 0;
    const auto cells = io::cells_of_line(line, format);
    const auto numbers = std::count_if(cells.begin(), cells.end(), [&](const std::string& cell) {
      return io::read_number(cell, format.decimal, ignored);
    });
    const std::string first = cells.empty() ? "" : cells.front();
    const std::string word = lower_case(first);
    const bool is_text = !first.empty() && word != "nan" && word != "na" && word != "n/a" &&
                         !io::read_number(first, format.decimal, ignored);
    const bool sums_up = is_text && (begins_with_number || names_sums(first));
    if (numbers > 0 && 2 * numbers >= numeric && !sums_up)
      return has_text && 2 * lines < table.rows() ? lines : 0;
    has_text = has_text || line.find_first_not_of(" \t\r,;|") != line.npos;
    ++lines;
    end = begin == 0 ? 0 : begin - 1;
  }
  return 0;
}

// Parts below repeated headers. A rig that heats, loads and slides writes three, of which the
// longest has many times the rows of the shortest.
void take_intervals(GuessedFile& guess, const io::CsvTable& table) {
  guess.intervals = !table.interval.empty() && table.interval.back() > 0;
  if (!guess.intervals) return;
  constexpr std::size_t most = 5, times = 5;
  std::vector<std::size_t> rows(table.interval.back() + 1);
  for (const std::size_t interval : table.interval)
    ++rows[interval];
  const auto [least, longest] = std::minmax_element(rows.begin(), rows.end());
  guess.phases = rows.size() <= most && *longest > times * *least;
}

// Pattern of lines without a delimiter that stand in front of the first row and between others;
// empty: there are none.
std::string titles_in(std::string_view text, const io::CsvTable& table) {
  const char delimiter = table.form.ends_with("tabs") ? '\t' : table.form.back();
  if (table.line.empty() || table.form.ends_with("blanks")) return "";
  std::size_t line = 0, titles = 0, first = 0;
  for (std::size_t begin = 0; begin < text.size() && ++line < table.line.back();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view one = text.substr(begin, end - begin);
    const bool is_title =
        line > std::max(table.header_line, table.units_line) && one.find(delimiter) == one.npos &&
        std::any_of(one.begin(), one.end(),
                    [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; });
    titles += is_title;
    if (is_title && first == 0) first = line;
    begin = end + 1;
  }
  if (titles < 2 || first > table.line.front()) return "";
  const std::string other = delimiter == '\t' ? "[^\\t]" : fmt::format("[^{}]", delimiter);
  return fmt::format("^(?<title>{0}*[A-Za-z]{0}*)$", other);
}

// Guesses from a text; `cells`: the sheet of a workbook that it is from, or nullptr.
GuessedFile guess_text(std::string_view whole, const std::string& named, const io::Sheet* cells) {
  const std::string_view text = head_of(whole);
  GuessedFile guess;
  guess.file = named;
  Dialects dialects(text, named, cells != nullptr);
  io::CsvTable table = std::move(dialects.table);
  FaultList mixed;                    // reported when the file is read
  if (whole.find('\0') == whole.npos) // as UTF-16 has
    guess.skip_footer = footer_of(whole, table, dialects.best);
  if (guess.skip_footer > 0 && whole.size() == text.size()) {
    io::CsvFormat format = dialects.best;
    format.skip_footer = guess.skip_footer;
    table = io::parse_csv(text, named, format, mixed);
  }
  if (cells) take_cell_units(table, *cells, mixed);
  const std::string_view rest = whole.substr(text.size());
  guess.row_count =
      table.rows() + static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n'));
  guess.decimal = dialects.best.decimal;
  guess.thousands = dialects.best.thousands;
  guess.grouped = dialects.grouped;
  guess.any_decimal = dialects.any_decimal;
  guess.own_decimal = cells != nullptr;
  guess.units_row = dialects.best.units_row;
  guess.header = dialects.best.header;
  guess.header_rows = dialects.best.header_rows;
  take_intervals(guess, table);
  guess.columns = columns_of(table);
  if (!is_found_by_names(text, guess, table, dialects.best))
    guess.skip_rows = dialects.best.skip_rows;
  guess.area_mm2 = area_in(lines_before(text, table.header_line), guess.decimal);
  if (!guess.intervals) guess.titles = titles_in(text, table);
  finish(guess, table);
  return guess;
}

std::vector<GuessedFile> guess_workbook(const std::string& path, const std::string& named) {
  const io::Workbook book(path, named);
  std::vector<GuessedFile> guesses;
  std::vector<std::string> passed;
  std::size_t visible = 0;
  for (const io::Workbook::Entry& one : book.sheets()) {
    if (one.hidden) continue;
    ++visible;
    const io::Sheet cells = book.read(one.name);
    try {
      guesses.push_back(guess_text(cells.text, named, &cells));
      guesses.back().sheet = one.name;
    } catch (const InputError&) { // a cover, a picture, remarks
      passed.push_back(one.name);
    }
  }
  if (guesses.empty())
    throw InputError({named, 0, 0},
                     fmt::format("none of its sheets is a table of numbers under a line of names: "
                                 "{}",
                                 join(passed, ", ")),
                     "frictab init DIR writes a job with every key, to be filled in by hand");
  if (visible == 1) guesses.front().sheet.clear();
  guesses.front().passed = std::move(passed);
  return guesses;
}

} // namespace

std::vector<GuessedFile> guess_file(const std::string& path, const std::string& named) {
  if (io::looks_like_workbook(path)) return guess_workbook(path, named);
  if (!is_rig_file(path) && !io::looks_like_hdf5(path)) {
    const std::string text = io::read_text_file(path, named);
    return {guess_text(text, named, nullptr)};
  }
  FaultList faults;
  const io::CsvTable table = read_raw(path, named, {}, faults);
  GuessedFile guess;
  guess.file = named;
  guess.own_decimal = true;
  take_intervals(guess, table);
  guess.columns = columns_of(table);
  finish(guess, table);
  return {guess};
}

namespace {

// The tests that a file has: those that a column names, else itself.
std::vector<std::string> tests_of(const GuessedFile& file) {
  const GuessedColumn* const column = file.find("experiment");
  return column && !column->tests.empty() ? column->tests : std::vector{file.label()};
}

// Whether at least half of the tests of the other guesses are among the names.
bool names_tests(const std::vector<std::string>& names, std::size_t own,
                 const std::vector<GuessedFile>& files) {
  const std::set<std::string> known(names.begin(), names.end());
  std::size_t found = 0, all = 0;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (const std::string& test : i == own ? std::vector<std::string>() : tests_of(files[i])) {
      found += known.count(test);
      ++all;
    }
  // only the first tests of one file of all tests are seen, perhaps one
  const GuessedColumn* const column =
      files.size() == 2 ? files[1 - own].find("experiment") : nullptr;
  const std::size_t least = column && !column->tests.empty() ? 1 : 2;
  return found >= least && 2 * found >= all;
}

// Whether the labels of all others are the names in another form, each once.
bool are_numbered_alike(const std::vector<std::string>& names, std::size_t own,
                        const std::vector<GuessedFile>& files) {
  std::map<long, std::string> known;
  for (const std::string& name : names)
    known.emplace(first_number(name), name);
  if (known.size() != names.size() || names.size() > 2 * (files.size() - 1)) return false;
  std::set<long> labels;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (i == own) continue;
    const std::string label = files[i].label();
    const auto found = known.find(first_number(label));
    if (found == known.end() || !is_same_test(label, found->second)) return false;
    labels.insert(found->first);
  }
  return labels.size() + 1 == files.size();
}

} // namespace

namespace {

bool is_measured(const GuessedFile& guess) {
  return guess.find("tau_R_MPa") || guess.find("F_R_N");
}

// The column whose cells are the names of the tests in the other files; nothing: there is none.
std::optional<std::size_t> names_of_tests_in(const std::vector<GuessedFile>& files,
                                             std::size_t own) {
  for (std::size_t c = 0; c < files[own].columns.size(); ++c) {
    const GuessedColumn& column = files[own].columns[c];
    // A column of numbers in a recording may count its rows.
    if (!column.text && column.canonical != "experiment" &&
        (files[own].find("time_s") || is_measured(files[own])))
      continue;
    if (!column.names.empty() &&
        (names_tests(column.names, own, files) ||
         (files.size() > 2 && are_numbered_alike(column.names, own, files))))
      return c;
  }
  return std::nullopt;
}

GuessedFile as_table_of_tests(GuessedFile table, std::size_t names) {
  for (GuessedColumn& other : table.columns)
    if (other.canonical == "experiment") other.canonical.clear();
  table.columns[names].canonical = "experiment";
  return table;
}

// The table of tests among the files, or else among those that are left.
std::optional<GuessedFile> take_table_of_tests(std::vector<GuessedFile>& files,
                                               std::vector<GuessedFile>& left) {
  for (std::size_t i = 0; i < files.size(); ++i)
    if (const auto names = names_of_tests_in(files, i)) {
      GuessedFile table = as_table_of_tests(std::move(files[i]), *names);
      files.erase(files.begin() + static_cast<std::ptrdiff_t>(i));
      return table;
    }
  for (std::size_t i = 0; i < left.size(); ++i) {
    const bool in_parts = !files.empty() && files.front().intervals;
    files.push_back(left[i]);
    const auto names = names_of_tests_in(files, files.size() - 1);
    files.pop_back();
    if (!names || (in_parts && !left[i].columns[*names].text)) continue;
    GuessedFile table = as_table_of_tests(std::move(left[i]), *names);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    return table;
  }
  return std::nullopt;
}

// Takes the table whose names of tests are columns of another file: a column per test.
std::optional<GuessedFile> find_names_of_columns(std::vector<GuessedFile>& files,
                                                 std::vector<GuessedFile>& left) {
  constexpr std::size_t least = 3;
  for (std::vector<GuessedFile>* const from : {&left, &files})
    for (std::size_t i = 0; i < from->size(); ++i)
      for (std::size_t c = 0; c < (*from)[i].columns.size(); ++c) {
        const std::set<std::string> known = set_of((*from)[i].columns[c].names);
        for (GuessedFile& file : files) {
          std::vector<std::string> wide, digits;
          for (const GuessedColumn& column : file.columns)
            if (!column.text && !column.above && column.canonical.empty() &&
                known.count(column.name) > 0)
              wide.push_back(column.name);
          if (wide.size() < least || 2 * wide.size() < known.size()) continue;
          const std::string letters = wide[0].substr(0, wide[0].find_first_of("0123456789"));
          const bool numbered = std::all_of(wide.begin(), wide.end(), [&](const auto& name) {
            return name.starts_with(letters) && name.size() > letters.size() &&
                   name.find_first_not_of("0123456789", letters.size()) == name.npos;
          });
          for (const std::string& name : wide)
            digits.push_back(as_pattern(name));
          file.wide_pattern = fmt::format(
              "^(?<experiment>{})$", numbered ? as_pattern(letters) + "\\d+" : join(digits, "|"));
          file.wide = std::move(wide);
          file.wide_known = true;
          file.rows = false;
          GuessedFile table = as_table_of_tests(std::move((*from)[i]), c);
          from->erase(from->begin() + static_cast<std::ptrdiff_t>(i));
          return table;
        }
      }
  return std::nullopt;
}

// Whether a sheet is a summary: others of its workbook, read alike, have ten times its rows.
bool sums_up_others(const GuessedFile& sheet, const std::vector<GuessedFile>& all) {
  const auto is_longer = [&](const GuessedFile& other) {
    return other.file == sheet.file && other.row_count >= 10 * sheet.row_count;
  };
  return sheet.row_count > 0 && std::any_of(all.begin(), all.end(), [&](const GuessedFile& one) {
           return is_longer(one) &&
                  std::count_if(all.begin(), all.end(), [&](const GuessedFile& other) {
                    return is_longer(other) && other.is_read_as(one);
                  }) > 1;
         });
}

// Whether a sheet is read like most sheets of its workbook, among those with friction if there are
// any.
bool is_like_most(const GuessedFile& sheet, const std::vector<GuessedFile>& all) {
  if (sums_up_others(sheet, all)) return false;
  const auto rivals = [&](const GuessedFile& as) {
    return std::count_if(all.begin(), all.end(), [&](const GuessedFile& other) {
      return other.file == as.file && is_measured(other) == is_measured(as) && other.is_read_as(as);
    });
  };
  return std::none_of(all.begin(), all.end(), [&](const GuessedFile& other) {
    if (other.file != sheet.file || is_measured(other) < is_measured(sheet) ||
        sums_up_others(other, all))
      return false;
    return is_measured(other) > is_measured(sheet) || rivals(other) > rivals(sheet);
  });
}

// The choice of sheets for one workbook, given the names of its tables.
std::vector<std::string> choice_of(const std::vector<std::string>& read, std::size_t tables) {
  if (read.size() > 1 && read.size() == tables) return {"*"};
  return read;
}

} // namespace

std::size_t most_common(const std::vector<GuessedFile>& files) {
  const auto rank = [&](const GuessedFile& file) {
    return std::pair(
        std::count_if(files.begin(), files.end(),
                      [&](const GuessedFile& other) { return other.is_read_as(file); }),
        (file.find("time_s") ? 1 : 0) + (is_measured(file) ? 1 : 0));
  };
  const auto most =
      std::max_element(files.begin(), files.end(), [&](const GuessedFile& a, const GuessedFile& b) {
        return rank(a) < rank(b);
      });
  return static_cast<std::size_t>(most - files.begin());
}

namespace {

// The part of a recording that most files have and this one has not; empty: it has all.
std::string lacks(const GuessedFile& file, const GuessedFile& most) {
  if (most.find("time_s") && !file.find("time_s")) return "column for time_s";
  if (is_measured(most) && !is_measured(file)) return "friction";
  const auto has_meaning = [](const GuessedColumn& column) {
    return !column.canonical.empty() && column.canonical != "experiment";
  };
  return std::any_of(most.columns.begin(), most.columns.end(), has_meaning) &&
                 std::none_of(file.columns.begin(), file.columns.end(), has_meaning)
             ? "quantity"
             : "";
}

// Takes the files that lack a part of a recording.
std::vector<GuessedFile> take_others(std::vector<GuessedFile>& files) {
  const GuessedFile most = files[most_common(files)];
  std::vector<GuessedFile> kept, others;
  for (GuessedFile& file : files)
    (file.sheet.empty() && !lacks(file, most).empty() ? others : kept).push_back(std::move(file));
  files = std::move(kept);
  return others;
}

// The name of a file without the words for its versions: "T2" of "T2_old" and "T2_v3".
std::string without_version(const std::string& label) {
  std::string out;
  for (std::size_t begin = 0; begin <= label.size();) {
    const std::size_t end = std::min(label.find_first_of("_-. ()", begin), label.size());
    const std::string word = lower_case(label.substr(begin, end - begin));
    const bool is_number =
        !word.empty() && word.find_first_not_of("0123456789", word[0] == 'v') == word.npos;
    const bool is_version =
        (is_number && (word[0] == 'v' || (begin > 0 && label[begin - 1] == '('))) ||
        has_word(word, {"alt", "old", "copy", "kopie", "neu", "new", "final", "backup", "bak",
                        "orig", "original", "raw", "korr", "corr", "corrected", "fixed"});
    if (!is_version && !word.empty()) out += " " + word;
    begin = end + 1;
  }
  return out.empty() ? label : out;
}

// Whether two files of a folder are versions of one: the same tests, and nearly the same rows.
bool are_versions(const GuessedFile& a, const GuessedFile& b) {
  constexpr double share = 0.8;
  constexpr std::size_t least = 5;
  const auto shared = [](const auto& one, const auto& other) {
    return static_cast<double>(
        std::count_if(one.begin(), one.end(), [&](const auto& x) { return other.count(x) > 0; }));
  };
  const auto tests = [](const GuessedFile& file) {
    const GuessedColumn* const column = file.find("experiment");
    return column && !column->tests.empty() ? set_of(column->tests)
                                            : std::set{without_version(file.label())};
  };
  const auto same = [&](const auto& one, const auto& other, double part) {
    return shared(one, other) >= part * static_cast<double>(std::min(one.size(), other.size()));
  };
  const auto folder = [](const GuessedFile& file) {
    return std::filesystem::path(file.file).parent_path();
  };
  return folder(a) == folder(b) && std::min(a.rows_seen.size(), b.rows_seen.size()) >= least &&
         same(tests(a), tests(b), share) && same(a.rows_seen, b.rows_seen, share);
}

// Leaves the shorter one of two versions of a file, or the earlier name.
void leave_versions(std::vector<GuessedFile>& files, std::vector<LeftFile>& left) {
  for (std::size_t i = 0; i < files.size();) {
    const auto newer = std::find_if(files.begin(), files.end(), [&](const GuessedFile& other) {
      return &other != &files[i] && files[i].sheet.empty() && other.sheet.empty() &&
             std::pair(files[i].row_count, files[i].file) <
                 std::pair(other.row_count, other.file) &&
             are_versions(files[i], other);
    });
    if (newer == files.end()) {
      ++i;
      continue;
    }
    left.push_back(
        {files[i].file, "it has the tests and rows of " +
                            std::filesystem::path(newer->file).filename().string() +
                            " again; if it is the better one, name it in training instead"});
    files.erase(files.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

LeftFile left_file(const GuessedFile& file, const GuessedFile& most) {
  const std::string part = lacks(file, most);
  return {file.file, fmt::format("it has no {}, which most files have", part), true};
}

} // namespace

GuessedCampaign sort_guesses(std::vector<GuessedFile> guesses) {
  GuessedCampaign campaign;
  for (GuessedFile& guess : guesses)
    std::move(guess.passed.begin(), guess.passed.end(), std::back_inserter(campaign.passed));
  std::vector<GuessedFile> others = take_others(guesses);
  leave_versions(guesses, campaign.left);
  campaign.tests = take_table_of_tests(guesses, others);
  if (!campaign.tests) campaign.tests = find_names_of_columns(guesses, others);
  for (const GuessedFile& other : others)
    campaign.left.push_back(left_file(other, guesses[most_common(guesses)]));
  std::map<std::string, std::vector<std::string>> read; // by workbook
  std::map<std::string, std::size_t> tables;
  for (const GuessedFile& guess : guesses) {
    const bool is_read = guess.sheet.empty() || is_like_most(guess, guesses);
    if (!guess.sheet.empty()) ++tables[guess.file];
    if (!guess.sheet.empty() && is_read) read[guess.file].push_back(guess.sheet);
    if (is_read)
      campaign.files.push_back(guess);
    else
      campaign.passed.push_back(guess.sheet);
  }
  if (campaign.files.size() == 1) campaign.files.front().phases = false; // else it were one test
  for (auto& [file, names] : read)
    names = choice_of(names, tables[file]);
  if (!read.empty() && std::all_of(read.begin(), read.end(), [&](const auto& one) {
        return one.second == read.begin()->second;
      }))
    campaign.sheets = read.begin()->second;
  return campaign;
}

// ---- names of files ----

namespace {

struct Token {
  std::string number, unit; // "20mm": 20, mm; both empty for a text
};

Token token_of(const std::string& text) {
  std::size_t end = 0;
  while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) ||
                               text[end] == '.' || text[end] == ','))
    ++end;
  const bool trailing = end > 0 && !std::isdigit(static_cast<unsigned char>(text[end - 1]));
  if (end == 0 || trailing) return {};
  const std::string behind = text.substr(end);
  const bool letters = std::all_of(behind.begin(), behind.end(), [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
  });
  return letters ? Token{text.substr(0, end), behind} : Token{};
}

struct CutName {
  std::vector<std::string> tokens;
  std::string signs; // separators between them
};

CutName cut(const std::string& file) {
  CutName name;
  std::string token;
  for (const char c : std::filesystem::path(file).stem().string()) {
    if (c != '_' && c != '-' && c != ' ') {
      token += c;
      continue;
    }
    name.tokens.push_back(token);
    name.signs += c;
    token.clear();
  }
  name.tokens.push_back(token);
  return name;
}

// Sorts numbers by size, texts alphabetically; limited to one line.
std::string list_of(const std::set<std::string>& values) {
  std::vector<std::string> list(values.begin(), values.end());
  const auto number = [](const std::string& text) {
    double value = 0;
    return io::read_number(text, '.', value) || io::read_number(text, ',', value) ? value : 0;
  };
  std::stable_sort(list.begin(), list.end(), [&](const std::string& a, const std::string& b) {
    return number(a) < number(b);
  });
  constexpr std::size_t shown = 8;
  if (list.size() > shown) {
    list.resize(shown);
    list.emplace_back("...");
  }
  return join(list, ", ");
}

// The texts at one position of all names.
class NamePlace {
public:
  explicit NamePlace(const std::vector<std::string>& texts) : first_(texts.front()) {
    for (const std::string& text : texts) {
      const Token token = token_of(text);
      values_.insert(text);
      numbers_.insert(token.number);
      units_.insert(token.unit);
    }
  }

  bool differs() const { return values_.size() > 1; }
  bool has_empty() const { return values_.count("") > 0; }
  // True for the number of a condition with its unit, as 20mm.
  bool is_measured() const {
    return numbers_.count("") == 0 && units_.size() == 1 && !units_.begin()->empty();
  }
  bool names_test(std::size_t tests) const {
    return values_.size() == tests && tests > 2 && !is_measured();
  }
  // True for the numbers of repeated tests: 1, 2, 3 or rep1, rep2.
  bool counts_repeats(std::size_t tests) const {
    std::set<std::string> letters;
    std::set<long> numbers;
    for (const std::string& text : values_) {
      letters.insert(lower_case(text.substr(0, text.find_first_of("0123456789"))));
      numbers.insert(first_number(text));
    }
    const std::set<std::string> before = {"", "r", "rep", "repeat", "replicate", "w", "wdh"};
    return letters.size() == 1 && before.count(*letters.begin()) > 0 && numbers.size() > 1 &&
           2 * numbers.size() <= tests && *numbers.begin() == 1 &&
           *numbers.rbegin() == static_cast<long>(numbers.size());
  }
  std::string same() const { return as_pattern(first_); }

  // A named group of `letters`; for measured parts the unit is added to the name.
  std::string group(std::string name, const std::string& letters, GuessedNames& guess) const {
    if (is_measured()) name += "_" + *units_.begin();
    guess.parts.push_back({name, list_of(is_measured() ? numbers_ : values_)});
    return is_measured() ? fmt::format("(?<{}>[\\d.,]+){}", name, *units_.begin())
                         : fmt::format("(?<{}>{})", name, letters);
  }

private:
  const std::string& first_;
  std::set<std::string> values_, numbers_, units_;
};

bool names_test(const GuessedNames& guess) {
  return std::any_of(guess.parts.begin(), guess.parts.end(),
                     [](const NamePart& part) { return part.group == "experiment"; });
}

// Pattern for one position of the files' own names, the `number`th from 1.
std::string part_of_name(const NamePlace& place, std::size_t number, bool is_last,
                         std::size_t tests, GuessedNames& guess) {
  const char* const letters = "[^_ /-]+";
  if (!place.differs()) return place.same();
  if (place.names_test(tests))
    return names_test(guess) ? letters : place.group("experiment", letters, guess);
  if (is_last && number > 1 && place.counts_repeats(tests))
    return place.group("repeat", letters, guess);
  return place.group(fmt::format("{}{}", place.is_measured() ? "x" : "name", number), letters,
                     guess);
}

// Pattern of names with the same parts; empty for others.
std::string guess_parts(const std::vector<CutName>& names, GuessedNames& guess) {
  const CutName& first = names.front();
  if (std::any_of(names.begin(), names.end(),
                  [&](const CutName& name) { return name.signs != first.signs; }))
    return "";
  GuessedNames found;
  std::string pattern;
  for (std::size_t t = 0; t < first.tokens.size(); ++t) {
    std::vector<std::string> texts;
    for (const CutName& name : names)
      texts.push_back(name.tokens[t]);
    const NamePlace place(texts);
    if (place.has_empty() && place.differs()) return "";
    if (t > 0) pattern += as_pattern(first.signs.substr(t - 1, 1));
    pattern += part_of_name(place, t + 1, t + 1 == first.tokens.size(), names.size(), found);
  }
  // A pattern that only distinguishes the tests is not needed: the file's own name does the same.
  if (found.parts.empty() || (found.parts.size() == 1 && names_test(found))) return "";
  guess.parts.insert(guess.parts.end(), found.parts.begin(), found.parts.end());
  return pattern;
}

// Pattern of the folders from the first one that differs, each followed by a /; empty if they give
// no information: all equal, at different depths, or one per file.
std::string guess_folders(const std::vector<std::string>& files, GuessedNames& guess) {
  std::vector<std::vector<std::string>> folders;
  std::set<std::string> all;
  for (const std::string& file : files) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    all.insert(folder.string());
    folders.emplace_back();
    for (const auto& part : folder)
      folders.back().push_back(part.string());
    if (folders.back().size() != folders.front().size()) return "";
  }
  if (all.size() == files.size()) return "";
  std::string pattern;
  for (std::size_t level = 0; level < folders.front().size(); ++level) {
    std::vector<std::string> texts;
    for (const auto& folder : folders)
      texts.push_back(folder[level]);
    const NamePlace place(texts);
    const std::string number = guess.parts.empty() ? "" : std::to_string(guess.parts.size() + 1);
    if (place.differs())
      pattern += place.group("folder" + number, "[^/]+", guess) + "/";
    else if (!pattern.empty())
      pattern += place.same() + "/";
  }
  return pattern;
}

// The files' common extension, or any.
std::string end_of_names(const std::vector<std::string>& files) {
  std::set<std::string> extensions;
  for (const std::string& file : files)
    extensions.insert(std::filesystem::path(file).extension().string());
  return (extensions.size() == 1 ? as_pattern(*extensions.begin()) : "(\\.[^./]*)?") + "$";
}

} // namespace

GuessedNames guess_names(const std::vector<std::string>& files) {
  GuessedNames guess;
  if (files.size() < 2) return guess;
  std::vector<CutName> names;
  for (const std::string& file : files)
    names.push_back(cut(file));
  const std::string folders = guess_folders(files, guess);
  const std::string parts = guess_parts(names, guess);
  if (!parts.empty())
    guess.pattern = folders + parts + end_of_names(files);
  else if (!folders.empty())
    guess.pattern = folders + "[^/]*$";
  return guess;
}

} // namespace frictab::data
