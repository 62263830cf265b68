// Arrangement of tests in a file.
#include "guess/layout.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/text.h"
#include "data/checks.h"
#include "data/name_words.h"
#include "guess/columns.h"
#include "io/number.h"

namespace frictab::guess {

namespace {

// Replaces each text by the number of its first row.
std::vector<double> levels_of(const io::CsvColumn& raw) {
  std::vector<double> levels = raw.numbers;
  std::map<std::string, double> known;
  for (const io::CsvColumn::Text& cell : raw.texts)
    levels[cell.row] = known.emplace(cell.text, static_cast<double>(cell.row)).first->second;
  return levels;
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

} // namespace

void take_tests_side_by_side(File& guess, const io::CsvTable& table) {
  if (!are_side_by_side(table)) return;
  std::vector<Column> first;
  for (Column& column : guess.columns) {
    if (!first.empty() && column.name == first.front().name) break;
    column.number = 0;
    first.push_back(std::move(column));
  }
  guess.columns = std::move(first);
  guess.side_by_side = true;
}

void find_tests_in_columns(File& guess) {
  std::map<std::string, std::vector<std::string>> columns; // by their first word
  for (const Column& column : guess.columns) {
    const std::size_t end = column.name.find_first_of(" _");
    if (column.text || column.above || end == column.name.npos || end == 0) continue;
    const std::string word = data::words_of_name(column.name.substr(0, end));
    const bool is_friction = data::has_word(
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

void take_intervals(File& guess, const io::CsvTable& table) {
  guess.intervals = !table.interval.empty() && table.interval.back() > 0;
  if (!guess.intervals) return;
  constexpr std::size_t most = 5, times = 5;
  std::vector<std::size_t> rows(table.interval.back() + 1);
  for (const std::size_t interval : table.interval)
    ++rows[interval];
  const auto [least, longest] = std::minmax_element(rows.begin(), rows.end());
  guess.phases = rows.size() <= most && *longest > times * *least;
}

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
    const bool sums_up = is_text && (begins_with_number || data::names_sums(first));
    if (numbers > 0 && 2 * numbers >= numeric && !sums_up)
      return has_text && 2 * lines < table.rows() ? lines : 0;
    has_text = has_text || line.find_first_not_of(" \t\r,;|") != line.npos;
    ++lines;
    end = begin == 0 ? 0 : begin - 1;
  }
  return 0;
}

bool each_row_is_a_test(const File& guess, const io::CsvTable& table) {
  if (guess.find("experiment") || guess.find("time_s")) return false;
  for (const Column& column : guess.columns)
    if (data::counts_rows_of_a_test(column.name)) return false;
  std::vector<std::vector<double>> settings;
  for (const Column& column : guess.columns)
    for (const io::CsvColumn& raw : table.columns)
      if (raw.name == column.name && !raw.name.empty() && !column.coefficient &&
          column.canonical != "tau_R_MPa" && column.canonical != "F_R_N")
        settings.push_back(levels_of(raw));
  return data::rows_look_like_tests(settings, table.rows());
}

std::string as_pattern(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += std::string_view(".^$*+?()[{|\\").find(c) == std::string_view::npos
               ? std::string(1, c)
               : std::string("\\") + c;
  return out;
}

} // namespace frictab::guess
