// Reads a data file of any format into named columns.
#include "data/raw.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>

#include "core/text.h"
#include "data/computed.h"
#include "data/group_columns.h"
#include "data/quantity.h"
#include "data/rig_files.h"
#include "data/wide.h"
#include "data/workbooks.h"
#include "io/file_streams.h"
#include "io/hdf5.h"
#include "io/text_file.h"
#include "io/workbook.h"

namespace frictab::data {

namespace {

// Possible column names: those that the job maps, and the canonical ones.
std::vector<std::string> wanted_names(const DataOptions& options) {
  std::vector<std::string> names = {"experiment"};
  for (const Quantity& quantity : quantities())
    names.push_back(quantity.name);
  for (const auto& [canonical, source] : options.columns)
    names.insert(names.end(), source.names.begin(), source.names.end());
  return names;
}

// Names that formulas of the job use, and those of columns that are a test each.
std::function<bool(const std::string&)> wanted_by_pattern(const DataOptions& options) {
  std::optional<Pattern> tests;
  if (!options.wide.empty()) tests = test_columns(options.wide, options.wide_place);
  return [tests, formulas = names_in_formulas(options)](const std::string& name) {
    return is_named_by(formulas, name) || (tests && tests->search(name));
  };
}

bool takes_by_number_alone(const DataOptions& options) {
  const auto& columns = options.columns;
  return std::any_of(columns.begin(), columns.end(),
                     [](const auto& one) { return one.second.number > 0; }) &&
         std::all_of(columns.begin(), columns.end(),
                     [](const auto& one) { return one.second.names.empty(); });
}

std::shared_ptr<const io::CsvSegments> segments_of(const SegmentRules& rules) {
  if (rules.begins.empty()) return nullptr;
  io::CsvSegments segments{Pattern(rules.begins, rules.place), std::nullopt};
  if (!rules.ends.empty()) segments.ends = Pattern(rules.ends, rules.place);
  return std::make_shared<const io::CsvSegments>(std::move(segments));
}

} // namespace

Place row_place(const io::CsvTable& table, std::size_t row, std::size_t column) {
  if (table.header_line == 0) return {table.file, 0, 0};
  return {table.file, table.line[row], column};
}

std::string_view head_of(std::string_view text) {
  constexpr std::size_t head_bytes = 65536;
  if (text.size() <= head_bytes) return text;
  const bool wide = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  std::size_t end = text.find_last_of("\n\r", head_bytes);
  if (end == text.npos) return text;
  end += 1;
  if (wide) end += end % 2;
  return text.substr(0, end);
}

io::CsvFormat csv_format(const std::string& path, const DataOptions& options) {
  io::CsvFormat format;
  format.delimiter = options.delimiter;
  format.decimal = options.decimal;
  format.thousands = options.thousands;
  format.skip_rows = options.skip_rows;
  format.skip_footer = options.skip_footer;
  format.units_row = options.units_row;
  format.list = options.list;
  format.header = options.header.value_or(true);
  format.may_lack_header = !options.header && takes_by_number_alone(options);
  format.header_rows = options.header_rows;
  format.segments = segments_of(options.segments);
  format.fill_down = options.fill_down;
  format.text_columns = {"experiment"};
  if (const auto named_so = options.columns.find("experiment"); named_so != options.columns.end()) {
    format.text_columns = named_so->second.names;
    format.text_number = named_so->second.number;
  }
  if (const std::string column = experiment_column_of(options); !column.empty())
    format.text_columns.push_back(column);
  format.wanted = wanted_names(options);
  format.also_wanted = wanted_by_pattern(options);
  if (io::looks_like_workbook(path)) { // the dialect of io::Sheet
    format.delimiter = ',';
    format.decimal = '.';
    format.thousands = 0;
    format.sheet = true;
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
  return !unknown && bytes > large_text ? bytes : 0;
}

// Rigs write text to files called .xls, but not to these.
void check_name(const std::filesystem::path& path, const std::string& named) {
  const std::string extension = lower_case(path.extension().string());
  std::error_code unknown;
  if ((extension == ".xlsx" || extension == ".xlsm") && !io::looks_like_workbook(path) &&
      std::filesystem::exists(path, unknown))
    throw InputError({named, 0, 0}, "has the name of a workbook and is none",
                     "save it again as .xlsx; text is read under another name, as .csv");
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
  check_name(path, named);
  if (auto table = read_rig_file(path, named, options, faults)) return std::move(*table);
  if (io::looks_like_hdf5(path))
    return GroupColumns(path, named, options, faults)
        .next(std::numeric_limits<std::uint64_t>::max());
  const io::CsvFormat format = csv_format(path, options);
  if (io::looks_like_workbook(path))
    return read_sheet(path, named, options.sheets.empty() ? "" : options.sheets.front(), format,
                      faults);
  if (const std::uint64_t bytes = bytes_of_large(path); bytes > 0) {
    io::CsvPieces pieces(std::make_unique<io::InputFile>(path, named), named, format,
                         piece_of_text);
    if (pieces.whole_because().empty()) return whole_of(pieces, bytes, faults);
  }
  return io::parse_csv(io::read_text_file(path, named), named, format, faults);
}

} // namespace frictab::data
