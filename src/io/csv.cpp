// A CSV reader that goes over the text once.
#include "io/csv.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

namespace frictab {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string_view trim(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t'))
    s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r'))
    s.remove_suffix(1);
  return s;
}

// The number a cell holds; false where it holds anything else.
bool parse_number(std::string_view cell, char decimal, double& value) {
  cell = trim(cell);
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  if (cell.empty()) return false;
  char buffer[64];
  const char* begin = cell.data();
  std::size_t size = cell.size();
  if (decimal != '.') {
    if (size >= sizeof buffer) return false;
    for (std::size_t i = 0; i < size; ++i) {
      if (cell[i] == '.') return false; // a point is no decimal mark here
      buffer[i] = cell[i] == decimal ? '.' : cell[i];
    }
    begin = buffer;
  }
  const auto [end, code] = std::from_chars(begin, begin + size, value);
  return code == std::errc() && end == begin + size;
}

// Walks over the text cell by cell.
class Scanner {
public:
  Scanner(std::string_view text, char delimiter) : text_(text), delimiter_(delimiter) {}

  bool at_end() const { return at_ >= text_.size(); }
  std::size_t line() const { return line_; }
  std::size_t column() const { return at_ - line_start_ + 1; }
  std::size_t position() const { return at_; }
  bool unclosed() const { return unclosed_; }

  std::string_view take_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end;
    next_line();
    return line;
  }

  // The next cell of this row; `last` is set where the row ends with it. Quoted cells are unquoted
  // into `storage`.
  std::string_view cell(bool& last, std::string& storage) {
    if (delimiter_ == ' ') skip_blanks();
    if (!at_end() && text_[at_] == '"') return quoted(last, storage);
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != delimiter_ && text_[at_] != '\n' &&
           !(delimiter_ == ' ' && text_[at_] == '\t'))
      ++at_;
    const std::string_view cell = text_.substr(begin, at_ - begin);
    finish(last);
    return cell;
  }

private:
  void next_line() {
    if (at_ < text_.size()) ++at_;
    ++line_;
    line_start_ = at_;
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r'))
      ++at_;
  }

  void finish(bool& last) {
    if (delimiter_ == ' ') skip_blanks();
    last = at_end() || text_[at_] == '\n';
    if (last)
      next_line();
    else if (delimiter_ != ' ')
      ++at_;
  }

  std::string_view quoted(bool& last, std::string& storage) {
    storage.clear();
    ++at_;
    for (;; ++at_) {
      if (at_end()) {
        unclosed_ = true;
        break;
      }
      if (text_[at_] == '"') {
        ++at_;
        if (at_end() || text_[at_] != '"') break; // "" is one "
      }
      if (text_[at_] == '\n') ++line_;
      storage += text_[at_];
    }
    while (!at_end() && text_[at_] != delimiter_ && text_[at_] != '\n')
      ++at_; // blanks, \r
    finish(last);
    return storage;
  }

  std::string_view text_;
  char delimiter_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t line_start_ = 0;
  bool unclosed_ = false;
};

// The separator of a header: the one that occurs most, blanks where there is none.
char find_delimiter(std::string_view header) {
  char best = ' ';
  std::size_t most = 0;
  for (const char candidate : {'\t', ';', ',', '|'}) {
    std::size_t count = 0;
    bool quoted = false;
    for (const char c : header) {
      if (c == '"') quoted = !quoted;
      count += c == candidate && !quoted;
    }
    if (count > most) {
      most = count;
      best = candidate;
    }
  }
  return best;
}

std::string_view without_footer(std::string_view text, std::size_t lines) {
  while (!text.empty() && std::strchr(" \t\r\n", text.back()))
    text.remove_suffix(1);
  for (; lines > 0 && !text.empty(); --lines) {
    const std::size_t end = text.find_last_of('\n');
    text = end == std::string_view::npos ? std::string_view() : text.substr(0, end);
  }
  return text;
}

bool is_blank(std::string_view text, std::size_t from) {
  for (; from < text.size() && text[from] != '\n'; ++from)
    if (!std::strchr(" \t\r", text[from])) return false;
  return true;
}

