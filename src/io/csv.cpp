// A single-pass CSV reader.
#include "io/csv.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <ranges>
#include <set>

#include <fmt/format.h>
#include <iconv.h>

#include "core/no_value.h"
#include "core/parallel.h"
#include "core/text.h"
#include "core/units.h"
#include "io/number.h"

namespace frictab::io {

namespace {

// Parses the number in a cell; false if the cell contains anything else.
bool parse_number(std::string_view cell, const CsvFormat& format, double& value) {
  cell = trimmed(cell);
  return read_number(cell, format.decimal, value) ||
         (format.thousands != 0 &&
          read_grouped_number(cell, format.decimal, format.thousands, value));
}

// Converts UTF-16 text to UTF-8; nullopt if the text is not UTF-16.
std::optional<std::string> from_utf16(std::string_view text) {
  const bool little = text.starts_with("\xFF\xFE"), big = text.starts_with("\xFE\xFF");
  if (!little && !big) return std::nullopt;
  const auto converter = iconv_open("UTF-8", little ? "UTF-16LE" : "UTF-16BE");
  std::string in(text.substr(2)), out(2 * text.size(), '\0'); // at most 3 bytes for 2
  char *from = in.data(), *to = out.data();
  std::size_t left = in.size(), room = out.size();
  const bool whole = iconv(converter, &from, &left, &to, &room) != static_cast<std::size_t>(-1);
  iconv_close(converter);
  if (!whole) return std::nullopt;
  out.resize(out.size() - room);
  return out;
}

bool is_lone_return(std::string_view text, std::size_t at) {
  return text[at] == '\r' && (at + 1 == text.size() || text[at + 1] != '\n');
}
bool has_lone_return(std::string_view text) {
  for (std::size_t at = text.find('\r'); at != text.npos; at = text.find('\r', at + 1))
    if (is_lone_return(text, at)) return true;
  return false;
}

// Scans the text cell by cell.
class Scanner {
public:
  Scanner(std::string_view text, char delimiter, std::size_t first_line = 1)
      : text_(text), delimiter_(delimiter), line_(first_line) {}

  bool at_end() const { return at_ >= text_.size(); }
  bool at_quote() const { return !at_end() && text_[at_] == '"'; }
  char delimiter() const { return delimiter_; }
  std::size_t line() const { return line_; }
  std::size_t column() const { return at_ - line_start_ + 1; }
  std::size_t position() const { return at_; }
  std::size_t unclosed_line() const { return unclosed_line_; } // 0 = none

  // Fast path, used for most cells of a file: takes the cell if it is a plain number.
  bool number(char decimal, double& value, bool& last) {
    const char* p = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    while (p != end && is_padding(*p))
      ++p;
    if (p == end) return false;
    p = scan_number(p, end, decimal, value);
    if (!p) return false;
    while (p != end && is_padding(*p))
      ++p;
    const bool blank_follows =
        delimiter_ == ' ' && (p[-1] == ' ' || p[-1] == '\t' || p[-1] == '\r');
    if (p != end && *p != delimiter_ && *p != '\n' && !blank_follows) return false;
    at_ = static_cast<std::size_t>(p - text_.data());
    finish(last);
    return true;
  }

  std::string_view take_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end;
    next_line();
    return line;
  }

  // The next cell of this row; `last` is set if it ends the row. Quoted cells are unquoted into
  // `storage`.
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
  bool is_padding(char c) const {
    return c == ' ' || c == '\r' || (c == '\t' && delimiter_ != '\t');
  }

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
    const std::size_t opened = line_;
    ++at_;
    for (;; ++at_) {
      if (at_end()) {
        unclosed_line_ = opened;
        break;
      }
      if (text_[at_] == '"') {
        ++at_;
        if (at_end() || text_[at_] != '"') break; // "" stands for one "
      }
      if (text_[at_] == '\n') ++line_;
      storage += text_[at_];
    }
    while (!at_end() && text_[at_] != delimiter_ && text_[at_] != '\n')
      storage += text_[at_++]; // blanks and \r are trimmed; anything else makes the cell text
    finish(last);
    return storage;
  }

  std::string_view text_;
  char delimiter_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t line_start_ = 0;
  std::size_t unclosed_line_ = 0;
};

std::size_t count_cells(std::string_view line, char delimiter) {
  std::size_t count = 1;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    count += c == delimiter && !quoted;
  }
  return count;
}

// Separator of a header: the most frequent candidate, or blanks if there is none. A candidate that
// gives the line below the same number of cells takes precedence, because names contain commas too
// ("Load (N, mean)"). The decimal sign may separate cells in quotes.
char find_delimiter(std::string_view header, std::string_view below, char decimal) {
  char best = ' ';
  std::size_t most = 0;
  for (const char candidate : {'\t', ';', ',', '|'}) {
    const std::size_t count = count_cells(header, candidate);
    const bool agrees = count_cells(below, candidate) == count;
    const bool is_decimal = candidate == decimal && !(agrees && below.starts_with('"'));
    if (is_decimal || count < 2) continue;
    const std::size_t score = count + (agrees ? header.size() : 0);
    if (score > most) {
      most = score;
      best = candidate;
    }
  }
  return best;
}

std::string_view without_footer(std::string_view text, std::size_t lines) {
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  if (last == text.npos) return {};
  // tabs at the end of the last line are empty cells
  text = text.substr(0, std::min(text.find_first_not_of(" \t", last + 1), text.size()));
  for (; lines > 0 && !text.empty(); --lines) {
    const std::size_t end = text.find_last_of('\n');
    text = end == std::string_view::npos ? std::string_view() : text.substr(0, end);
  }
  return text;
}

// True for a line of blanks or of delimiters only, as spreadsheets write empty rows.
bool is_blank(std::string_view text, std::size_t from) {
  for (; from < text.size() && text[from] != '\n'; ++from)
    if (!std::strchr(" \t\r,;|", text[from])) return false;
  return true;
}

constexpr std::size_t most_columns = 1'000'000; // of Excel: 16,384

// The cells of a line; of those beyond the most columns, one.
std::vector<std::string> read_names(Scanner& scanner) {
  std::vector<std::string> names;
  std::string storage;
  for (bool last = false; !last;)
    if (const std::string_view cell = scanner.cell(last, storage); names.size() <= most_columns)
      names.emplace_back(trimmed(cell));
  return names;
}

// Flags the columns whose cells stay text.
std::vector<char> text_columns(const CsvTable& table, const CsvFormat& format) {
  std::vector<char> is_text(table.columns.size());
  for (std::size_t i = 0; i < is_text.size(); ++i)
    is_text[i] = i + 1 == format.text_number ||
                 std::count(format.text_columns.begin(), format.text_columns.end(),
                            table.columns[i].name) > 0;
  return is_text;
}

