#include "data/list_of_tests.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/name_words.h"
#include "io/number.h"

namespace frictab::data {

namespace {

// The text of a cell; empty for a number in a column of numbers.
std::string text_at(const io::CsvColumn& column, std::size_t row) {
  const std::size_t at = column.texts.first_from(row);
  return at < column.texts.size() && column.texts[at].row == row ? column.texts[at].text : "";
}

bool is_number(const std::string& text) {
  double ignored = 0;
  return io::read_number(text, '.', ignored) || io::read_number(text, ',', ignored);
}

bool holds_numbers(const io::CsvColumn& column, std::size_t first, std::size_t end) {
  const auto from = column.numbers.begin();
  return 2 * std::count_if(from + static_cast<long>(first), from + static_cast<long>(end),
                           [](double value) { return std::isfinite(value); }) >
         static_cast<long>(end - first);
}

// True if the first row holds units, and nothing but units, over columns of numbers.
bool begins_with_units(const io::CsvTable& table) {
  bool found = false;
  for (const io::CsvColumn& column : table.columns) {
    const std::string text = text_at(column, 0), unit = io::without_brackets(text);
    if (std::isfinite(column.numbers[0]) || is_number(text)) return false;
    if (text.empty() || unit == "-") continue;
    if (!convert(unit, unit)) return false;
    found = found || holds_numbers(column, 1, table.rows());
  }
  return found;
}

// Number of different filled cells of a row: a merged cell fills several with one text.
std::size_t filled_cells(const io::CsvTable& table, std::size_t row) {
  std::set<std::string> texts;
  std::size_t numbers = 0;
  for (const io::CsvColumn& column : table.columns)
    if (std::isfinite(column.numbers[row]))
      ++numbers;
    else if (const std::string text = text_at(column, row); !text.empty())
      texts.insert(text);
  return numbers + texts.size();
}

bool begins_a_legend(const io::CsvTable& table, std::size_t row) {
  for (const io::CsvColumn& column : table.columns)
    if (const std::string text = text_at(column, row); !text.empty())
      return has_word(words_of_name(text.substr(0, text.find(' '))),
                      {"legend", "legende", "remark", "remarks", "bemerkung", "bemerkungen",
                       "anmerkung", "anmerkungen", "note", "notes", "hinweis", "hinweise"});
  return false;
}

// True if a row below `end` rows of tests lacks what each of them has: it has fewer cells, and no
// number where they have numbers.
bool is_remark(const io::CsvTable& table, std::size_t row, std::size_t end, std::size_t least) {
  return filled_cells(table, row) < least &&
         std::none_of(table.columns.begin(), table.columns.end(), [&](const io::CsvColumn& column) {
           return std::isfinite(column.numbers[row]) && holds_numbers(column, 0, end);
         });
}

// Number of rows above the remarks, which stand below an empty line or begin with a word for them.
std::size_t rows_of_tests(const io::CsvTable& table) {
  std::size_t least = filled_cells(table, 0);
  for (std::size_t end = 1; end < table.rows(); ++end) {
    const bool may_end = table.line[end] > table.line[end - 1] + 1 || begins_a_legend(table, end);
    bool is_over = may_end;
    for (std::size_t row = end; is_over && row < table.rows(); ++row)
      is_over = is_remark(table, row, end, least);
    if (is_over) return end;
    least = std::min(least, filled_cells(table, end));
  }
  return table.rows();
}

} // namespace

io::CsvTable list_of_tests(io::CsvTable table) {
  if (table.rows() < 2 || table.header_line == 0) return table;
  const bool has_units = table.units_line == 0 && begins_with_units(table);
  for (io::CsvColumn& column : table.columns)
    if (has_units) column.unit = text_at(column, 0);
  const std::size_t units_line = has_units ? table.line[0] : table.units_line;
  if (has_units) table = io::rows_of(table, 1, table.rows());
  table.units_line = units_line;
  const std::size_t all = table.rows(), end = rows_of_tests(table);
  if (end == all) return table;
  table = io::rows_of(table, 0, end);
  table.notes.push_back(
      fmt::format("remarks below its rows: {} not read",
                  all - end == 1 ? "a line is" : fmt::format("{} lines are", all - end)));
  return table;
}

} // namespace frictab::data
