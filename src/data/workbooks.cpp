// Tries each sheet by the job's names of columns.
#include "data/workbooks.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/os/files.h"
#include "core/text.h"
#include "data/computed.h"
#include "data/quantity.h"
#include "data/raw.h"
#include "io/workbook.h"

namespace frictab::data {

namespace {

// Columns of the job in one sheet.
struct SheetLook {
  std::string name;
  std::size_t wanted = 0; // columns that the job names, or with names of quantities
  bool friction = false;
  bool rows = false;
  std::set<std::string> columns; // names, with and without units
};

bool is_friction(const DataOptions& options, const std::string& column) {
  for (const char* const canonical : {"tau_R_MPa", "F_R_N"}) {
    const auto mapped = options.columns.find(canonical);
    if (mapped == options.columns.end()
            ? column == canonical
            : std::count(mapped->second.names.begin(), mapped->second.names.end(), column) > 0)
      return true;
    const auto computed = computed_from(options, column);
    if (std::find(computed.begin(), computed.end(), canonical) != computed.end()) return true;
  }
  return false;
}

SheetLook look_at(const io::Workbook& book, const std::string& sheet, const std::string& path,
                  const std::string& named, const DataOptions& options) {
  const io::CsvFormat format = csv_format(path, options);
  SheetLook look;
  look.name = sheet;
  const io::Sheet cells = book.read(sheet);
  io::CsvTable table;
  FaultList ragged;
  try {
    table = io::parse_csv(head_of(cells.text), named, format, ragged);
  } catch (const InputError&) { // a cover, a picture, remarks
    return look;
  }
  look.rows = true;
  for (const io::CsvColumn& column : table.columns) {
    const std::string bare = io::read_header_name(column.name).name;
    look.columns.insert({column.name, bare});
    look.wanted += io::is_wanted(column.name, format);
    look.friction =
        look.friction || is_friction(options, column.name) || is_friction(options, bare);
  }
  return look;
}

// All visible sheets but `without`.
std::vector<SheetLook> look_at_all(const io::Workbook& book, const std::string& path,
                                   const std::string& named, const OptionsOfSheet& of_sheet,
                                   const std::string& without = "") {
  std::vector<SheetLook> looks;
  for (const io::Workbook::Entry& one : book.sheets())
    if (!one.hidden && one.name != without)
      looks.push_back(look_at(book, one.name, path, named, of_sheet(one.name)));
  return looks;
}

std::size_t most_wanted(const std::vector<SheetLook>& looks) {
  std::size_t most = 0;
  for (const SheetLook& look : looks)
    most = std::max(most, look.wanted);
  return most;
}

// A sheet without any of the job's columns is read only if no other is there, which then reports
// them missing.
bool is_read(const SheetLook& look, const std::vector<SheetLook>& looks, bool all) {
  if (looks.size() == 1) return true;
  if (most_wanted(looks) == 0) return &look == &looks.front();
  if (all) return look.wanted > 0;
  const bool measured = std::any_of(looks.begin(), looks.end(),
                                    [](const SheetLook& other) { return other.friction; });
  return measured ? look.friction : look.wanted == most_wanted(looks);
}

std::string reason_passed(const SheetLook& look) {
  return fmt::format("'{}' ({})", look.name,
                     !look.rows         ? "no rows under a header"
                     : look.wanted == 0 ? "no column of the job"
                                        : "no column of friction");
}

bool is_pattern(const std::string& name) {
  return name.find_first_of("*?") != name.npos;
}

// Sheets by the names and patterns of the job; each must be there.
void choose_named(SheetChoice& choice, const io::Workbook& book, const std::string& named,
                  const DataOptions& options, const std::vector<SheetLook>& looks) {
  std::vector<std::string> names;
  std::set<std::string> chosen;
  for (const io::Workbook::Entry& one : book.sheets())
    names.push_back(one.name);
  for (const std::string& wish : options.sheets) {
    bool found = false;
    for (const std::string& name : names) {
      if (wish != name && !(is_pattern(wish) && os::is_like(name, wish))) continue;
      found = true;
      const auto look = std::find_if(looks.begin(), looks.end(),
                                     [&](const SheetLook& one) { return one.name == name; });
      if (wish == name || (look != looks.end() && is_read(*look, looks, true))) chosen.insert(name);
    }
    if (!found)
      throw InputError({named, 0, 0}, fmt::format("holds no sheet '{}'", wish),
                       suggest(wish, names));
  }
  for (const std::string& name : names)
    if (chosen.count(name) > 0) choice.read.push_back(name);
}

io::Workbook opened(const std::string& path, const std::string& named) {
  io::Workbook book(path, named);
  if (book.sheets().empty())
    throw InputError({named, 0, 0}, "holds no sheet of cells",
                     "a workbook with the rows in a sheet, or CSV");
  return book;
}

// ---- a sheet as a table ----

// The kind that all filled cells of a column's rows share; `mixed`: a row that is of another kind.
struct ColumnKind {
  io::CellKind kind = io::CellKind::empty;
  std::size_t mixed = 0; // line; 0: none
};

ColumnKind kind_of(const io::Sheet& sheet, std::size_t column, const io::CsvTable& table) {
  ColumnKind out;
  for (const std::size_t line : table.line) {
    const io::CellKind kind = sheet.kind(column, line - 1);
    if (kind == io::CellKind::empty || kind == io::CellKind::text || kind == out.kind) continue;
    if (out.kind == io::CellKind::empty)
      out.kind = kind;
    else
      out.mixed = line;
  }
  return out;
}

} // namespace

void take_cell_units(io::CsvTable& table, const io::Sheet& sheet, FaultList& faults) {
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    io::CsvColumn& column = table.columns[c];
    const auto [kind, mixed] = kind_of(sheet, c, table);
    if (mixed > 0)
      faults.add({table.file, mixed, 0},
                 fmt::format("column '{}' mixes number formats: times, dates or percent in some "
                             "cells, plain numbers in others",
                             column.name),
                 "give the whole column one format");
    else if (kind == io::CellKind::percent)
      table.notes.push_back(fmt::format("{}: shown in percent, taken as fractions", column.name));
    else if (kind == io::CellKind::time)
      table.notes.push_back(fmt::format("{}: shown as times, taken in s", column.name));
    if (kind == io::CellKind::percent) column.unit = "1";
    if (kind == io::CellKind::time) column.unit = "s";
  }
}