// `filled`: cells of a line without the empty ones after the last column; `kept`: cells stored in
// columns; `held`: those with content, of which the first is in column `first`.
struct Cells {
  std::size_t filled = 0, kept = 0, held = 0, first = 0;
  bool begins_with_number = false;
  bool is_one_text() const { return held == 1 && !begins_with_number; }
  void hold(std::size_t column, bool is_number) {
    if (held++ > 0) return;
    first = column;
    begins_with_number = is_number;
  }
};

// Appends empty cells for the rows before this one that the column lacks.
void pad(CsvColumn& column, std::size_t row) {
  for (std::size_t i = column.numbers.size(); i < row; ++i) {
    column.numbers.push_back(no_value);
    column.texts.push_back({i, "", 0});
  }
}

// Reads one line's cells into row `row` of the columns. Empty cells after the last name are stored
// only if a filled one follows: a header may end with a thousand delimiters.
Cells read_cells(CsvTable& table, Scanner& scanner, const CsvFormat& format,
                 const std::vector<char>& is_text, std::size_t named, std::size_t row) {
  std::string storage;
  std::size_t cells = 0;
  Cells line;
  for (bool last = false; !last; ++cells) {
    const bool known = cells < is_text.size();
    if (known) line.filled = cells + 1;
    double value = no_value;
    if (known && !is_text[cells] && scanner.number(format.decimal, value, last)) {
      line.hold(cells, true);
      pad(table.columns[cells], row);
      table.columns[cells].numbers.push_back(value);
      continue;
    }
    const std::size_t place = scanner.column();
    const std::string_view cell = trimmed(scanner.cell(last, storage));
    const bool is_number = parse_number(cell, format, value);
    if (!cell.empty()) line.hold(cells, is_number);
    if (!known) {
      if (!cell.empty()) line.filled = cells + 1;
      continue;
    }
    if (cells >= named && cell.empty()) continue;
    pad(table.columns[cells], row);
    if (is_text[cells] || !is_number) {
      table.columns[cells].texts.push_back({row, to_utf8(cell), place});
      value = no_value;
    }
    table.columns[cells].numbers.push_back(value);
  }
  line.kept = std::min(cells, is_text.size());
  return line;
}

// True for a line of a sheet that lacks cells at its end, which are empty and thus not stored. A
// title or a remark is one text, and begins with it where rows begin with numbers.
bool is_short_row(const CsvTable& table, const Cells& line, std::size_t named, std::size_t row) {
  if (line.held == 0 || (line.is_one_text() && named > 2)) return false;
  return row == 0 || line.begins_with_number ||
         std::isnan(table.columns[line.first].numbers.front());
}

// Number of columns up to the last name: a header may end with delimiters that its rows do not
// have.
std::size_t named_columns(const CsvTable& table) {
  std::size_t count = table.columns.size();
  while (count > 0 && table.columns[count - 1].name.empty())
    --count;
  return count == 0 ? table.columns.size() : count;
}

// Removes nameless columns without content after the last name and pads the others with empty
// cells, as are those that a sheet does not store.
void settle_nameless(CsvTable& table, std::size_t named) {
  while (table.columns.size() > named && table.columns.back().numbers.empty())
    table.columns.pop_back();
  for (CsvColumn& column : table.columns)
    pad(column, table.rows());
}

bool starts_with_line(std::string_view text, std::size_t at, std::string_view line) {
  return text.substr(at, line.size()) == line &&
         (at + line.size() == text.size() || text[at + line.size()] == '\n');
}

// Skips blank lines.
void skip_blank_lines(Scanner& lines, std::string_view text) {
  while (!lines.at_end() && is_blank(text, lines.position()))
    lines.take_line();
}

// Skips a repeated header line and its units.
void skip_header(Scanner& scanner, std::string_view text, const CsvFormat& format) {
  for (std::size_t i = 0; i < format.header_rows; ++i)
    scanner.take_line();
  if (!format.units_row) return;
  skip_blank_lines(scanner, text);
  if (!scanner.at_end()) scanner.take_line();
}

// Removes a row from the columns that it reached, so that a short line in a wide file costs only
// its own cells.
void forget_row(CsvTable& table, std::size_t row, std::size_t columns) {
  for (std::size_t i = 0; i < columns; ++i) {
    CsvColumn& column = table.columns[i];
    if (column.numbers.size() > row) column.numbers.resize(row);
    while (!column.texts.empty() && column.texts.back().row == row)
      column.texts.pop_back();
  }
}

// A line that is not a row.
struct RaggedLine {
  std::size_t line, cells;
  bool is_one_text;
};

// Reports ragged lines, once per number of cells.
void report_ragged_lines(const std::vector<RaggedLine>& ragged, const CsvTable& table,
                         const char* model, FaultList& faults) {
  std::map<std::size_t, std::size_t> count, titles;
  for (const RaggedLine& one : ragged) {
    ++count[one.cells];
    titles[one.cells] += one.is_one_text && table.rows() > 0 && one.line > table.line.front() &&
                         one.line < table.line.back();
  }
  for (const RaggedLine& one : ragged) {
    std::size_t& lines = count[one.cells];
    if (lines == 0) continue; // already reported
    faults.add({table.file, one.line, 0},
               fmt::format("{} cells, the {} has {}{}", one.cells, model, table.columns.size(),
                           and_more(lines - 1, "line")),
               titles[one.cells] > 0
                   ? "are these titles between the rows? Cut the rows at them with data.segments; "
                     "or a delimiter too many or too few"
                   : "a delimiter too many or too few, a line that is not data (skip_footer), or "
                     "another line is the header (skip_rows)");
    lines = 0;
  }
}

std::string_view line_at(std::string_view text, std::size_t begin) {
  return begin < text.size() ? text.substr(begin, text.find('\n', begin) - begin)
                             : std::string_view();
}

// A line as the job's patterns see it: without the quotes that the reader of a sheet adds.
std::string text_of_line(std::string_view line, const CsvFormat& format) {
  line = line.substr(0, line.find('\r'));
  if (!format.sheet || line.find('"') == line.npos) return std::string(line);
  Scanner cells(line, ',');
  return join(read_names(cells), ",");
}

// True if at least half of the cells of a line are numbers.
bool holds_numbers(std::string_view line, char delimiter, const CsvFormat& format) {
  Scanner scanner(line, delimiter);
  const std::vector<std::string> cells = read_names(scanner);
  double ignored = 0;
  const auto numbers = std::count_if(cells.begin(), cells.end(), [&](const std::string& cell) {
    return parse_number(cell, format, ignored);
  });
  return numbers > 0 && 2 * static_cast<std::size_t>(numbers) >= cells.size();
}

