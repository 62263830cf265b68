// Guesses how one file, or each sheet of a workbook, is read.
#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "data/computed.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/raw.h"
#include "data/rig_files.h"
#include "data/workbooks.h"
#include "guess/columns.h"
#include "guess/conditions.h"
#include "guess/dialect.h"
#include "guess/guess.h"
#include "guess/layout.h"
#include "io/hdf5.h"
#include "io/text_file.h"
#include "io/workbook.h"

namespace frictab::guess {

const Column* File::find(const std::string& canonical) const {
  for (const Column& column : columns)
    if (column.canonical == canonical) return &column;
  return nullptr;
}

bool File::is_read_as(const File& other) const {
  const auto named = [](const File& guess) {
    std::set<std::string> names;
    for (const Column& column : guess.columns)
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

std::string File::label() const {
  return sheet.empty() ? std::filesystem::path(file).stem().string() : sheet;
}

namespace {

// True if the names identify the header line: then skip_rows, which differs from file to file, is
// not needed.
bool is_found_by_names(std::string_view text, const File& guess, const io::CsvTable& table,
                       io::CsvFormat format) {
  format.skip_rows = 0;
  for (const data::Quantity& quantity : data::quantities())
    format.wanted.emplace_back(quantity.name);
  for (const Column& column : guess.columns)
    if (!column.canonical.empty() && column.number == 0)
      format.wanted.push_back(io::read_header_name(column.name).name);
  try {
    FaultList faults;
    return io::parse_csv(text, guess.file, format, faults).header_line == table.header_line;
  } catch (const InputError&) {
    return false;
  }
}

// The normal stress of Abaqus' history output, in its files' own units.
std::string pressure_of_abaqus(const File& guess) {
  const Column* const force = guess.find("F_N_N");
  if (guess.find("sigma_n_MPa") || !force || force->number > 0) return "";
  for (const Column& column : guess.columns)
    if (data::words_of_name(column.name).starts_with("carea"))
      return fmt::format("F_N_N/{}", data::name_in_formulas(column.name));
  return "";
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

// A hash of the quantities of each row; nothing if there are less than two quantities.
std::set<std::size_t> rows_of(const File& guess, const io::CsvTable& table) {
  std::vector<std::string> rows(table.rows());
  std::size_t known = 0;
  for (const Column& column : guess.columns) {
    if (!data::find_quantity(column.canonical) || column.text) continue;
    ++known;
    const std::vector<double>& values = raw_of(column, table).numbers;
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] += fmt::format("{} {};", column.canonical, shortest(values[i]));
  }
  std::set<std::size_t> seen;
  for (const std::string& row : rows)
    if (known > 1) seen.insert(std::hash<std::string>()(row));
  return seen;
}

void finish(File& guess, const io::CsvTable& table) {
  guess.missing = markers_in(table);
  find_tests_in_columns(guess);
  take_tests_side_by_side(guess, table);
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

// Guesses from a text; `cells`: the sheet of a workbook that it is from, or nullptr.
File guess_text(std::string_view whole, const std::string& named, const io::Sheet* cells) {
  const std::string_view text = data::head_of(whole);
  File guess;
  guess.file = named;
  Dialect dialect = find_dialect(text, named, cells != nullptr);
  const io::CsvFormat& format = dialect.format;
  io::CsvTable table = std::move(dialect.table);
  FaultList mixed;                    // reported when the file is read
  if (whole.find('\0') == whole.npos) // as UTF-16 has
    guess.skip_footer = footer_of(whole, table, format);
  if (guess.skip_footer > 0 && whole.size() == text.size()) {
    dialect.format.skip_footer = guess.skip_footer;
    table = io::parse_csv(text, named, format, mixed);
  }
  if (cells) data::take_cell_units(table, *cells, mixed);
  const std::string_view rest = whole.substr(text.size());
  guess.row_count =
      table.rows() + static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n'));
  guess.decimal = format.decimal;
  guess.thousands = format.thousands;
  guess.grouped = dialect.grouped;
  guess.any_decimal = dialect.any_decimal;
  guess.own_decimal = cells != nullptr;
  guess.units_row = format.units_row;
  guess.header = format.header;
  guess.header_rows = format.header_rows;
  take_intervals(guess, table);
  guess.columns = guess_columns(table);
  if (!is_found_by_names(text, guess, table, format)) guess.skip_rows = format.skip_rows;
  guess.area_mm2 = area_in(lines_before(text, table.header_line), guess.decimal);
  if (!guess.intervals) guess.titles = titles_in(text, table);
  finish(guess, table);
  return guess;
}

std::vector<File> guess_workbook(const std::string& path, const std::string& named) {
  const io::Workbook book(path, named);
  std::vector<File> guesses;
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

std::vector<File> guess_file(const std::string& path, const std::string& named) {
  if (io::looks_like_workbook(path)) return guess_workbook(path, named);
  if (!data::is_rig_file(path) && !io::looks_like_hdf5(path)) {
    const std::string text = io::read_text_file(path, named);
    return {guess_text(text, named, nullptr)};
  }
  FaultList faults;
  const io::CsvTable table = data::read_raw(path, named, {}, faults);
  File guess;
  guess.file = named;
  guess.own_decimal = true;
  take_intervals(guess, table);
  guess.columns = guess_columns(table);
  finish(guess, table);
  return {guess};
}

} // namespace frictab::guess
