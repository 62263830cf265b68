// Delimited text as rigs write it, parsed to columns of cells that are numbers where they can be.
#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/error.h"

namespace frictab::io {

struct CsvFormat {
  char delimiter = 0; // 0: found from the header line; ' ' = runs of blanks
  char decimal = '.';
  char thousands = 0;          // between groups of three digits; 0: nothing
  std::size_t skip_rows = 0;   // physical lines before the header
  std::size_t skip_footer = 0; // physical lines at the end, blank ones not counted
  bool units_row = false;
  // Columns whose cells stay text even where they are numbers ("007"): by name, or number from 1.
  std::vector<std::string> text_columns;
  std::size_t text_number = 0;
  // Names by which the header line is known: where the first line holds none of them, it is the one
  // of the next 200 that holds most.
  std::vector<std::string> wanted;
  std::function<bool(const std::string& name)> also_wanted; // other such names; empty: none
};

// The cells of a column that are no numbers, in ascending rows. Of a text column that is every
// cell: a word that comes again is held once.
class CsvTexts {
public:
  struct Text {
    std::size_t row;
    const std::string& text; // what stands there, in UTF-8; empty where the cell is empty
    std::size_t column = 0;  // of its first byte in its line, from 1; 0 = unknown
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
  std::size_t first_from(std::size_t row) const; // size() where there is none
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
  std::unordered_map<std::string, std::uint32_t> known_; // of them the first few thousand
};

// One column of a file. A cell that is no number is NaN in `numbers` and listed in `texts`.
struct CsvColumn {
  std::string name;
  std::string unit; // of the units row, else empty
  std::vector<double> numbers;
  using Text = CsvTexts::Text;
  CsvTexts texts;
};

// Lines that are no rows and no faults.
struct CsvPassedOver {
  std::size_t headers = 0;  // the header line again
  std::size_t in_front = 0; // lines in front of it
  std::size_t delimiters_alone = 0;
};

struct CsvTable {
  std::string file; // as messages call it
  std::size_t header_line = 0;
  std::vector<CsvColumn> columns;
  std::vector<std::size_t> line;     // physical line of each row
  std::vector<std::size_t> interval; // of each row: how many header lines came again before it
  CsvPassedOver passed_over;
  std::vector<std::string> notes; // what was passed over: "the header line comes again 3 times"
  std::size_t rows() const { return line.size(); }
};

// Handles UTF-8 and UTF-16 with a BOM, Latin-1 names and texts, CRLF and CR line ends, quoted cells
// with delimiters and line breaks inside, lines that are blank or hold delimiters alone, empty
// column names (columns behind the last name that hold nothing are left out), delimiters behind the
// last cell. Where the header line comes again a new interval
// starts; lines in front of it that are no rows belong to it. Other ragged rows (once per number of
// cells, with their count) and an unclosed quote are added to `faults`; they are left out of the
// result (the caller throws). Throws InputError where there is no header or no row.
CsvTable parse_csv(std::string_view text, const std::string& file, const CsvFormat& format,
                   FaultList& faults);

// A CSV file too large to be held, a few megabytes at a time: each piece ends with a line and is
// read below the file's own header. What a piece holds does not depend on the number of threads.
class CsvPieces {
public:
  // Throws InputError as parse_csv does of the header and of what is no text.
  CsvPieces(std::unique_ptr<std::istream> in, const std::string& named, const CsvFormat& format,
            std::size_t piece_bytes);
  ~CsvPieces();
  CsvPieces(const CsvPieces&) = delete;
  CsvPieces& operator=(const CsvPieces&) = delete;

  // Why the file can only be read as a whole; empty: it can be read in pieces. UTF-16, a footer.
  const std::string& whole_because() const;
  // The next few pieces, parsed on all cores; empty behind the last one. Rows are numbered from 0
  // in each; lines are those of the file. `notes` are told with the last one, of all.
  std::vector<CsvTable> next(FaultList& faults);

  // A table without rows: the columns and their units.
  const CsvTable& header() const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Makes room for so many rows.
void reserve(CsvTable& table, std::size_t rows);
// Adds the rows of `more`, of the same file.
void append(CsvTable& to, CsvTable&& more);
// Rows first .. end-1.
CsvTable rows_of(const CsvTable& table, std::size_t first, std::size_t end);

// "Normal force [kN]", "F_R (N)", "T / degC", "Speed, mm/s" as name and unit; the whole name and no
// unit where what stands there is none that is known (core/units.h).
struct HeaderName {
  std::string name, unit;
};
HeaderName read_header_name(const std::string& text);
// The same whether or not the unit is known: "sigma_f_MPa [Mpa]" as sigma_f_MPa and Mpa.
HeaderName split_header_name(const std::string& text);

// "[kN]" and "(kN)" of a units row as kN.
std::string without_brackets(std::string unit);

// A text as the cell of a file with commas: quoted where it must be.
std::string csv_cell(const std::string& text);

} // namespace frictab::io
