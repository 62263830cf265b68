// Tries dialects and takes the one whose header is text and whose cells are mostly numbers.
#include "guess/dialect.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "core/error.h"
#include "guess/columns.h"
#include "io/number.h"

namespace frictab::guess {

namespace {

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
    units += io::is_unit_cell(column.unit);
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

// Tries formats and keeps the one of most worth.
class Attempts {
public:
  Attempts(std::string_view text, const std::string& named) : text_(text), named_(named) {}

  void attempt(const io::CsvFormat& format) {
    auto [worth, table] = read(format);
    if (worth <= most_) return;
    most_ = worth;
    best_.format = format;
    best_.table = std::move(table);
  }

  // Tries decimal signs and numbers of lines before the table. A sheet has points and commas.
  void attempt_all(io::CsvFormat format, bool workbook) {
    constexpr std::size_t longest_preamble = 60;
    if (workbook) format.delimiter = ',';
    format.sheet = workbook;
    for (const char decimal : {'.', ','})
      for (format.skip_rows = 0; format.skip_rows < longest_preamble; ++format.skip_rows) {
        format.decimal = decimal;
        if (!workbook || decimal == '.') attempt(format);
      }
  }

  // Tries names of two lines, where one line leaves columns without a name or with equal ones.
  void attempt_two_lines() {
    std::set<std::string> names;
    for (const io::CsvColumn& column : best_.table.columns)
      names.insert(column.name);
    names.erase("");
    if (names.size() == best_.table.columns.size() || best_.table.header_line < 2) return;
    io::CsvFormat format = best_.format;
    format.skip_rows = best_.table.header_line - 2;
    format.header_rows = 2;
    attempt(format);
  }

  void attempt_thousands() {
    for (const char between : {'.', ',', '\'', ' '}) {
      io::CsvFormat format = best_.format;
      format.thousands = between;
      if (between != format.decimal) attempt(format);
    }
  }

  bool found() const { return most_ > 0; }

  // The best one, with the other readings that are as good.
  Dialect take() {
    const char decimal = best_.format.decimal;
    if (best_.format.thousands == 0) {
      best_.any_decimal = reads_as_well(decimal == '.' ? ',' : '.');
      if (decimal == '.' && text_.find(';') != text_.npos && reads_as_well(',', '.'))
        best_.grouped = first_fraction();
    }
    return std::move(best_);
  }

private:
  // Worth of the text in this format, and its table; -1: it cannot be read in it.
  std::pair<double, io::CsvTable> read(const io::CsvFormat& format) const {
    try {
      FaultList faults;
      io::CsvTable table = io::parse_csv(text_, named_, format, faults);
      const double value = worth(table, faults.size(), format);
      return {value, std::move(table)};
    } catch (const InputError&) {
      return {-1, {}};
    }
  }

  bool reads_as_well(char decimal, char thousands = 0) const {
    io::CsvFormat format = best_.format;
    format.decimal = decimal;
    format.thousands = thousands;
    return read(format).first >= most_;
  }

  double first_fraction() const {
    for (const io::CsvColumn& column : best_.table.columns)
      for (const double value : column.numbers)
        if (value > 0 && value != std::floor(value)) return value;
    return 0;
  }

  std::string_view text_;
  const std::string& named_;
  double most_ = 0;
  Dialect best_;
};

} // namespace

Dialect find_dialect(std::string_view text, const std::string& named, bool workbook) {
  if (text.find_first_not_of(" \t\r\n") == text.npos)
    throw InputError({named, 0, 0}, "the file is empty");
  Attempts attempts(text, named);
  io::CsvFormat plain, with_units, without_header;
  with_units.units_row = true;
  without_header.header = false;
  attempts.attempt_all(plain, workbook);
  attempts.attempt_all(with_units, workbook);
  if (!attempts.found()) { // a short table above a legend
    plain.list = with_units.list = true;
    attempts.attempt_all(plain, workbook);
    attempts.attempt_all(with_units, workbook);
  }
  if (!attempts.found()) attempts.attempt_all(without_header, workbook);
  attempts.attempt_two_lines();
  attempts.attempt_thousands();
  if (!attempts.found())
    throw InputError({named, 0, 0}, "no table of numbers under a line of names was found",
                     "frictab init DIR writes a job with every key, to be filled in by hand");
  return attempts.take();
}

} // namespace frictab::guess
