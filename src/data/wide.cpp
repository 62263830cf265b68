// Converts columns side by side to columns end to end.
#include "data/wide.h"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "io/number.h"

namespace frictab::data {

namespace {

using Groups = std::map<std::string, std::string>;

// The columns of one test, by the name of their values.
struct Test {
  std::string name;
  Groups groups;
  std::map<std::string, std::size_t> columns;
  std::size_t rows = 0;
};

class Wide {
public:
  // Tests whose columns have the same names in the same order.
  explicit Wide(const io::CsvTable& table) : table_(table) {
    const std::vector<std::size_t> named = named_columns();
    const std::string& first = table.columns[named.front()].name;
    for (const std::size_t i : named) {
      const std::string& name = table.columns[i].name;
      if (name == first) tests_.push_back(Test{name_over(i), {}, {}, 0});
      Test& test = tests_.back();
      if (!test.columns.emplace(name, i).second)
        refuse(fmt::format("column '{}' comes twice before '{}' comes again", name, first));
      test.rows = std::max(test.rows, filled_rows(table.columns[i]));
    }
    if (tests_.size() < 2) refuse(fmt::format("no column '{}' comes again", first));
    for (const Test& test : tests_)
      if (names_of(test) != names_of(tests_.front()))
        refuse(fmt::format("test '{}' has the columns {}, test '{}' {}", tests_.front().name,
                           join(names_of(tests_.front()), ", "), test.name,
                           join(names_of(test), ", ")));
  }

  Wide(const io::CsvTable& table, const std::string& columns, const Place& place)
      : table_(table), place_(place) {
    const Pattern pattern = test_columns(columns, place);
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (auto groups = pattern.search(table.columns[i].name))
        take(i, std::move(*groups));
      else
        common_.push_back(i);
    if (tests_.empty())
      throw InputError(place, fmt::format("no column of {} fits '{}'", table.file, columns),
                       "the file's columns: " + names());
  }

  io::CsvTable unfolded() {
    io::CsvTable out;
    out.file = table_.file;
    out.header_line = table_.header_line;
    out.notes = table_.notes;
    out.above = table_.above;
    for (const std::size_t i : common_)
      out.columns.push_back({table_.columns[i].name, table_.columns[i].unit, {}, {}});
    for (const std::string& name : column_names())
      out.columns.push_back({name, unit_of(name), {}, {}});
    for (const Test& test : tests_)
      append(out, test);
    out.notes.push_back(
        fmt::format("tests side by side: {} tests, {} rows", tests_.size(), thousands(out.rows())));
    return out;
  }

private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError({table_.file, table_.header_line, 0}, what,
                     "data.experiment = \"columns\" needs the same columns again for each test");
  }

  std::vector<std::size_t> named_columns() const {
    std::vector<std::size_t> named;
    for (std::size_t i = 0; i < table_.columns.size(); ++i)
      if (!table_.columns[i].name.empty()) named.push_back(i);
    if (named.empty()) refuse("no column has a name");
    return named;
  }

  std::string name_over(std::size_t column) const {
    const bool has_text = column < table_.over.size() && !table_.over[column].empty();
    return has_text ? to_utf8(table_.over[column]) : std::to_string(tests_.size() + 1);
  }

  static std::vector<std::string> names_of(const Test& test) {
    std::vector<std::string> out;
    for (const auto& [name, column] : test.columns)
      out.push_back(name);
    return out;
  }

  std::string names() const {
    std::vector<std::string> all;
    for (const io::CsvColumn& column : table_.columns)
      all.push_back(column.name);
    return join(all, ", ");
  }

  void take(std::size_t i, Groups groups) {
    const std::string own = groups.count("column") ? groups["column"] : "value";
    groups.erase("column");
    std::string name = table_.columns[i].name;
    if (groups.count("experiment"))
      name = groups["experiment"];
    else if (own != "value") // shared by all columns of a test
      name = fmt::format("{}", fmt::join(values(groups), " "));
    groups.erase("experiment");
    auto test = std::find_if(tests_.begin(), tests_.end(),
                             [&](const Test& other) { return other.name == name; });
    if (test == tests_.end()) test = tests_.insert(tests_.end(), Test{name, groups, {}, 0});
    if (const auto [found, is_new] = test->columns.emplace(own, i); !is_new)
      throw InputError(place_,
                       fmt::format("columns '{}' and '{}' of {} are both {} of test '{}'",
                                   table_.columns[found->second].name, table_.columns[i].name,
                                   table_.file, own, name),
                       "a group (?<experiment>...) that distinguishes the tests");
    test->rows = std::max(test->rows, filled_rows(table_.columns[i]));
  }