// The runs of rows that the job's patterns cut out of the lines.
class Segments {
public:
  Segments(const CsvFormat& format, char delimiter)
      : format_(format), rules_(format.segments.get()), delimiter_(delimiter) {}

  // True for a line that begins or ends a run, or stands between two of them. A run takes the place
  // of those before the first row.
  bool passes(std::string_view line, bool has_rows) {
    const std::string text = text_of_line(line, format_);
    if (auto groups = rules_->begins.search(text)) {
      if (!has_rows) groups_.clear();
      groups_.push_back(std::move(*groups));
      inside_ = true;
      return true;
    }
    if (inside_ && rules_->ends && rules_->ends->search(text)) {
      inside_ = false;
      return true;
    }
    if (inside_) return false;
    ++outside_;
    rows_outside_ += holds_numbers(line, delimiter_, format_);
    return true;
  }

  // The last run that begins in the preamble holds the first rows.
  void look_at_preamble(std::string_view text) {
    for (Scanner lines(text, '\n'); rules_ && !lines.at_end();)
      passes(lines.take_line(), false);
    outside_ = rows_outside_ = 0;
  }

  bool are_cut() const { return rules_; }
  std::size_t number() const { return groups_.size() - 1; } // of the current run, from 0
  std::size_t count() const { return groups_.size(); }
  std::size_t outside() const { return outside_; }
  std::size_t rows_outside() const { return rows_outside_; }

  // Adds the named groups as columns.
  void add_columns(CsvTable& table, const CsvFormat& format) const {
    if (!rules_) return;
    for (const std::string& name : rules_->begins.names()) {
      CsvColumn column{name, "", {}, {}};
      for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::string& text = groups_[table.interval[row]].at(name);
        double value = no_value;
        if (!parse_number(text, format, value)) column.texts.push_back({row, to_utf8(text), 0});
        column.numbers.push_back(value);
      }
      table.columns.push_back(std::move(column));
    }
  }

private:
  const CsvFormat& format_;
  const CsvSegments* rules_;
  char delimiter_;
  std::vector<std::map<std::string, std::string>> groups_; // of each run
  bool inside_ = false;
  std::size_t outside_ = 0, rows_outside_ = 0;
};

// Takes the remarks out of the ragged lines of a list of tests: lines of one text, and all lines
// below the last row. Returns their number.
std::size_t pass_over_remarks(std::vector<RaggedLine>& ragged, std::vector<RaggedLine>& below) {
  const std::size_t lines = below.size();
  below.clear();
  return lines + std::erase_if(ragged, [](const RaggedLine& one) { return one.is_one_text; });
}

// `preamble`: the lines before the header.
void read_rows(CsvTable& table, Scanner& scanner, std::string_view text,
               std::string_view header_text, std::string_view preamble, const CsvFormat& format,
               FaultList& faults) {
  const std::size_t width = table.columns.size(), named = named_columns(table);
  const std::vector<char> is_text = text_columns(table, format);
  std::size_t again = 0, in_front = 0, delimiters_alone = 0, remarks = 0, of_lists = 0;
  // ragged lines just before a repeated header are not faults
  std::vector<RaggedLine> ragged, since_row;
  Segments segments(format, scanner.delimiter());
  segments.look_at_preamble(preamble);
  const auto tell = [&] {
    ragged.insert(ragged.end(), since_row.begin(), since_row.end());
    since_row.clear();
  };
  while (!scanner.at_end()) {
    const std::size_t row = table.line.size();
    if (is_blank(text, scanner.position())) {
      delimiters_alone += scanner.take_line().find_first_of(",;|") != std::string_view::npos;
      continue;
    }
    if (segments.are_cut() && segments.passes(line_at(text, scanner.position()), row > 0)) {
      scanner.take_line();
      continue;
    }
    const std::size_t line = scanner.line();
    if (!header_text.empty() && starts_with_line(text, scanner.position(), header_text)) {
      skip_header(scanner, text, format);
      in_front += since_row.size();
      since_row.clear();
      ++again;
      continue;
    }
    const Cells cells = read_cells(table, scanner, format, is_text, named, row);
    if (cells.filled <= width &&
        (cells.filled >= named || (format.sheet && is_short_row(table, cells, named, row)))) {
      tell();
      table.line.push_back(line);
      table.interval.push_back(segments.are_cut() ? segments.number() : again);
      continue;
    }
    since_row.push_back({line, cells.filled, cells.is_one_text()});
    forget_row(table, row, cells.kept);
  }
  if (format.sheet && !table.line.empty())
    remarks = std::erase_if(since_row, [](const RaggedLine& one) { return one.is_one_text; });
  if (format.list && !table.line.empty()) of_lists = pass_over_remarks(ragged, since_row);
  tell();
  report_ragged_lines(ragged, table, header_text.empty() ? "first row" : "header", faults);
  settle_nameless(table, named);
  segments.add_columns(table, format);
  table.passed_over = {again,
                       in_front,
                       delimiters_alone,
                       table.passed_over.below_units,
                       segments.count(),
                       segments.outside(),
                       segments.rows_outside(),
                       remarks,
                       of_lists};
  if (scanner.unclosed_line() > 0)
    faults.add({table.file, scanner.unclosed_line(), 0},
               "a quotation mark opens here and is never closed");
}

std::vector<CsvCount> counts_of(const CsvPassedOver& lines) {
  std::vector<CsvCount> counts = {
      {"the header line comes again ", " times", lines.headers},
      {"", " lines in front of a repeated header are not rows", lines.in_front},
      {"", " lines hold delimiters alone: they are not rows", lines.delimiters_alone},
      {"lines of words below the units, not read: ", "", lines.below_units},
      {"runs of rows between lines of data.segments: ", "", lines.segments},
      {"lines outside these runs, not read: ", "", lines.outside_segments},
      {"lines outside these runs that hold numbers, as rows do: ", "", lines.rows_outside}};
  std::erase_if(counts, [](const CsvCount& one) { return one.count == 0; });
  return counts;
}

std::vector<std::string> notes_of(const CsvPassedOver& lines) {
  std::vector<std::string> notes;
  if (lines.remarks > 0)
    notes.push_back(
        fmt::format("{} below the last row {} not read: one text alone",
                    lines.remarks == 1 ? "a line" : fmt::format("{} lines", lines.remarks),
                    lines.remarks == 1 ? "is" : "are"));
  if (lines.of_lists > 0)
    notes.push_back(fmt::format("remarks between or below its rows: {} not read",
                                lines.of_lists == 1 ? "a line is"
                                                    : fmt::format("{} lines are", lines.of_lists)));
  return notes;
}