SheetChoice choose_sheets(const std::string& path, const std::string& named,
                          const DataOptions& options, const OptionsOfSheet& of_sheet) {
  const io::Workbook book = opened(path, named);
  const std::string tests =
      options.tests == named ? sheet_of_tests(path, named, options) : std::string();
  const std::vector<SheetLook> looks = look_at_all(book, path, named, of_sheet, tests);
  SheetChoice choice;
  choice.alone = looks.size() <= 1 && tests.empty();
  if (!tests.empty()) choice.passed.push_back(fmt::format("'{}' (data.tests)", tests));
  if (!options.sheets.empty()) choose_named(choice, book, named, options, looks);
  for (const SheetLook& look : looks) {
    if (options.sheets.empty() && is_read(look, looks, false)) choice.read.push_back(look.name);
    if (std::count(choice.read.begin(), choice.read.end(), look.name) == 0)
      choice.passed.push_back(reason_passed(look));
  }
  if (choice.read.empty())
    throw InputError({named, 0, 0}, "no sheet has a column that the job names",
                     "the sheets: " + join(choice.passed, ", ") + "; data.sheet names one");
  return choice;
}

std::string sheet_of_tests(const std::string& path, const std::string& named,
                           const DataOptions& options) {
  const auto mapped = options.columns.find("experiment");
  const std::vector<std::string> columns = mapped == options.columns.end()
                                               ? std::vector<std::string>{"experiment"}
                                               : mapped->second.names;
  const io::Workbook book = opened(path, named);
  if (!options.tests_sheet.empty()) return options.tests_sheet;
  std::vector<SheetLook> looks =
      look_at_all(book, path, named, [&](const std::string&) { return options; });
  if (looks.size() == 1) return looks.front().name;
  std::erase_if(looks, [&](const SheetLook& look) {
    return std::none_of(columns.begin(), columns.end(),
                        [&](const std::string& column) { return look.columns.count(column) > 0; });
  });
  std::erase_if(looks,
                [most = most_wanted(looks)](const SheetLook& look) { return look.wanted < most; });
  if (looks.size() == 1) return looks.front().name;
  std::vector<std::string> names;
  for (const io::Workbook::Entry& one : book.sheets())
    names.push_back("'" + one.name + "'");
  throw InputError({named, 0, 0},
                   fmt::format("{} of its sheets may be the table of tests",
                               looks.empty() ? "none" : std::to_string(looks.size())),
                   fmt::format("data.tests_sheet names it; it has a column '{}'. The sheets: {}",
                               join(columns, "' or '"), join(names, ", ")));
}

io::CsvTable read_sheet(const std::string& path, const std::string& named, const std::string& sheet,
                        const io::CsvFormat& format, FaultList& faults) {
  const io::Workbook book = opened(path, named);
  const io::Sheet cells = book.read(sheet.empty() ? book.sheets().front().name : sheet);
  if (cells.text.empty())
    throw InputError({named, 0, 0}, "the sheet is empty", "data.sheet names another");
  io::CsvTable table = io::parse_csv(cells.text, named, format, faults);
  table.form = "sheet";
  take_cell_units(table, cells, faults);
  if (cells.merged_cells > 0)
    table.notes.push_back(
        fmt::format("{} merged cells have the value of their area", thousands(cells.merged_cells)));
  if (cells.uncalculated > 0)
    table.notes.push_back(
        fmt::format("{} formulas without a stored value are empty cells: open the workbook in a "
                    "spreadsheet program and save it",
                    thousands(cells.uncalculated)));
  return table;
}

} // namespace frictab::data
