// Expands one row per experiment to one value per row.
#include "data/test_table.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/file_list.h"
#include "data/list_of_tests.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/workbooks.h"
#include "io/workbook.h"

namespace frictab::data {

namespace {

// Takes mapped columns that the table has from it, and leaves all others to the data files.
DataOptions take_over(DataOptions& options, const io::CsvTable& raw) {
  const auto is_here = [&](const std::string& name) {
    return std::any_of(raw.columns.begin(), raw.columns.end(), [&](const io::CsvColumn& column) {
      return column.name == name || io::read_header_name(column.name).name == name;
    });
  };
  DataOptions own = options;
  own.constants.clear();
  own.bystanders.reset();
  own.experiment.clear();
  own.above.clear();
  for (const auto& [canonical, from] : options.columns)
    if (from.number > 0 || std::none_of(from.names.begin(), from.names.end(), is_here))
      own.columns.erase(canonical);
  for (const auto& [canonical, from] : own.columns)
    if (canonical != "experiment") options.columns.erase(canonical);
  return own;
}

// The letters of a name without words that every test may have: "al" of "Al_1", "" of "Versuch 1".
std::string own_words(const std::string& name) {
  static const std::set<std::string> common = {
      "test", "versuch", "probe",  "sample", "specimen", "run",     "exp",         "experiment",
      "no",   "nr",      "number", "nummer", "id",       "messung", "measurement", "file",
      "data", "t",       "v",      "p",      "e",        "s"};
  std::string letters, out;
  for (const char c : words_of_name(name) + " ")
    if (c != ' ' && !std::isdigit(static_cast<unsigned char>(c))) {
      letters += c;
    } else {
      if (common.count(letters) == 0) out += letters;
      letters.clear();
    }
  return out;
}

} // namespace

long first_number(const std::string& name) {
  constexpr const char* digits = "0123456789";
  constexpr std::size_t most_digits = 9;
  const std::size_t begin = name.find_first_of(digits);
  if (begin == name.npos) return -1;
  const std::size_t end = std::min(name.find_first_not_of(digits, begin), name.size());
  return end - begin > most_digits ? -1 : std::stol(name.substr(begin, end - begin));
}

bool is_same_test(const std::string& a, const std::string& b) {
  const long number = first_number(a);
  if (number < 0 || number != first_number(b)) return false;
  const std::string one = own_words(a), other = own_words(b);
  return one.empty() || other.empty() || one.starts_with(other) || other.starts_with(one);
}

std::string test_key(const std::string& name) {
  std::string stem = name.substr(name.find_last_of("/\\") + 1);
  constexpr std::size_t most = 6; // of an extension with its point
  const std::size_t point = stem.find_last_of('.');
  if (point != stem.npos && point > 0 && stem.size() - point <= most &&
      std::all_of(stem.begin() + static_cast<long>(point) + 1, stem.end(),
                  [](unsigned char c) { return std::isalnum(c) != 0; }) &&
      point + 1 < stem.size() && std::isalpha(static_cast<unsigned char>(stem[point + 1])))
    stem.resize(point);
  std::string key;
  for (const char c : lower_case(stem)) {
    const bool is_zero_in_front =
        !key.empty() && key.back() == '0' && std::isdigit(static_cast<unsigned char>(c)) &&
        (key.size() < 2 || !std::isdigit(static_cast<unsigned char>(key[key.size() - 2])));
    if (is_zero_in_front) key.pop_back();
    key += c;
  }
  return key;
}

const std::string* TestTable::name_of(const std::string& experiment) const {
  if (const auto own = row.find(experiment); own != row.end()) return &own->first;
  if (const auto own = by_key.find(test_key(experiment)); own != by_key.end()) return &own->second;
  const auto other = numbered.find(first_number(experiment));
  return other != numbered.end() && is_same_test(experiment, other->second) ? &other->second
                                                                            : nullptr;
}

namespace {

// Name of a test in the table: of its file if it is an interval, else its own.
const std::string& filed_as(const Dataset& data, std::size_t test) {
  const bool is_interval = test < data.filed.size() && data.filed[test].interval;
  return is_interval ? data.filed[test].file : data.experiments[test];
}

} // namespace

const std::string* TestTable::name_of(const Dataset& data, std::size_t test) const {
  if (const auto own = row.find(data.experiments[test]); own != row.end()) return &own->first;
  return name_of(filed_as(data, test));
}

void check_numbered(const TestTable& table, const Dataset& data) {
  std::map<std::string, std::size_t> known; // first test by the table's name
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::string* const name = table.name_of(data, e);
    if (!name) continue;
    const auto [first, is_new] = known.emplace(*name, e);
    if (!is_new && filed_as(data, first->second) != filed_as(data, e))
      throw InputError({table.file, table.header_line, 0},
                       fmt::format("tests '{}' and '{}' would both be '{}' of this table",
                                   data.experiments[first->second], data.experiments[e], *name),
                       "name the tests as the files are called");
  }
}