bool is_called(const CsvColumn& column, const std::string& name) {
  return column.name == name || read_header_name(column.name).name == name;
}

// Gives empty cells below a filled one its value, and returns their number.
std::size_t fill_column(CsvColumn& column) {
  CsvTexts texts;
  std::size_t filled = 0, text = 0;
  std::optional<std::string> above; // the last text; none: a number
  bool is_below = false;
  double number = no_value;
  for (std::size_t row = 0; row < column.numbers.size(); ++row) {
    const bool is_text = text < column.texts.size() && column.texts[text].row == row;
    if (!is_text) {
      number = column.numbers[row];
      above.reset();
    } else if (const CsvTexts::Text cell = column.texts[text++]; !cell.text.empty() || !is_below) {
      texts.push_back(cell);
      above = cell.text;
      is_below = is_below || !cell.text.empty();
      continue;
    } else {
      ++filled;
      if (above) texts.push_back({row, *above, cell.column});
      if (!above) column.numbers[row] = number;
    }
    is_below = true;
  }
  column.texts = std::move(texts);
  return filled;
}

void fill_down(CsvTable& table, const CsvFormat& format) {
  for (const std::string& name : format.fill_down)
    for (CsvColumn& column : table.columns)
      if (is_called(column, name))
        if (const std::size_t cells = fill_column(column); cells > 0)
          table.counts.push_back(
              {name + ": empty cells with the value above (data.fill_down): ", "", cells});
}

// Joins the names of two lines: "Kraft" over "Soll" is "Kraft Soll"; a name that stands in both, as
// that of a merged cell does, counts once.
void join_names(std::vector<std::string>& names, const std::vector<std::string>& below) {
  names.resize(std::max(names.size(), below.size()));
  for (std::size_t i = 0; i < below.size(); ++i)
    if (names[i].empty())
      names[i] = below[i];
    else if (!below[i].empty() && below[i] != names[i])
      names[i] += " " + below[i];
}

// Removes the sign before a header that programs write as a comment: "# t(s) mu", "#time,mu".
void remove_comment_sign(std::vector<std::string>& names, Scanner below) {
  std::string& first = names.front();
  if ((first == "#" || first == "%") && !below.at_end() &&
      read_names(below).size() + 1 == names.size())
    names.erase(names.begin());
  else if (first.size() > 1 && (first[0] == '#' || first.starts_with("% ")))
    first = trimmed(std::string_view(first).substr(1));
}

// True if rows have a name of their own in front, as R writes them: text in quotes or 1, 2, ... in
// a column that the header lacks. Between commas only the former: one may be that of a decimal.
bool rows_have_names(Scanner below, std::size_t columns) {
  int row = 0;
  for (; row < 2 && !below.at_end(); ++row) {
    const bool quoted = below.at_quote();
    const std::vector<std::string> cells = read_names(below);
    if (cells.size() != columns + 1 || cells.back().empty() ||
        (!quoted && (below.delimiter() == ',' || cells.front() != std::to_string(row + 1))))
      return false;
  }
  return row > 0;
}

// Columns named by their numbers, for a file whose first line below the preamble is a row.
void name_by_number(CsvTable& table, std::size_t columns) {
  for (std::size_t i = 1; i <= columns; ++i)
    table.columns.push_back({fmt::format("column_{}", i), "", {}, {}});
}

// Reads and checks the header; moves `scanner` past it. False if there is none: `scanner` is then
// past the first row.
bool read_header(CsvTable& table, Scanner& scanner, const CsvFormat& format) {
  std::vector<std::string> names = read_names(scanner);
  if (names.size() > most_columns)
    throw InputError({table.file, table.header_line, 0},
                     fmt::format("more than {} columns in this line", thousands(most_columns)),
                     "is this the header, and the delimiter right? data.skip_rows, data.delimiter");
  double ignored = 0;
  const auto numeric = static_cast<std::size_t>(
      std::count_if(names.begin(), names.end(),
                    [&](const std::string& name) { return parse_number(name, format, ignored); }));
  const bool numbers = 2 * numeric > names.size();
  if (!format.header || (numbers && format.may_lack_header)) {
    name_by_number(table, names.size());
    return false;
  }
  if (numbers)
    throw InputError(
        {table.file, table.header_line, 0},
        fmt::format("{} of the {} column names in this line are numbers", numeric, names.size()),
        "the header is another line: data.skip_rows counts the lines before it; of a "
        "file without one, data.header = false takes columns by number");
  remove_comment_sign(names, scanner);
  for (std::size_t i = 1; i < format.header_rows && !scanner.at_end(); ++i)
    join_names(names, read_names(scanner));
  if (rows_have_names(scanner, names.size())) names.insert(names.begin(), "");
  for (const std::string& name : names)
    table.columns.push_back({to_utf8(name), "", {}, {}});
  return true;
}

void read_units(CsvTable& table, Scanner& scanner, std::string_view text, const CsvFormat& format,
                FaultList& faults) {
  skip_blank_lines(scanner, text);
  const std::size_t line = table.units_line = scanner.line();
  const auto units = read_names(scanner);
  const bool lacks_last = units.size() < table.columns.size() && format.sheet;
  if (units.size() != table.columns.size() && !lacks_last)
    faults.add({table.file, line, 0}, fmt::format("the units row has {} cells, the header {}",
                                                  units.size(), table.columns.size()));
  for (std::size_t i = 0; i < std::min(units.size(), table.columns.size()); ++i)
    table.columns[i].unit = to_utf8(units[i]);
}

bool is_lost_value(const std::string& cell) {
  const std::string word = lower_case(cell);
  return word == "nan" || word == "na" || word == "n/a" || word == "#n/a" || word == "null" ||
         word == "n.a.";
}

// True for a word in front of a line whose first column holds numbers in the next two lines, as the
// zero values of the channels are written: "Nullwert; 0,0; 1,2".
bool begins_with_word(const CsvTable& table, const std::string& first, Scanner below,
                      const CsvFormat& format) {
  if (first.empty() || text_columns(table, format).front() ||
      !std::isalpha(static_cast<unsigned char>(first[0])))
    return false;
  if (is_lost_value(first)) return false;
  double ignored = 0;
  for (int line = 0; line < 2; ++line)
    if (below.at_end() || !parse_number(read_names(below).front(), format, ignored)) return false;
  return true;
}