std::vector<std::string> read_names(Scanner& scanner) {
  std::vector<std::string> names;
  std::string storage;
  for (bool last = false; !last;)
    names.emplace_back(trim(scanner.cell(last, storage)));
  return names;
}

void read_rows(CsvTable& table, Scanner& scanner, std::string_view text, const CsvFormat& format,
               FaultList& faults) {
  const std::size_t width = table.columns.size();
  std::string storage;
  while (!scanner.at_end()) {
    if (is_blank(text, scanner.position())) {
      scanner.take_line();
      continue;
    }
    const std::size_t line = scanner.line();
    const std::size_t row = table.line.size();
    std::size_t cells = 0;
    for (bool last = false; !last; ++cells) {
      const std::string_view cell = scanner.cell(last, storage);
      if (cells >= width) continue;
      CsvColumn& column = table.columns[cells];
      double value = nan;
      if (!parse_number(cell, format.decimal, value)) {
        column.texts.push_back({row, std::string(trim(cell))});
        value = nan;
      }
      column.numbers.push_back(value);
    }
    if (cells == width) {
      table.line.push_back(line);
      continue;
    }
    faults.add({table.file, line, 0}, fmt::format("{} cells, the header has {}", cells, width),
               "a delimiter too many or too few, or a line that is no data (skip_footer)");
    for (CsvColumn& column : table.columns) {
      column.numbers.resize(row);
      while (!column.texts.empty() && column.texts.back().row == row)
        column.texts.pop_back();
    }
  }
  if (scanner.unclosed())
    faults.add({table.file, scanner.line(), 0}, "a quotation mark is never closed");
}

} // namespace

CsvTable parse_csv(std::string_view text, const std::string& file, const CsvFormat& format,
                   FaultList& faults) {
  CsvTable table;
  table.file = file;
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  if (without_footer(text, 0).empty()) throw InputError({file, 0, 0}, "the file is empty");
  if (text.find('\0') != std::string_view::npos)
    throw InputError({file, 0, 0}, "this is no text file", "give CSV text or HDF5");
  text = without_footer(text, format.skip_footer);
  Scanner lines(text, '\n');
  for (std::size_t i = 0; i < format.skip_rows && !lines.at_end(); ++i)
    lines.take_line();
  while (!lines.at_end() && is_blank(text, lines.position()))
    lines.take_line();
  if (lines.at_end())
    throw InputError({file, 0, 0},
                     fmt::format("no header after {} skipped lines", format.skip_rows),
                     "check data.skip_rows");
  table.header_line = lines.line();
  const std::size_t header = lines.position();
  const std::string_view header_text = text.substr(header, text.find('\n', header) - header);
  const char delimiter = format.delimiter ? format.delimiter : find_delimiter(header_text);
  Scanner scanner(text, delimiter);
  while (scanner.position() < header)
    scanner.take_line();
  std::size_t numeric = 0;
  double ignored = 0;
  for (std::string& name : read_names(scanner)) {
    numeric += parse_number(name, format.decimal, ignored);
    table.columns.push_back({std::move(name), "", {}, {}});
  }
  if (2 * numeric > table.columns.size())
    throw InputError({file, table.header_line, 0},
                     fmt::format("{} of the {} column names in this line are numbers", numeric,
                                 table.columns.size()),
                     "the header is another line: data.skip_rows counts the lines before it");
  if (format.units_row && !scanner.at_end()) {
    const std::size_t line = scanner.line();
    const auto units = read_names(scanner);
    if (units.size() != table.columns.size())
      faults.add({file, line, 0}, fmt::format("the units row has {} cells, the header {}",
                                              units.size(), table.columns.size()));
    for (std::size_t i = 0; i < std::min(units.size(), table.columns.size()); ++i)
      table.columns[i].unit = units[i];
  }
  const std::size_t estimate = text.size() / (header_text.size() / 2 + 8) + 16;
  for (CsvColumn& column : table.columns)
    column.numbers.reserve(estimate);
  read_rows(table, scanner, text, format, faults);
  if (table.rows() == 0 && faults.empty())
    throw InputError({file, table.header_line, 0}, "there are no rows below the header");
  return table;
}

} // namespace frictab
