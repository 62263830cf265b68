// Names columns by their names first, then by their cells.
#include "guess/columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/name_words.h"
#include "data/time_stamps.h"
#include "guess/column_names.h"

namespace frictab::guess {

bool is_number_column(const io::CsvColumn& column) {
  std::size_t empty = 0;
  for (const io::CsvColumn::Text& cell : column.texts)
    empty += cell.text.empty();
  const std::size_t texts = column.texts.size() - empty, all = column.numbers.size();
  return all > empty && 10 * texts <= all - empty;
}

std::set<std::string> set_of(const std::vector<std::string>& cells) {
  return {cells.begin(), cells.end()};
}

Column* find_column(std::vector<Column>& columns, const std::string& canonical) {
  for (Column& column : columns)
    if (column.canonical == canonical) return &column;
  return nullptr;
}

const io::CsvColumn& raw_of(const Column& column, const io::CsvTable& table) {
  if (column.number > 0) return table.columns[column.number - 1];
  return *std::find_if(table.columns.begin(), table.columns.end(),
                       [&](const io::CsvColumn& raw) { return raw.name == column.name; });
}

namespace {

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
    if (!data::looks_like_time(column.texts[i].text)) return false;
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

// The cells of a column as texts, if they all differ.
std::vector<std::string> names_in(const io::CsvColumn& column) {
  std::vector<std::string> names = cells_of(column);
  if (set_of(names).size() < names.size()) names.clear();
  return names;
}

// Number of empty cells, where the first one is filled and at least a third is empty: a table that
// was merged in an office, and not one with a few lost values.
std::size_t cells_of_merged(const io::CsvColumn& column) {
  constexpr std::size_t least = 2, share = 3;
  std::size_t empty = 0;
  for (const io::CsvColumn::Text& cell : column.texts) {
    if (cell.row == 0 && cell.text.empty()) return 0;
    empty += cell.text.empty();
  }
  return empty >= least && share * empty >= column.numbers.size() && empty < column.numbers.size()
             ? empty
             : 0;
}

// The duration of each stop or stroke often falls from row to row, as clocks do not.
void reject_durations(std::vector<Column>& columns, const io::CsvTable& table) {
  Column* const clock = find_column(columns, "time_s");
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
void name_clock(std::vector<Column>& columns, const io::CsvTable& table) {
  if (columns.empty() || find_column(columns, "time_s")) return;
  Column& first = columns.front();
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

double least_of(const std::vector<double>& numbers) {
  double least = std::numeric_limits<double>::infinity();
  for (const double number : numbers)
    least = std::min(least, std::isnan(number) ? least : number);
  return std::isfinite(least) ? least : 0;
}

// Takes a friction column for a coefficient where it has no unit, no normal force goes with it, and
// it is as small as coefficients are.
void name_coefficient(std::vector<Column>& columns, const io::CsvTable& table) {
  constexpr double largest = 1.5;
  Column* const friction = find_column(columns, "F_R_N");
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
bool is_named_as_id(const Column& column) {
  return data::has_word(data::words_of_name(column.name),
                        {"id", "no", "nr", "number", "nummer", "run", "test", "versuch", "specimen",
                         "sample", "probe", "experiment", "trial", "exp", "pack", "lauf",
                         "messung"});
}

bool are_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return value == std::floor(value); });
}

// Rejects a column that numbers the rows as the name of a test.
void check_experiment(std::vector<Column>& columns, const io::CsvTable& table) {
  Column* const tests = find_column(columns, "experiment");
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
void find_tests_by_blocks(std::vector<Column>& columns, const io::CsvTable& table) {
  if (find_column(columns, "experiment")) return;
  const Column* const time = find_column(columns, "time_s");
  const Column* const counter = time ? time : find_column(columns, "s_mm");
  if (!counter || counter->text) return;
  const std::vector<std::size_t> begins = falls_of(raw_of(*counter, table).numbers);
  for (Column& column : columns) {
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

} // namespace

std::vector<Column> guess_columns(const io::CsvTable& table) {
  std::vector<Column> columns;
  std::map<std::string, std::size_t> alike;
  for (const io::CsvColumn& raw : table.columns)
    ++alike[raw.name];
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const io::CsvColumn& raw = table.columns[i];
    Column column;
    column.as_small = as_small_as_coefficients(raw);
    column.least = least_of(raw.numbers);
    if (raw.name.empty() && raw.unit.empty() && !column.as_small) continue;
    column.name = raw.name;
    if (alike[raw.name] > 1 || raw.name.empty()) column.number = i + 1;
    column.unit =
        raw.unit.empty() ? io::read_header_name(raw.name).unit : io::without_brackets(raw.unit);
    column.text = !is_number_column(raw);
    column.clock = column.text && is_clock_column(raw);
    column.first_values = first_values(raw);
    column.empty_below = cells_of_merged(raw);
    if (column.text || (is_named_as_id(column) && are_whole(raw.numbers)))
      column.names = names_in(raw);
    columns.push_back(std::move(column));
  }
  name_columns(columns);
  reject_durations(columns, table);
  name_clock(columns, table);
  check_experiment(columns, table);
  find_tests_by_blocks(columns, table);
  if (Column* const tests = find_column(columns, "experiment")) {
    tests->names = names_in(raw_of(*tests, table));
    const std::set<std::string> cells = set_of(cells_of(raw_of(*tests, table)));
    if (tests->names.empty()) tests->tests.assign(cells.begin(), cells.end());
  }
  name_coefficient(columns, table);
  return columns;
}

} // namespace frictab::guess