bool has_letter(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalpha(c) || c >= 0x80; });
}

// The cells of a line below the units.
struct LineOfWords {
  std::vector<std::string> cells;
  std::vector<char> is_number;
  bool has_number = false, has_units = false; // these in most of its filled cells

  LineOfWords(Scanner& scanner, const CsvFormat& format) : cells(read_names(scanner)) {
    constexpr std::size_t many = 3; // cells of one text alone, as T1: the name of a test
    double ignored = 0;
    std::set<std::string> different;
    std::size_t units = 0, filled = 0;
    for (const std::string& cell : cells) {
      is_number.push_back(parse_number(cell, format, ignored));
      has_number = has_number || is_number.back();
      filled += !cell.empty();
      if (is_unit_cell(cell)) ++units, different.insert(cell);
    }
    has_units = 2 * units > filled && (different.size() > 1 || units < many);
  }
};

// True if some cell is a word above the numbers of the next two lines that have any, and none is a
// mark for a lost value: a comment, and not a row.
bool are_words_above_numbers(const LineOfWords& line, Scanner below, std::string_view text,
                             const CsvFormat& format) {
  constexpr int most = 6;
  std::vector<std::size_t> numbers(line.cells.size());
  std::size_t rows = 0;
  for (int ahead = 0; ahead < most && rows < 2 && !below.at_end(); ++ahead) {
    const bool blank = is_blank(text, below.position());
    const LineOfWords next(below, format);
    if (blank || !next.has_number) continue;
    ++rows;
    for (std::size_t c = 0; c < std::min(numbers.size(), next.cells.size()); ++c)
      numbers[c] += next.is_number[c] != 0;
  }
  bool has_word = false;
  for (std::size_t c = 0; rows > 0 && c < line.cells.size(); ++c) {
    if (is_lost_value(line.cells[c])) return false;
    has_word = has_word || (numbers[c] == rows && has_letter(line.cells[c]));
  }
  return has_word;
}

// Skips lines between the units and the first row that hold no units, and no numbers or a word
// before them: the name of each channel's amplifier, the comments of Origin. A line that begins a
// segment stays.
void skip_words_below_units(CsvTable& table, Scanner& scanner, std::string_view text,
                            const CsvFormat& format) {
  constexpr std::size_t most = 4;
  Scanner ahead = scanner;
  for (std::size_t lines = 0; lines <= most && !ahead.at_end();) {
    const Scanner here = ahead;
    if (is_blank(text, ahead.position())) {
      ahead.take_line();
      continue;
    }
    const std::string_view one = line_at(text, ahead.position());
    const LineOfWords line(ahead, format);
    const bool begins_segment =
        format.segments && format.segments->begins.search(text_of_line(one, format));
    const bool is_passed =
        !begins_segment && !line.has_units &&
        (line.has_number ? begins_with_word(table, line.cells.front(), ahead, format)
                         : are_words_above_numbers(line, ahead, text, format));
    if (is_passed) {
      ++lines;
      continue;
    }
    table.passed_over.below_units = lines;
    if (lines > 0) scanner = here;
    return;
  }
}

// Number of wanted names in a line, for the delimiter that gives the most.
std::size_t count_names(std::string_view line, const CsvFormat& format) {
  std::size_t most = 0;
  for (const char delimiter : {',', ';', '\t', '|', ' '}) {
    if (format.delimiter && delimiter != format.delimiter) continue;
    if (delimiter == ' ' && line.find_first_of("\t;|") != line.npos) continue; // words of a cell
    Scanner scanner(line, delimiter);
    std::size_t count = 0;
    for (const std::string& cell : read_names(scanner))
      count += is_wanted(to_utf8(cell), format);
    most = std::max(most, count);
  }
  return most;
}

std::string_view bare(std::string_view part, std::string_view around = " \t\r\"';:=,") {
  const std::size_t begin = part.find_first_not_of(around);
  if (begin == part.npos) return {};
  return part.substr(begin, part.find_last_not_of(around) + 1 - begin);
}

// A name and a value, without the quotes of cells and the sign of a comment; nullopt where one of
// them is empty, or the name is a number.
std::optional<CsvAbove> condition_of(std::string_view name, std::string_view value) {
  name = bare(name, " \t\r\"';:=,#%");
  value = bare(value);
  if (!has_letter(name) || value.empty()) return std::nullopt;
  return CsvAbove{to_utf8(name), to_utf8(replace_all(std::string(value), "\"", ""))};
}

// The sign that separates name and value: one of \t ; : = or two blanks, or else a comma; npos if
// there is none. A colon between digits is that of a time of day.
std::size_t end_of_name(std::string_view line) {
  std::size_t cut = line.find_first_of("\t;:=");
  const auto is_digit = [&](std::size_t at) {
    return at < line.size() && std::isdigit(static_cast<unsigned char>(line[at]));
  };
  while (cut != line.npos && line[cut] == ':' && cut > 0 && is_digit(cut - 1) && is_digit(cut + 1))
    cut = line.find_first_of("\t;:=", cut + 1);
  cut = std::min(cut, line.find("  "));
  return cut == line.npos ? line.find(',') : cut;
}

// The conditions in a line of cells. An empty cell between a value and a name separates two of
// them: "Tool;GS-14;;Oil;X".
std::vector<CsvAbove> conditions_in_cells(std::string_view line, char separator) {
  Scanner scanner(line, separator);
  const std::vector<std::string> cells = read_names(scanner);
  std::vector<CsvAbove> out;
  for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end + 1) {
    const auto next_begins = [&](std::size_t i) {
      return i >= begin + 2 && i + 2 < cells.size() && cells[i].empty() &&
             has_letter(cells[i + 1]) && !cells[i + 2].empty();
    };
    end = begin + 1;
    std::string value;
    for (; end < cells.size() && !next_begins(end); ++end)
      value += separator + cells[end];
    if (auto one = condition_of(cells[begin], value)) out.push_back(std::move(*one));
  }
  return out;
}

std::vector<CsvAbove> conditions_of_line(std::string_view line, const CsvFormat& format) {
  std::string cell;
  if (format.sheet) {
    if (count_cells(line, ',') > 1) return conditions_in_cells(line, ',');
    line = cell = text_of_line(line, format);
  }
  const std::size_t cut = end_of_name(line);
  if (cut == line.npos) return {};
  if (line[cut] == '\t' || line[cut] == ';' || line[cut] == ',')
    return conditions_in_cells(line, line[cut]);
  if (auto one = condition_of(line.substr(0, cut), line.substr(cut))) return {std::move(*one)};
  return {};
}

