// Reads a data file of either format into named columns.
#include "data/raw.h"

#include <filesystem>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/program.h"
#include "core/text.h"
#include "data/quantity.h"
#include "data/wide.h"
#include "io/atomic_file.h"
#include "io/hdf5.h"
#include "io/text_file.h"

namespace frictab::data {

namespace {

// ---- HDF5 ----

// Columns end to end: those of the root group, or of one group per experiment.
class Hdf5Columns {
public:
  Hdf5Columns(const std::string& path, const std::string& named, FaultList& faults)
      : in_(path, named), faults_(faults) {
    table_.file = named;
    if (in_.datasets().empty()) groups_ = in_.groups();
  }

  io::CsvTable read() {
    if (groups_.empty()) {
      read_datasets("", nullptr);
    } else {
      column("experiment", "", 0);
      for (const std::string& group : groups_)
        read_group(group);
    }
    if (table_.rows() == 0)
      throw InputError({table_.file, 0, 0}, "holds no data columns",
                       "a data file has one 1-D dataset per column, or such groups: one per test");
    return std::move(table_);
  }

private:
  // A group is a test: its attributes are the same in all of its rows.
  void read_group(const std::string& group) {
    const std::size_t first = table_.rows();
    read_datasets(group + "/", &group);
    const std::size_t rows = table_.rows() - first;
    repeat("experiment", group, first, rows);
    for (const std::string& name : in_.attributes(group))
      if (const auto number = in_.number_attribute(group, name))
        column(name, "", first).numbers.resize(first + rows, *number);
      else if (const auto text = in_.text_attribute(group, name))
        repeat(name, *text, first, rows);
    for (const io::CsvColumn& one : table_.columns)
      if (one.numbers.size() != table_.rows())
        throw InputError({table_.file, 0, 0},
                         fmt::format("group '{}' has no {}, which others have", group, one.name),
                         "every test needs the same datasets and attributes");
  }

  // Every 1-D dataset is a column; other shapes are no data columns.
  void read_datasets(const std::string& path, const std::string* group) {
    const std::size_t first = table_.rows();
    std::string first_name;
    std::size_t rows = 0;
    for (const std::string& name : in_.datasets(group ? *group : "/")) {
      const auto shape = in_.shape(path + name);
      if (shape.size() != 1) continue;
      if (first_name.empty()) {
        first_name = name;
        rows = shape[0];
      }
      if (shape[0] != rows)
        faults_.add({table_.file, 0, 0}, fmt::format("column '{}' has {} rows, '{}' has {}",
                                                     path + name, shape[0], first_name, rows));
      else
        read_dataset(path + name, name, first, rows);
    }
    for (std::size_t i = 0; i < rows; ++i)
      table_.line.push_back(first + i + 1);
  }

  void read_dataset(const std::string& path, const std::string& name, std::size_t first,
                    std::size_t rows) {
    io::CsvColumn& to = column(name, in_.text_attribute(path, "units").value_or(""), first);
    if (in_.is_text(path)) {
      to.numbers.resize(first + rows, no_value);
      std::size_t row = first;
      for (std::string& text : in_.texts(path))
        to.texts.push_back({row++, std::move(text), 0});
    } else {
      const std::vector<double> values = in_.values(path);
      to.numbers.insert(to.numbers.end(), values.begin(), values.end());
    }
  }

  void repeat(const std::string& name, const std::string& text, std::size_t first,
              std::size_t rows) {
    io::CsvColumn& to = column(name, "", first);
    to.numbers.resize(first + rows, no_value);
    for (std::size_t i = 0; i < rows; ++i)
      to.texts.push_back({first + i, text, 0});
  }

  // The column of this name; one that comes in behind row `first` lacks the rows before.
  io::CsvColumn& column(const std::string& name, const std::string& unit, std::size_t first) {
    const auto [known, is_new] = number_of_.emplace(name, table_.columns.size());
    if (!is_new) {
      io::CsvColumn& there = table_.columns[known->second];
      if (there.unit != unit || there.numbers.size() != first)
        faults_.add({table_.file, 0, 0},
                    fmt::format("column '{}' is there twice, or in two units", name));
      return there;
    }
    if (first > 0)
      faults_.add({table_.file, 0, 0},
                  fmt::format("column '{}' is not in group '{}'", name, groups_.front()),
                  "every test needs the same datasets and attributes");
    return table_.columns.emplace_back(io::CsvColumn{name, unit, {}, {}});
  }

  io::Hdf5Reader in_;
  FaultList& faults_;
  std::vector<std::string> groups_;
  io::CsvTable table_;
  std::unordered_map<std::string, std::size_t> number_of_; // of the columns, from 0
};

// ---- workbooks ----

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text.substr(text.find_last_of('\n') + 1);
}

// A sheet as CSV, numbers as they are stored, whatever format they are shown in.
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
    const std::string said = error.what(); // the command, then the program's words
    throw InputError({named, 0, 0},
                     sheet.empty() ? "is no workbook that xlsx2csv can read"
                                   : fmt::format("holds no sheet '{}' that can be read", sheet),
                     "xlsx2csv says: " + last_line(said));
  }
  return io::read_file(out);
}

// What columns may be called: as the job maps them, and by their canonical names.
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
  if (is_workbook(path)) { // as xlsx2csv writes
    format.delimiter = ',';
    format.decimal = '.';
    format.thousands = 0;
  }
  return format;
}

io::CsvTable read_raw(const std::string& path, const std::string& named, const DataOptions& options,
                      FaultList& faults) {
  if (io::looks_like_hdf5(path)) return Hdf5Columns(path, named, faults).read();
  return io::parse_csv(raw_text(path, named, options.sheet), named, csv_format(path, options),
                       faults);
}

} // namespace frictab::data