  static std::vector<std::string> values(const Groups& groups) {
    std::vector<std::string> out;
    for (const auto& [name, text] : groups)
      out.push_back(text);
    return out;
  }

  // Number of rows up to the last non-empty cell.
  static std::size_t filled_rows(const io::CsvColumn& column) {
    std::size_t rows = column.numbers.size(), text = column.texts.size();
    while (rows > 0 && text > 0 && column.texts[text - 1].row == rows - 1 &&
           column.texts[text - 1].text.empty()) {
      --rows;
      --text;
    }
    return rows;
  }

  // experiment, groups, values: in the same order for all tests.
  std::vector<std::string> column_names() const {
    std::vector<std::string> out = {"experiment"};
    for (const auto& [name, text] : tests_.front().groups)
      out.push_back(name);
    for (const Test& test : tests_)
      for (const auto& [name, column] : test.columns)
        if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    return out;
  }

  // Unit of the first column of that name, because a units row gives one for each column.
  std::string unit_of(const std::string& name) const {
    for (const Test& test : tests_)
      if (const auto found = test.columns.find(name); found != test.columns.end())
        return table_.columns[found->second].unit;
    return "";
  }

  void append(io::CsvTable& out, const Test& test) const {
    const std::size_t first = out.rows();
    out.line.insert(out.line.end(), table_.line.begin(),
                    table_.line.begin() + static_cast<long>(test.rows));
    if (!table_.interval.empty())
      out.interval.insert(out.interval.end(), table_.interval.begin(),
                          table_.interval.begin() + static_cast<long>(test.rows));
    for (std::size_t i = 0; i < out.columns.size(); ++i) {
      io::CsvColumn& column = out.columns[i];
      const auto own = test.columns.find(column.name);
      if (i < common_.size())
        copy(column, table_.columns[common_[i]], first, test.rows);
      else if (own != test.columns.end())
        copy(column, table_.columns[own->second], first, test.rows);
      else
        repeat(column, column.name == "experiment" ? test.name : group(test, column.name), first,
               test.rows);
    }
  }

  static std::string group(const Test& test, const std::string& name) {
    const auto found = test.groups.find(name);
    return found == test.groups.end() ? "" : found->second;
  }

  static void copy(io::CsvColumn& to, const io::CsvColumn& from, std::size_t first,
                   std::size_t rows) {
    to.numbers.insert(to.numbers.end(), from.numbers.begin(),
                      from.numbers.begin() + static_cast<long>(rows));
    for (const io::CsvColumn::Text& cell : from.texts)
      if (cell.row < rows) to.texts.push_back({first + cell.row, cell.text, cell.column});
  }

  static void repeat(io::CsvColumn& to, const std::string& text, std::size_t first,
                     std::size_t rows) {
    double value = no_value;
    const bool number = to.name != "experiment" &&
                        (io::read_number(text, '.', value) || io::read_number(text, ',', value));
    if (!number) value = no_value;
    to.numbers.resize(first + rows, value);
    for (std::size_t i = 0; !number && i < rows; ++i)
      to.texts.push_back({first + i, text, 0});
  }

  const io::CsvTable& table_;
  const Place place_ = {};
  std::vector<std::size_t> common_;
  std::vector<Test> tests_;
};

} // namespace

Pattern test_columns(const std::string& columns, const Place& place) {
  return Pattern("^(?:" + columns + ")$", place);
}

io::CsvTable from_side_by_side(const io::CsvTable& table) {
  return Wide(table).unfolded();
}

bool are_side_by_side(const DataOptions& options) {
  return !options.wide.empty() || options.experiment == by_columns;
}

io::CsvTable end_to_end(io::CsvTable&& table, const DataOptions& options) {
  if (!options.wide.empty()) return from_wide(table, options.wide, options.wide_place);
  if (options.experiment == by_columns) return from_side_by_side(table);
  return std::move(table);
}

io::CsvTable from_wide(const io::CsvTable& table, const std::string& columns, const Place& place) {
  return Wide(table, columns, place).unfolded();
}

} // namespace frictab::data
