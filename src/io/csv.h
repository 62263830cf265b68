// Delimited text from rigs, parsed to columns of cells that are numbers if possible.
#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/error.h"
#include "core/pattern.h"

namespace frictab::io {

// Lines that open and close a run of rows, as testing machines write steps. Named groups of
// `begins` become columns of the run's rows; its rows are one interval.
struct CsvSegments {
  Pattern begins;
  std::optional<Pattern> ends; // none: a run ends where the next begins
};

struct CsvFormat {
  // Delimiter; 0: detected from the header line; ' ' = runs of blanks
  char delimiter = 0;
  char decimal = '.';
  char thousands = 0;          // between groups of three digits; 0: none
  std::size_t skip_rows = 0;   // physical lines before the header
  std::size_t skip_footer = 0; // physical lines at the end, not counting blank ones
  bool units_row = false;
  bool header = true;           // false: no line of names; columns are column_1, column_2, ...
  bool may_lack_header = false; // the same for a file whose header line would be numbers
  std::size_t header_rows = 1;  // lines of names; those of a column are joined by blanks
  bool sheet =
      false; // the text of a sheet, in which rows lack the cells that are empty at their end
  bool list = false; // a row per test: texts between and below its rows are remarks
  std::shared_ptr<const CsvSegments> segments; // none: all lines below the header may be rows
  // Columns, with or without their unit, whose empty cells have the value of the cell above.
  std::vector<std::string> fill_down;
  // Columns whose cells stay text even if they are numbers ("007"): by name, or by number from 1.
  std::vector<std::string> text_columns;
  std::size_t text_number = 0;
  // Names that identify the header line: if the first line contains none of them, the header is the
  // one of the next 200 lines that contains most.
  std::vector<std::string> wanted;
  std::function<bool(const std::string& name)> also_wanted; // further such names; empty: none
};

// The non-numeric cells of a column, in ascending rows; for a text column these are all cells.
// Repeated words are stored once.
class CsvTexts {
public:
  struct Text {
    std::size_t row;
    const std::string& text; // cell text in UTF-8; empty for an empty cell
    // Column of its first byte in its line, from 1; 0 = unknown.
    std::size_t column = 0;
  };
  struct Iterator {
    using iterator_category = std::input_iterator_tag;
    using value_type = Text;
    using difference_type = std::ptrdiff_t;
    using pointer = const Text*;
    using reference = Text;
    const CsvTexts* texts;
    std::size_t at;
    Text operator*() const { return (*texts)[at]; }
    Iterator& operator++() { return ++at, *this; }
    bool operator==(const Iterator&) const = default;
  };

  std::size_t size() const { return cells_.size(); }
  bool empty() const { return cells_.empty(); }
  Text operator[](std::size_t i) const {
    return {cells_[i].row, words_[cells_[i].word], cells_[i].column};
  }
  Text back() const { return (*this)[size() - 1]; }
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size()}; }
  std::size_t first_from(std::size_t row) const; // size() if there is none
  void push_back(const Text& cell);
  void pop_back() { cells_.pop_back(); }
  void reserve(std::size_t cells) { cells_.reserve(cells); }

private:
  struct Cell {
    std::size_t row;
    std::uint32_t column, word;
  };
  std::vector<Cell> cells_;
  std::vector<std::string> words_;
  std::unordered_map<std::string, std::uint32_t> known_; // index of the first few thousand words
};

// One column of a file. A non-numeric cell is NaN in `numbers` and listed in `texts`.
struct CsvColumn {
  std::string name;
  std::string unit; // from the units row, else empty
  std::vector<double> numbers;
  using Text = CsvTexts::Text;
  CsvTexts texts;
};

// Numbers of skipped lines that are not faults.
struct CsvPassedOver {
  std::size_t headers = 0;  // repeated header lines
  std::size_t in_front = 0; // lines just before a repeated header
  std::size_t delimiters_alone = 0;
  std::size_t below_units = 0; // lines of words between the units and the first row
  std::size_t segments = 0, outside_segments = 0; // runs, and lines outside them
  std::size_t rows_outside = 0;                   // of the latter, those that hold numbers as rows
  std::size_t remarks = 0;                        // lines of one text below the last row of a sheet
  std::size_t of_lists = 0;                       // lines of a list that are not rows
};

