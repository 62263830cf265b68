// Reads a data file of any format into named columns.
#include "data/raw.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "core/program.h"
#include "core/text.h"
#include "data/hdf5_columns.h"
#include "data/quantity.h"
#include "data/wide.h"
#include "io/atomic_file.h"
#include "io/hdf5.h"
#include "io/text_file.h"

namespace frictab::data {

namespace {

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);
}

// A sheet as CSV, with numbers as stored, independent of their display format.
std::string sheet_text(const std::string& path, const std::string& named,
                       const std::string& sheet) {
  const std::string tool = "xlsx2csv";
  if (!have_program(tool))
    throw InputError({named, 0, 0}, "is a workbook, and xlsx2csv is not installed",
                     "install the package xlsx2csv, or save the sheet as CSV");
  const TemporaryDirectory work;
  const std::string out = (work.path() / "sheet.csv").string();
  std::vector<std::string> command = {tool, "--ignore-formats", "float", "-d", ","};
  if (!sheet.empty()) command.insert(command.end(), {"-n", sheet});
  command.insert(command.end(), {"--", path, out});
  try {
    run_program(command, work.path() / "log");
  } catch (const std::runtime_error& error) {
    const std::string said = error.what(); // the command, then the program's output
    throw InputError({named, 0, 0},
                     sheet.empty() ? "is not a workbook that xlsx2csv can read"
                                   : fmt::format("holds no sheet '{}' that can be read", sheet),
                     "xlsx2csv says: " + last_line(said));
  }
  return io::read_file(out);
}

// Possible column names: those that the job maps, and the canonical ones.
std::vector<std::string> wanted_names(const DataOptions& options) {
  std::vector<std::string> names = {"experiment"};
  for (const Quantity& quantity : quantities())
    names.push_back(quantity.name);
  for (const auto& [canonical, source] : options.columns)
    names.insert(names.end(), source.names.begin(), source.names.end());
  return names;
}

} // namespace

bool is_workbook(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string()) == ".xlsx";
}

std::string raw_text(const std::string& path, const std::string& named, const std::string& sheet) {
  return is_workbook(path) ? sheet_text(path, named, sheet) : io::read_text_file(path, named);
}

Place row_place(const io::CsvTable& table, std::size_t row, std::size_t column) {
  if (table.header_line == 0) return {table.file, 0, 0};
  return {table.file, table.line[row], column};
}

io::CsvFormat csv_format(const std::string& path, const DataOptions& options) {
  io::CsvFormat format;
  format.delimiter = options.delimiter;
  format.decimal = options.decimal;
  format.thousands = options.thousands;
  format.skip_rows = options.skip_rows;
  format.skip_footer = options.skip_footer;
  format.units_row = options.units_row;
  format.text_columns = {"experiment"};
  if (const auto named_so = options.columns.find("experiment"); named_so != options.columns.end()) {
    format.text_columns = named_so->second.names;
    format.text_number = named_so->second.number;
  }
  if (const std::string column = experiment_column_of(options); !column.empty())
    format.text_columns.push_back(column);
  format.wanted = wanted_names(options);
  if (!options.wide.empty())
    format.also_wanted = [tests = test_columns(options.wide, options.wide_place)](
                             const std::string& name) { return tests.search(name).has_value(); };
  if (is_workbook(path)) { // the dialect of xlsx2csv
    format.delimiter = ',';
    format.decimal = '.';
    format.thousands = 0;
  }
  return format;
}

namespace {

// Larger text is not kept in memory together with its numbers; it is read in pieces of this size.
constexpr std::uint64_t large_text = std::uint64_t{32} << 20,
                        piece_of_text = std::uint64_t{1} << 20;

// Returns 0 if the file is read in one piece.
std::uint64_t bytes_of_large(const std::string& path) {
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(path, unknown);
  return !unknown && !is_workbook(path) && bytes > large_text ? bytes : 0;
}

io::CsvTable whole_of(io::CsvPieces& pieces, std::uint64_t bytes, FaultList& faults) {
  io::CsvTable table;
  for (auto next = pieces.next(faults); !next.empty(); next = pieces.next(faults))
    for (io::CsvTable& piece : next)
      if (table.columns.empty()) {
        table = std::move(piece); // later pieces have the same size to within a tenth
        io::reserve(table, (bytes + bytes / 10) / piece_of_text * table.rows());
      } else {
        io::append(table, std::move(piece));
      }
  return table;
}

} // namespace

io::CsvTable read_raw(const std::string& path, const std::string& named, const DataOptions& options,
                      FaultList& faults) {
  if (io::looks_like_hdf5(path))
    return Hdf5Columns(path, named, options, faults)
        .next(std::numeric_limits<std::uint64_t>::max());
  const io::CsvFormat format = csv_format(path, options);
  if (const std::uint64_t bytes = bytes_of_large(path); bytes > 0) {
    io::CsvPieces pieces(std::make_unique<std::ifstream>(io::open_text_file(path, named)), named,
                         format, piece_of_text);
    if (pieces.whole_because().empty()) return whole_of(pieces, bytes, faults);
  }
  return io::parse_csv(raw_text(path, named, options.sheet), named, format, faults);
}

} // namespace frictab::data