std::vector<CsvAbove> conditions_in(std::string_view preamble, const CsvFormat& format) {
  constexpr std::size_t most = 200;
  std::vector<CsvAbove> out;
  for (Scanner lines(preamble, '\n'); !lines.at_end() && out.size() < most;)
    for (CsvAbove& one : conditions_of_line(lines.take_line(), format))
      if (std::none_of(out.begin(), out.end(),
                       [&](const CsvAbove& other) { return other.name == one.name; }))
        out.push_back(std::move(one));
  return out;
}

// Twice the number of wanted names in a line, less one if it seems to give the value of the only
// one.
std::size_t worth_as_header(std::string_view line, const CsvFormat& format) {
  const std::size_t names = count_names(line, format);
  if (names != 1) return 2 * names;
  const std::vector<CsvAbove> conditions = conditions_of_line(line, format);
  const bool gives_value =
      std::any_of(conditions.begin(), conditions.end(), [&](const CsvAbove& one) {
        return is_wanted(one.name, format) &&
               (std::isdigit(static_cast<unsigned char>(one.value[0])) ||
                one.value.find_first_of("\t;,|") == std::string::npos);
      });
  return gives_value ? 1 : 2;
}

// Skips the preamble up to the header line. Throws if there is none.
void find_header(Scanner& lines, std::string_view text, const std::string& file,
                 const CsvFormat& format) {
  for (std::size_t i = 0; i < format.skip_rows && !lines.at_end(); ++i)
    lines.take_line();
  skip_blank_lines(lines, text);
  // "sep=;" is a directive to spreadsheets, not a header.
  if (format.skip_rows == 0 && line_at(text, lines.position()).starts_with("sep="))
    lines.take_line();
  if (lines.at_end())
    throw InputError({file, 0, 0},
                     fmt::format("no header after {} skipped lines", format.skip_rows),
                     format.skip_footer > 0 ? "check data.skip_rows and data.skip_footer"
                                            : "check data.skip_rows");
  if (!format.header || format.wanted.empty() ||
      worth_as_header(line_at(text, lines.position()), format) > 1)
    return;
  constexpr int longest_preamble = 200;
  Scanner ahead = lines, best = lines;
  std::size_t most = 0;
  for (int i = 0; i < longest_preamble && !ahead.at_end(); ++i) {
    const std::size_t worth = worth_as_header(line_at(text, ahead.position()), format);
    if (worth > most) best = ahead;
    most = std::max(most, worth);
    ahead.take_line();
  }
  lines = best;
}

// The text with \n as line end; `storage` keeps it if it had lone CRs.
std::string_view with_unix_lines(std::string_view text, std::string& storage) {
  if (!has_lone_return(text)) return text;
  storage = text;
  for (std::size_t i = 0; i < storage.size(); ++i)
    if (is_lone_return(storage, i)) storage[i] = '\n';
  return storage;
}

void check_text(std::string_view text, const std::string& file) {
  if (text.find('\0') != text.npos)
    throw InputError({file, 0, 0}, "this is not a text file", "give CSV text or HDF5");
}

// The part of the text before the first row.
struct Head {
  std::string_view header; // the header line; empty if there is none
  char delimiter = ',';
  std::size_t begin = 0; // position of the header
  // position and number of the first line below header and units
  std::size_t end = 0, end_line = 1;
};

// Reads columns and units into the table.
Head read_head(CsvTable& table, std::string_view text, const CsvFormat& format, FaultList& faults) {
  Head head;
  Scanner lines(text, '\n');
  find_header(lines, text, table.file, format);
  table.header_line = lines.line();
  const std::size_t header = lines.position();
  head.header = lines.take_line();
  for (std::size_t i = 1; i < format.header_rows && !lines.at_end(); ++i)
    lines.take_line();
  if (format.units_row) {
    skip_blank_lines(lines, text);
    lines.take_line();
  }
  head.delimiter = format.delimiter ? format.delimiter
                                    : find_delimiter(head.header, line_at(text, lines.position()),
                                                     format.decimal);
  table.above = conditions_in(text.substr(0, header), format);
  Scanner scanner(text, head.delimiter);
  while (scanner.position() < header) {
    const std::string_view line = line_at(text, scanner.position());
    if (!is_blank(line, 0)) {
      Scanner cells(line, head.delimiter);
      table.over = read_names(cells);
    }
    scanner.take_line();
  }
  head.begin = header;
  table.form =
      fmt::format("text, cells by {}", head.delimiter == '\t'  ? "tabs"
                                       : head.delimiter == ' ' ? "blanks"
                                                               : std::string(1, head.delimiter));
  if (!read_header(table, scanner, format)) {
    head.header = {};
    head.end = header;
    head.end_line = table.header_line;
    return head;
  }
  if (format.units_row && !scanner.at_end()) {
    read_units(table, scanner, text, format, faults);
    skip_words_below_units(table, scanner, text, format);
  }
  head.end = scanner.position();
  head.end_line = scanner.line();
  return head;
}

// Limits the estimate by the fact that a row has at least one character per column, however short
// the first line is.
void reserve_rows(CsvTable& table, std::string_view rows_text, std::size_t whole_bytes) {
  const std::size_t estimate = std::min(whole_bytes / (line_at(rows_text, 0).size() + 1),
                                        whole_bytes / table.columns.size()) +
                               16;
  for (CsvColumn& column : table.columns)
    column.numbers.reserve(estimate);
  table.line.reserve(estimate);
}

} // namespace

std::size_t CsvTexts::first_from(std::size_t row) const {
  const auto is_before = [](const Cell& cell, std::size_t other) { return cell.row < other; };
  return static_cast<std::size_t>(std::lower_bound(cells_.begin(), cells_.end(), row, is_before) -
                                  cells_.begin());
}

void CsvTexts::push_back(const Text& cell) {
  constexpr std::size_t most_known = 4096; // a column of time stamps has no repeated texts
  const auto column = static_cast<std::uint32_t>(cell.column);
  if (!empty() && back().text == cell.text) {
    cells_.push_back({cell.row, column, cells_.back().word});
    return;
  }
  auto word = static_cast<std::uint32_t>(words_.size());
  if (const auto found = known_.find(cell.text); found != known_.end())
    word = found->second;
  else if (known_.size() < most_known)
    known_.emplace(cell.text, word);
  if (word == words_.size()) words_.push_back(cell.text);
  cells_.push_back({cell.row, column, word});
}