// A note with a count that files add up: "the header line comes again 3 times".
struct CsvCount {
  std::string before, after; // the text around the count
  std::size_t count = 0;
};

// A line above the header that gives a condition: "Normal load: 5 N", "Probe;C45".
struct CsvAbove {
  std::string name, value;
};

struct CsvTable {
  std::string file;              // name in messages
  std::string form;              // "text, cells by ;"
  std::size_t header_line = 0;   // of a file without a header the first row; 0 for other formats
  std::size_t units_line = 0;    // 0: none
  std::vector<CsvAbove> above;   // in the order of the lines, each name once
  std::vector<std::string> over; // cells of the line just above the header
  std::vector<CsvColumn> columns;
  std::vector<std::size_t> line;     // physical line of each row
  std::vector<std::size_t> interval; // number of repeated header lines, or of runs, before each row
  CsvPassedOver passed_over;
  std::vector<CsvCount> counts; // lines that are not rows, and cells that are filled
  std::vector<std::string> notes;
  std::size_t rows() const { return line.size(); }
};

// Parses CSV text. Accepts UTF-8 and UTF-16 with a BOM, Latin-1 names and texts, CRLF and CR line
// ends, quoted cells with delimiters and line breaks inside, lines that are blank or contain only
// delimiters, empty column names (columns after the last name are left out if empty), and
// delimiters after the last cell. A repeated header line starts a new interval and takes the ragged
// lines just before it with it. Other ragged rows (once per number of cells, with their count) and
// an unclosed quote are added to `faults` and left out of the result (the caller throws). Throws
// InputError without a header or without rows.
CsvTable parse_csv(std::string_view text, const std::string& file, const CsvFormat& format,
                   FaultList& faults);

// A CSV file larger than memory, read a few megabytes at a time: each piece ends with a line and is
// parsed under the file's own header. The contents of a piece do not depend on the number of
// threads.
class CsvPieces {
public:
  // Throws InputError for a bad header and for data that are not text, as parse_csv does.
  CsvPieces(std::unique_ptr<std::istream> in, const std::string& named, const CsvFormat& format,
            std::size_t piece_bytes);
  ~CsvPieces();
  CsvPieces(const CsvPieces&) = delete;
  CsvPieces& operator=(const CsvPieces&) = delete;

  // Reason why the file can only be read as a whole (UTF-16, a footer); empty if it can be read in
  // pieces.
  const std::string& whole_because() const;
  // The next few pieces, parsed on all cores; empty after the last one. Row numbers start at 0 in
  // each piece; line numbers are those of the file. Only the last piece has `notes`, which cover
  // the whole file.
  std::vector<CsvTable> next(FaultList& faults);

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Reserves memory for this number of rows.
void reserve(CsvTable& table, std::size_t rows);
// Appends the rows of `more`, which comes from the same file.
void append(CsvTable& to, CsvTable&& more);
// Copies rows first .. end-1.
CsvTable rows_of(const CsvTable& table, std::size_t first, std::size_t end);

// "Normal force [kN]", "F_R (N)", "T / degC", "Speed, mm/s", "v/mm/s", "Zeit in s" split into name
// and unit; the whole name and no unit if the suffix is not a known unit (core/units.h).
struct HeaderName {
  std::string name, unit;
};
HeaderName read_header_name(const std::string& text);
// Splits also with an unknown unit: "sigma_f_MPa [Mpa]" into sigma_f_MPa and Mpa.
HeaderName split_header_name(const std::string& text);

// Strips the brackets of a units row: "[kN]" and "(kN)" give kN.
std::string without_brackets(std::string unit);
// True for a cell of a units row: a known unit, and not the name of a test, as the tesla of T17.
bool is_unit_cell(const std::string& cell);

// The cells of one line, trimmed, in UTF-8; the delimiter is found in it if the format has none.
std::vector<std::string> cells_of_line(std::string_view line, const CsvFormat& format);

// True if a header cell is one of the names that identify the header, with or without its unit.
bool is_wanted(const std::string& cell, const CsvFormat& format);

// Text as a cell of a comma-separated file, quoted if necessary. Control characters become \x1b and
// the like; an apostrophe goes before what a spreadsheet program would compute.
std::string csv_cell(const std::string& text);

} // namespace frictab::io