namespace {

// The table as the file has it.
io::CsvTable read_cells(const DataOptions& options, FaultList& faults) {
  const auto path = std::filesystem::path(options.base) / options.tests;
  DataOptions dialect = options;
  dialect.skip_rows = dialect.skip_footer = 0;
  dialect.units_row = false;
  dialect.list = true;
  take_dialect_of_tests(dialect);
  std::string named = options.tests;
  if (io::looks_like_workbook(path)) {
    dialect.sheets = {sheet_of_tests(path.string(), options.tests, options)};
    named += "/" + dialect.sheets.front();
  }
  return read_raw(path.string(), named, dialect, faults);
}

// Keeps the name of each test in `by_key` and `numbered` where no other test shares it.
void index_names(TestTable& table) {
  std::map<long, std::size_t> names_with;
  std::map<std::string, std::size_t> names_of;
  for (const auto& [name, at] : table.row) {
    ++names_with[first_number(name)];
    ++names_of[test_key(name)];
  }
  for (const auto& [name, at] : table.row) {
    if (const long number = first_number(name); number >= 0 && names_with[number] == 1)
      table.numbered.emplace(number, name);
    if (const std::string key = test_key(name); names_of[key] == 1) table.by_key.emplace(key, name);
  }
}

} // namespace

TestTable read_test_table(DataOptions& options) {
  TestTable table;
  table.file = options.tests;
  FaultList faults;
  io::CsvTable raw = list_of_tests(read_cells(options, faults));
  table.header_line = raw.header_line;
  table.columns = map_columns(raw, ReadRequest(take_over(options, raw)), "", faults);
  FaultsByCause causes;
  for (MappedFile::CellFault& cell : table.columns.cell_faults)
    causes.add(cell.cause, std::move(cell.fault));
  causes.tell(faults, "cell");
  if (table.columns.experiment.empty())
    faults.add({options.tests, raw.header_line, 0}, "there is no column experiment",
               "a table of tests names each test as the data files do; [data.columns] experiment "
               "may give the column's own name");
  for (std::size_t i = 0; i < table.columns.experiment.size(); ++i)
    if (const auto [found, is_new] = table.row.emplace(table.columns.experiment[i], i); !is_new)
      faults.add(row_place(raw, i), fmt::format("test '{}' stands here again", found->first),
                 fmt::format("it stands in line {} already", raw.line[found->second]));
  faults.throw_if_any();
  index_names(table);
  return table;
}

void add_test_columns(Part& part, const TestTable& table) {
  const Dataset& data = part.data;
  std::vector<std::size_t> row; // row of the table for each experiment
  std::vector<std::string> missing, known;
  bool by_key = false, by_number = false, by_file = false;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::string& name = data.experiments[e];
    const std::string* const found = table.name_of(data, e);
    row.push_back(found ? table.row.at(*found) : 0);
    if (!found) missing.push_back(name);
    if (!found || *found == name) continue;
    if (test_key(*found) == test_key(name)) {
      by_key = true;
      continue;
    }
    (filed_as(data, e) == name ? by_number : by_file) = true;
    by_number = by_number || test_key(*found) != test_key(filed_as(data, e));
  }
  for (const auto& [name, at] : table.row)
    known.push_back(name);
  for (const std::string& name : missing)
    part.faults.add({table.file, table.header_line, 0},
                    fmt::format("test '{}' of {} is not in this table", name, part.raw.file),
                    "add a row for it (a cell may be empty); " + suggest(name, known));
  if (!missing.empty()) return;
  if (by_key)
    part.data.notes.push_back(table.file + ": tests are found by the names of their files");
  if (by_number)
    part.data.notes.push_back(table.file + ": tests are found by the numbers in their names");
  if (by_file)
    part.data.notes.push_back(table.file + ": a row holds for all intervals of its file");
  std::set<std::string> there;
  for (const Column& column : part.data.columns)
    there.insert(column.name);
  std::vector<std::string> names;
  for (const Column& column : table.columns.columns) {
    if (there.count(column.name) > 0) {
      part.faults.add({table.file, table.header_line, 0},
                      fmt::format("column {} is in {} as well", column.name, part.raw.file),
                      "keep one of the two");
      continue;
    }
    Column out{column.name, column.unit, std::vector<double>(data.rows()), column.levels};
    for (std::size_t e = 0; e < row.size(); ++e)
      std::fill(out.values.begin() + static_cast<long>(data.first_row[e]),
                out.values.begin() + static_cast<long>(data.first_row[e + 1]),
                column.values[row[e]]);
    names.push_back(column.name);
    part.data.columns.push_back(std::move(out));
  }
  part.data.notes.push_back(fmt::format("{}: {}, by test", table.file, join(names, ", ")));
  for (const std::string& note : table.columns.notes)
    part.data.notes.push_back(fmt::format("{}: {}", table.file, note));
}

} // namespace frictab::data