CsvTable parse_csv(std::string_view text, const std::string& file, const CsvFormat& format,
                   FaultList& faults) {
  CsvTable table;
  table.file = file;
  const std::optional<std::string> wide = from_utf16(text);
  if (wide) text = *wide;
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  if (without_footer(text, 0).empty()) throw InputError({file, 0, 0}, "the file is empty");
  check_text(text, file);
  std::string unix_lines;
  text = without_footer(with_unix_lines(text, unix_lines), format.skip_footer);
  const Head head = read_head(table, text, format, faults);
  const std::string_view rows = text.substr(std::min(head.end, text.size()));
  reserve_rows(table, rows, text.size());
  Scanner scanner(rows, head.delimiter, head.end_line);
  read_rows(table, scanner, rows, head.header, text.substr(0, head.begin), format, faults);
  table.notes = notes_of(table.passed_over);
  table.counts = counts_of(table.passed_over);
  fill_down(table, format);
  if (table.rows() == 0 && faults.empty())
    throw InputError({file, table.header_line, 0}, "there are no rows below the header");
  return table;
}

// ---- pieces ----

namespace {

constexpr std::size_t pieces_at_once = 8; // parsed in parallel
// must contain the header and the row below it
constexpr std::size_t head_bytes = std::size_t{1} << 20;

// The end of the last line that ends outside quotes; npos if there is none. A piece starts outside
// quotes.
std::size_t last_line_end(std::string_view text) {
  if (text.find('"') == text.npos) {
    const std::size_t end = text.rfind('\n');
    return end == text.npos ? text.npos : end + 1;
  }
  std::size_t end = text.npos;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == '\n' && !quoted) end = i + 1;
  }
  return end;
}

std::size_t lines_in(std::string_view text) {
  std::size_t lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  for (std::size_t at = text.find('\r'); at != text.npos; at = text.find('\r', at + 1))
    lines += is_lone_return(text, at);
  return lines;
}

} // namespace

struct CsvPieces::Data {
  std::unique_ptr<std::istream> in;
  CsvFormat format;
  std::size_t piece_bytes = 0;
  CsvTable header;
  std::string header_line;
  char delimiter = ',';
  std::string rest;     // read but not yet in a piece
  std::size_t line = 1; // line number in the file at which `rest` begins
  CsvPassedOver passed_over;
  std::string whole_because;
  bool rows = false, ended = false;

  // The text of the next piece; empty at the end.
  std::string piece() {
    for (std::size_t wanted = piece_bytes;; wanted *= 2) { // until a line ends in it
      if (rest.size() < wanted) read_more(wanted - rest.size());
      const bool is_last = !*in && rest.size() <= wanted;
      const std::size_t end =
          is_last ? rest.size() : last_line_end(std::string_view(rest).substr(0, wanted));
      if (end == rest.npos) continue;
      std::string text = rest.substr(0, end);
      rest.erase(0, end);
      check_text(text, header.file);
      return text;
    }
  }

  void read_more(std::size_t bytes) {
    const std::size_t had = rest.size();
    rest.resize(had + bytes);
    in->read(rest.data() + had, static_cast<std::streamsize>(bytes));
    rest.resize(had + static_cast<std::size_t>(in->gcount()));
  }

  CsvTable parsed(std::string_view piece, std::size_t first_line, FaultList& faults) const {
    CsvTable table = header;
    std::string unix_lines;
    const std::string_view text = with_unix_lines(piece, unix_lines);
    reserve_rows(table, text, text.size());
    Scanner scanner(text, delimiter, first_line);
    read_rows(table, scanner, text, header_line, {}, format, faults);
    return table;
  }

  // Continues the intervals and the counts of skipped lines from piece to piece.
  void number(CsvTable& table) {
    for (std::size_t& interval : table.interval)
      interval += passed_over.headers;
    passed_over.headers += table.passed_over.headers;
    passed_over.in_front += table.passed_over.in_front;
    passed_over.delimiters_alone += table.passed_over.delimiters_alone;
    rows = rows || table.rows() > 0;
  }
};

CsvPieces::CsvPieces(std::unique_ptr<std::istream> in, const std::string& named,
                     const CsvFormat& format, std::size_t piece_bytes)
    : data_(std::make_unique<Data>()) {
  Data& d = *data_;
  d.in = std::move(in);
  d.format = format;
  d.piece_bytes = piece_bytes;
  d.header.file = named;
  d.read_more(std::max(head_bytes, piece_bytes));
  if (d.rest.starts_with("\xFF\xFE") || d.rest.starts_with("\xFE\xFF"))
    d.whole_because = "it is in UTF-16";
  else if (format.skip_footer > 0)
    d.whole_because = "skip_footer counts from its end";
  else if (format.segments)
    d.whole_because = "it is cut into segments";
  else if (!format.fill_down.empty())
    d.whole_because = "fill_down takes values from the rows above";
  else if (*d.in && d.rest.find('\n') == std::string::npos)
    d.whole_because = "its lines end with CR alone";
  if (!d.whole_because.empty()) return;
  if (d.rest.starts_with("\xEF\xBB\xBF")) d.rest.erase(0, 3);
  if (without_footer(d.rest, 0).empty()) throw InputError({named, 0, 0}, "the file is empty");
  check_text(d.rest, named);
  std::string unix_lines;
  FaultList faults;
  const Head head = read_head(d.header, with_unix_lines(d.rest, unix_lines), format, faults);
  faults.throw_if_any();
  d.header_line = head.header;
  d.delimiter = head.delimiter;
  d.line = head.end_line;
  d.rest.erase(0, head.end);
  d.passed_over.below_units = d.header.passed_over.below_units;
}

CsvPieces::~CsvPieces() = default;

const std::string& CsvPieces::whole_because() const {
  return data_->whole_because;
}

std::vector<CsvTable> CsvPieces::next(FaultList& faults) {
  Data& d = *data_;
  std::vector<std::string> texts;
  std::vector<std::size_t> first_line;
  while (texts.size() < pieces_at_once && !d.ended) {
    texts.push_back(d.piece());
    first_line.push_back(d.line);
    d.line += lines_in(texts.back());
    d.ended = !*d.in && d.rest.empty();
  }
  std::vector<CsvTable> tables(texts.size());
  std::vector<FaultList> told(texts.size());
  parallel_for(texts.size(), [&](std::size_t i) {
    tables[i] = d.parsed(texts[i], first_line[i], told[i]);
    std::string().swap(texts[i]);
  });
  for (std::size_t i = 0; i < tables.size(); ++i) {
    d.number(tables[i]);
    for (const Fault& fault : told[i].all())
      faults.add(fault.place, fault.what, fault.hint);
  }
  if (!tables.empty() && d.ended) tables.back().counts = counts_of(d.passed_over);
  if (d.ended && !d.rows && faults.empty())
    throw InputError({d.header.file, d.header.header_line, 0},
                     "there are no rows below the header");
  return tables;
}

void reserve(CsvTable& table, std::size_t rows) {
  for (CsvColumn& column : table.columns) {
    column.numbers.reserve(rows);
    if (column.texts.size() == table.rows()) column.texts.reserve(rows);
  }
  table.line.reserve(rows);
  table.interval.reserve(rows);
}

void append(CsvTable& to, CsvTable&& more) {
  const std::size_t rows = to.rows();
  if (to.columns.size() < more.columns.size()) // nameless columns that were empty so far
    for (std::size_t c = to.columns.size(); c < more.columns.size(); ++c) {
      to.columns.push_back({more.columns[c].name, more.columns[c].unit, {}, {}});
      pad(to.columns.back(), rows);
    }
  for (std::size_t c = 0; c < more.columns.size(); ++c) {
    CsvColumn &column = to.columns[c], &other = more.columns[c];
    column.numbers.insert(column.numbers.end(), other.numbers.begin(), other.numbers.end());
    for (const CsvColumn::Text& text : other.texts)
      column.texts.push_back({rows + text.row, text.text, text.column});
  }
  to.line.insert(to.line.end(), more.line.begin(), more.line.end());
  to.interval.insert(to.interval.end(), more.interval.begin(), more.interval.end());
  for (std::size_t c = more.columns.size(); c < to.columns.size(); ++c)
    pad(to.columns[c], to.rows());
  to.counts.insert(to.counts.end(), more.counts.begin(), more.counts.end());
  to.notes.insert(to.notes.end(), more.notes.begin(), more.notes.end());
}

CsvTable rows_of(const CsvTable& table, std::size_t first, std::size_t end) {
  CsvTable part;
  part.file = table.file;
  part.form = table.form;
  part.header_line = table.header_line;
  part.units_line = table.units_line;
  part.counts = table.counts;
  part.notes = table.notes;
  part.above = table.above;
  const auto cut = [&](const auto& from, auto& to) {
    if (!from.empty())
      to.assign(from.begin() + static_cast<std::ptrdiff_t>(first),
                from.begin() + static_cast<std::ptrdiff_t>(end));
  };
  for (const CsvColumn& column : table.columns) {
    CsvColumn& own = part.columns.emplace_back();
    own.name = column.name;
    own.unit = column.unit;
    cut(column.numbers, own.numbers);
    const std::size_t behind = column.texts.first_from(end);
    for (std::size_t t = column.texts.first_from(first); t < behind; ++t) {
      const CsvColumn::Text text = column.texts[t];
      own.texts.push_back({text.row - first, text.text, text.column});
    }
  }
  cut(table.line, part.line);
  cut(table.interval, part.interval);
  return part;
}

namespace {

HeaderName cut_header_name(const std::string& text, bool any_unit) {
  const auto split = [&](std::size_t at, std::size_t from, std::size_t end) -> HeaderName {
    const std::string unit(trimmed(std::string_view(text).substr(from, end - from)));
    if (at == 0 || at == text.npos || unit.empty()) return {text, ""};
    if (!any_unit && !convert(unit, unit)) return {text, ""};
    return {std::string(trimmed(std::string_view(text).substr(0, at))), unit};
  };
  if (text.empty()) return {text, ""};
  if (text.back() == ']') return split(text.rfind('['), text.rfind('[') + 1, text.size() - 1);
  if (text.back() == ')') return split(text.rfind('('), text.rfind('(') + 1, text.size() - 1);
  for (const std::string_view sign : {" / ", ", ", " in "})
    if (const std::size_t at = text.rfind(sign); at != text.npos)
      if (HeaderName found = split(at, at + sign.size(), text.size()); !found.unit.empty())
        return found;
  // "v/mm/s", as DIN 461 labels axes
  if (const std::size_t at = text.find('/');
      at != text.npos && !any_unit && !std::isdigit(static_cast<unsigned char>(text[0])))
    return split(at, at + 1, text.size());
  return {text, ""};
}

} // namespace

HeaderName read_header_name(const std::string& text) {
  return cut_header_name(text, false);
}
HeaderName split_header_name(const std::string& text) {
  return cut_header_name(text, true);
}

std::string without_brackets(std::string unit) {
  if (unit.size() >= 2 && std::string("[(").find(unit.front()) != std::string::npos &&
      std::string("])").find(unit.back()) != std::string::npos)
    return unit.substr(1, unit.size() - 2);
  return unit;
}

bool is_unit_cell(const std::string& cell) {
  const std::string unit = without_brackets(cell);
  const std::size_t digits = unit.find_first_of("0123456789");
  const bool is_numbered =
      digits != unit.npos && digits > 0 &&
      unit.find_first_not_of("0123456789", digits) == unit.npos &&
      (unit.size() > digits + 1 || unit[digits] > '4'); // no power: T01, T17, S5
  double ignored = 0;
  return !unit.empty() && !is_numbered && !read_number(unit, '.', ignored) &&
         convert(unit, unit).has_value();
}

std::vector<std::string> cells_of_line(std::string_view line, const CsvFormat& format) {
  line = trimmed(line);
  if (line.empty()) return {};
  Scanner scanner(line,
                  format.delimiter ? format.delimiter : find_delimiter(line, "", format.decimal));
  std::vector<std::string> cells = read_names(scanner);
  for (std::string& cell : cells)
    cell = to_utf8(cell);
  return cells;
}

bool is_wanted(const std::string& cell, const CsvFormat& format) {
  if (format.also_wanted && format.also_wanted(cell)) return true;
  const std::string name = read_header_name(cell).name;
  return std::any_of(format.wanted.begin(), format.wanted.end(),
                     [&](const std::string& wanted) { return wanted == cell || wanted == name; });
}

namespace {

// Spreadsheet programs compute a cell that begins so: "=cmd|...", "+SUM(...)", but not "-12 degC".
bool looks_like_spreadsheet_formula(std::string_view text) {
  if (text.size() < 2) return false;
  const auto next = static_cast<unsigned char>(text[1]);
  return text[0] == '=' || text[0] == '@' ||
         ((text[0] == '+' || text[0] == '-') && (std::isalpha(next) || next == '(' || next == '@'));
}

} // namespace

std::string csv_cell(const std::string& text) {
  const std::string shown = (looks_like_spreadsheet_formula(text) ? "'" : "") + printable(text);
  if (shown.find_first_of(",\"\r\n;\t ") == std::string::npos && !shown.empty()) return shown;
  std::string out = "\"";
  for (const char c : shown) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

} // namespace frictab::io
