// Finds, converts and checks the columns of one file.
#include "data/mapping.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "core/units.h"
#include "data/above.h"
#include "data/computed.h"
#include "data/quantity.h"
#include "data/scale.h"
#include "data/time_stamps.h"
#include "io/number.h"

namespace frictab::data {

using io::CsvColumn;

namespace {

const char* const experiment_column = "experiment";

// True for "nan", "-Inf", "1e999".
bool is_not_finite(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && !std::isfinite(value);
}

// True for a cell without a value: empty, or the word that spreadsheets and statistics programs
// use.
bool is_word_for_missing(const std::string& text) {
  const std::string word = lower_case(text);
  return word.empty() || word == "nan" || word == "na" || word == "n/a" || word == "#n/a" ||
         word == "null";
}

class Mapper {
public:
  Mapper(io::CsvTable& raw, const Reading& options, const std::string& label, FaultList& faults)
      : raw_(raw), options_(options), label_(label), faults_(faults) {
    for (const CsvColumn& column : raw_.columns) {
      headers_.push_back(header_name(column.name));
      whole_names_[column.name].push_back(headers_.size());
      bare_names_[headers_.back().name].push_back(headers_.size());
    }
    out_.notes = raw.notes;
    for (const io::CsvCount& one : raw.counts)
      note_counted(one.before, one.after, one.count, true);
    for (CsvColumn& column : raw_.columns)
      blank_missing(column);
    for (const auto& [name, numbers] : whole_names_)
      for (std::size_t i = 1; i < numbers.size(); ++i)
        if (is_repeated(numbers[0], numbers[i])) repeats_[numbers[i]] = numbers[0];
  }

  MappedFile map() {
    map_experiment();
    std::vector<std::pair<const Quantity*, const CsvColumn*>> from;
    for (const Quantity& quantity : options_.quantities) {
      from.emplace_back(&quantity, source(quantity.name));
      ++uses_[from.back().second];
    }
    for (const auto& [quantity, column] : from)
      map_quantity(*quantity, column);
    map_bystanders();
    report_repeats();
    add_same_for_all();
    report_nameless_columns();
    for (const CsvColumn& column : raw_.columns)
      forget(column);
    return std::move(out_);
  }

  std::vector<ExperimentRun> runs() {
    std::vector<ExperimentRun> out;
    const CsvColumn* column = is_cut_whole(options_) ? nullptr : experiment_source();
    if (!column) return {{0, ""}};
    std::size_t text = 0;
    const std::string* last = nullptr; // text of the row before; nullptr if it is a number
    for (std::size_t i = 0; i < raw_.rows(); ++i) {
      while (text < column->texts.size() && column->texts[text].row < i)
        ++text;
      const bool is_text = text < column->texts.size() && column->texts[text].row == i;
      const std::string* const name = is_text ? &column->texts[text].text : nullptr;
      const bool same = i > 0 && (name && last   ? *name == *last
                                  : name || last ? false
                                                 : column->numbers[i] == column->numbers[i - 1]);
      if (!same) out.push_back({i, name ? *name : shortest(column->numbers[i])});
      last = name;
    }
    return out;
  }

private:
  // Empties the cells whose value stands for none, as the job says.
  void blank_missing(CsvColumn& column) {
    if (options_.missing_values.empty()) return;
    std::size_t cells = 0;
    for (const std::string& missing : options_.missing_values)
      if (double number = 0; io::read_number(missing, '.', number))
        for (double& value : column.numbers)
          if (value == number) {
            value = frictab::no_value;
            ++cells;
          }
    for (const CsvColumn::Text& cell : column.texts)
      cells += is_marked_missing(cell.text);
    if (cells > 0)
      note_counted(column.name + ": ", " cells are empty by data.missing_values", cells, false);
  }

  bool is_marked_missing(const std::string& text) const {
    const auto& values = options_.missing_values;
    return std::find(values.begin(), values.end(), text) != values.end();
  }

  // True for a cell without a value: empty, or a word that stands for it.
  bool is_missing(const std::string& text) const {
    return is_word_for_missing(text) || is_marked_missing(text);
  }

  // Name and unit of a column that is taken by its name before a unit, even an unknown unit;
  // otherwise a quantity would silently end up among the other columns. convert_unit reports such a
  // unit.
  io::HeaderName header_name(const std::string& text) const {
    const io::HeaderName known = io::read_header_name(text), any = io::split_header_name(text);
    if (any.name == text || known.name != text || is_named(text) || has_column(any.name))
      return known;
    const bool is_own = options_.find_quantity(any.name) && !options_.columns.count(any.name);
    return is_own || is_named(any.name) ? any : known;
  }

  // True if two columns, by their numbers, have equal cells: rigs write the time for every channel.
  bool is_repeated(std::size_t first, std::size_t second) const {
    const CsvColumn &a = raw_.columns[first - 1], &b = raw_.columns[second - 1];
    const auto equal = [](double x, double y) {
      return x == y || (std::isnan(x) && std::isnan(y));
    };
    return std::equal(a.numbers.begin(), a.numbers.end(), b.numbers.begin(), b.numbers.end(),
                      equal) &&
           std::equal(a.texts.begin(), a.texts.end(), b.texts.begin(), b.texts.end(),
                      [](const CsvColumn::Text& x, const CsvColumn::Text& y) {
                        return x.row == y.row && x.text == y.text;
                      });
  }

  // True if the job names the column by its whole name.
  bool is_named(const std::string& name) const {
    const auto among = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    return (options_.bystanders && among(*options_.bystanders)) ||
           std::any_of(options_.columns.begin(), options_.columns.end(),
                       [&](const auto& source) { return among(source.second.names); });
  }

  bool has_column(const std::string& name) const {
    return std::any_of(raw_.columns.begin(), raw_.columns.end(),
                       [&](const CsvColumn& column) { return column.name == name; });
  }

  Place header() const { return {raw_.file, raw_.header_line, 0}; }

  std::vector<std::string> present() const {
    std::vector<std::string> names;
    for (const CsvColumn& column : raw_.columns)
      if (!column.name.empty()) names.push_back(column.name);
    return names;
  }

  // The raw column of a canonical name; nullptr if it is not in the file. Adds a fault if it is
  // requested and absent, or ambiguous.
  const CsvColumn* source(const std::string& canonical) {
    const auto mapped = options_.columns.find(canonical);
    if (mapped == options_.columns.end())
      return options_.constants.count(canonical) ? nullptr : by_name(canonical);
    const ColumnSource& from = mapped->second;
    if (!from.formula.empty()) return nullptr; // computed later
    const bool may_lack = !options_.measured && is_measured(canonical);
    if (from.number > 0) {
      if (from.number <= raw_.columns.size()) return &raw_.columns[from.number - 1];
      if (may_lack) return nullptr;
      faults_.add(from.place, fmt::format("{}: column number {} is beyond the {} columns of {}",
                                          canonical, from.number, raw_.columns.size(), raw_.file));
      return nullptr;
    }
    for (const std::string& name : from.names)
      if (const CsvColumn* column = by_name(name)) return column;
    if (may_lack) return nullptr;
    faults_.add(header(),
                fmt::format("there is no column '{}' (wanted for {})", join(from.names, "' or '"),
                            canonical),
                suggest(from.names.empty() ? canonical : from.names.front(), present()) +
                    "; mapped at " + format_place(from.place));
    return nullptr;
  }

  // Finds a column by its whole name, or else by its name before a unit.
  const CsvColumn* by_name(const std::string& name) {
    const std::vector<std::size_t>& numbers = numbers_of(name);
    if (numbers.empty()) return nullptr;
    const bool differ = std::any_of(numbers.begin() + 1, numbers.end(), [&](std::size_t number) {
      return repeats_.count(number) == 0;
    });
    if (differ && ambiguous_.insert(name).second)
      faults_.add(header(),
                  fmt::format("there are {} columns '{}': {}", numbers.size(), name, list(numbers)),
                  fmt::format("take one by its number: {{ column = {} }}", numbers.front()));
    return &raw_.columns[numbers.front() - 1];
  }

  const std::vector<std::size_t>& numbers_of(const std::string& name) const {
    static const std::vector<std::size_t> none;
    for (const auto* names : {&whole_names_, &bare_names_})
      if (const auto found = names->find(name); found != names->end()) return found->second;
    return none;
  }

  // Lists the first few numbers.
  static std::string list(const std::vector<std::size_t>& numbers) {
    constexpr std::size_t shown = 20;
    const auto end = numbers.begin() + static_cast<long>(std::min(shown, numbers.size()));
    return fmt::format("{}{}", fmt::join(numbers.begin(), end, ", "),
                       numbers.size() > shown ? ", ..." : "");
  }

  // Possible faults of a cell.
  enum class Cause { no_number, empty, word_for_empty, not_finite };

  // `what` follows the column's name and, in HDF5, the row.
  void cell_fault(std::size_t row, std::size_t cell_column, const std::string& name, Cause cause,
                  const std::string& what, const std::string& hint) {
    const std::string where = raw_.header_line > 0 ? "" : fmt::format(" (row {})", raw_.line[row]);
    out_.cell_faults.push_back(
        {row,
         {row_place(raw_, row, cell_column), fmt::format("{}{}: {}", name, where, what), hint},
         fmt::format("{} {}", name, static_cast<int>(cause)),
         cause == Cause::empty || cause == Cause::word_for_empty});
  }

  // True if the file has fractions: then data.decimal is their decimal sign.
  bool has_fractions() const {
    return std::any_of(raw_.columns.begin(), raw_.columns.end(), [](const CsvColumn& column) {
      return std::any_of(column.numbers.begin(), column.numbers.end(), [](double value) {
        return std::isfinite(value) && value != std::round(value);
      });
    });
  }

  // Remedy for a number that cannot be read: 1.341 in a file with 0,0024 is 1341; with whole
  // numbers only, it may be either.
  std::string number_hint(const std::string& text) const {
    const auto looks_like = [&](char decimal) {
      double ignored = 0;
      return io::read_number(text, decimal, ignored);
    };
    if (text.find("±") != text.npos || text.find("+/-") != text.npos || text.starts_with('~'))
      return "keep the number alone in the cell, or list this text in data.missing_values";
    std::string grouped, pointed;
    double ignored = 0;
    for (const char between : {'.', ',', '\'', ' '})
      if (grouped.empty() && between != options_.decimal && options_.thousands == 0 &&
          io::read_grouped_number(text, options_.decimal, between, ignored))
        grouped = fmt::format("digits in groups of three? set data.thousands = \"{}\"", between);
    if (options_.decimal == '.' && looks_like(','))
      pointed = "a decimal comma? set data.decimal = \",\"";
    if (options_.decimal == ',' && looks_like('.'))
      pointed = "a decimal point? set data.decimal = \".\"";
    return pointed.empty() || (!grouped.empty() && has_fractions()) ? grouped : pointed;
  }

  // All cells of a column as numbers; adds a fault for each non-numeric one.
  std::vector<double> numbers(const CsvColumn& column, const std::string& canonical) {
    for (const CsvColumn::Text& cell : column.texts)
      if (is_missing(cell.text))
        no_value(cell.row, cell.column, canonical, cell.text);
      else if (is_not_finite(cell.text))
        not_finite(cell.row, cell.column, canonical, cell.text);
      else
        cell_fault(cell.row, cell.column, canonical, Cause::no_number,
                   fmt::format("'{}' is not a number", cell.text), number_hint(cell.text));
    std::size_t text = 0;
    for (std::size_t i = 0; i < column.numbers.size(); ++i) {
      while (text < column.texts.size() && column.texts[text].row < i)
        ++text;
      const bool is_text = text < column.texts.size() && column.texts[text].row == i;
      if (is_text || std::isfinite(column.numbers[i])) continue;
      if (std::isnan(column.numbers[i])) // HDF5 marks missing values only by NaN
        no_value(i, 0, canonical, "NaN");
      else
        not_finite(i, 0, canonical, shortest(column.numbers[i]));
    }
    return taken(column);
  }

  // Moves the numbers out of the column, or copies them if another quantity needs them too.
  std::vector<double> taken(const CsvColumn& column) {
    if (uses_[&column]-- > 1) return column.numbers;
    return std::move(raw_.columns[std::size_t(&column - raw_.columns.data())].numbers);
  }

  void no_value(std::size_t row, std::size_t cell_column, const std::string& canonical,
                const std::string& text) {
    if (!options_.measured && is_measured(canonical)) return; // no measurement to compare with
    cell_fault(row, cell_column, canonical, text.empty() ? Cause::empty : Cause::word_for_empty,
               text.empty() ? "the cell is empty" : text + " stands for no value",
               "repair it, or data.missing = \"drop\" leaves such rows out");
  }

  void not_finite(std::size_t row, std::size_t cell_column, const std::string& canonical,
                  const std::string& text) {
    cell_fault(row, cell_column, canonical, Cause::not_finite, text + " is not a finite number",
               "leave the row out, or repair it");
  }

  void map_quantity(const Quantity& quantity, const CsvColumn* column) {
    if (!column) {
      if (const auto constant = options_.constants.find(quantity.name);
          constant != options_.constants.end())
        add_constant(quantity, constant->second);
      return;
    }
    used_.insert(column);
    if (quantity.name == "time_s" && map_clock(*column)) return;
    Column mapped{quantity.name, quantity.unit, numbers(*column, quantity.name), {}};
    const auto found = options_.columns.find(quantity.name);
    const ColumnSource plain;
    convert_unit(mapped, quantity, *column,
                 found == options_.columns.end() ? plain : found->second);
    out_.columns.push_back(std::move(mapped));
  }

  // Takes a column of clock times or time stamps in s since its first one; false for other columns.
  bool map_clock(const CsvColumn& raw) {
    if (raw_.rows() == 0 || raw.texts.size() < raw_.rows() || !looks_like_time(raw.texts[0].text))
      return false;
    std::vector<std::string> texts;
    for (const CsvColumn::Text& cell : raw.texts)
      texts.push_back(cell.text);
    RowTimes times = seconds_since_first(texts);
    if (!times.fault.empty()) {
      faults_.add(row_place(raw_, times.at, raw.texts[times.at].column), "time_s: " + times.fault,
                  "times are 14:03:05,120 or with a date, 2026-03-02 14:03:05");
      times.seconds.assign(raw_.rows(), 0);
    }
    const std::string parts = add_milliseconds(texts, times.seconds);
    out_.notes.push_back(
        fmt::format("time_s: clock times{}, in s since the first of its file", parts));
    out_.columns.push_back({"time_s", "s", std::move(times.seconds), {}});
    return true;
  }

  // Loggers write the milliseconds of a clock in a column of their own. Returns a text on them.
  std::string add_milliseconds(const std::vector<std::string>& texts,
                               std::vector<double>& seconds) const {
    for (std::size_t c = 0; c < raw_.columns.size(); ++c) {
      const std::vector<double>& ms = raw_.columns[c].numbers;
      const std::string name = lower_case(headers_[c].name);
      const bool is_called_so = name == "ms" || name == "msec" || name.starts_with("millise");
      if (!is_called_so || ms.size() != seconds.size() ||
          texts[0].find_first_of(".,") != texts[0].npos ||
          !std::all_of(ms.begin(), ms.end(),
                       [](double value) { return value >= 0 && value < 1000; }))
        continue;
      std::vector<double> finer = seconds;
      for (std::size_t i = 0; i < finer.size(); ++i)
        finer[i] += (ms[i] - ms[0]) / 1000;
      if (!std::is_sorted(finer.begin(), finer.end())) continue; // of something else
      seconds = std::move(finer);
      return fmt::format(" with the milliseconds of '{}'", raw_.columns[c].name);
    }
    return "";
  }

  // Adds a constant of the job, which overrides the file's column; a note reports that the column
  // is not read.
  void add_constant(const Quantity& quantity, double value) {
    out_.columns.push_back(
        {quantity.name, quantity.unit, std::vector<double>(raw_.rows(), value), {}});
    if (const auto& numbers = numbers_of(quantity.name); !numbers.empty()) {
      const CsvColumn& own = raw_.columns[numbers.front() - 1];
      used_.insert(&own);
      note_counted(
          fmt::format("{} is {} in all ", quantity.name, shortest(value)),
          fmt::format(" rows, as the job says: the file's own column '{}' is not read", own.name),
          raw_.rows(), true);
    }
  }

  void convert_unit(Column& column, const Quantity& quantity, const CsvColumn& raw,
                    const ColumnSource& from) {
    const std::string& header_unit = headers_[std::size_t(&raw - raw_.columns.data())].unit;
    std::string unit = !from.unit.empty()  ? from.unit
                       : !raw.unit.empty() ? io::without_brackets(raw.unit)
                                           : header_unit;
    std::string wanted = quantity.unit;
    if (!from.times.empty()) wanted = "1";
    if (from.area_mm2 > 0) wanted = "N";
    if (from.slope_rows > 0) wanted = quantity.unit == "mm/s" ? "mm" : quantity.unit;
    const char* const where =
        !from.unit.empty() ? "in the job"
        : unit.empty()
            ? says_by_name(raw, wanted) ? "by the end of its name" : "assumed, as no unit is given"
            : "in the file";
    if (unit.empty()) {
      assume(quantity, raw, wanted);
      unit = wanted;
    }
    const auto conversion = convert(unit, wanted);
    if (!conversion) {
      faults_.add(
          from.place.file.empty() ? header() : from.place,
          fmt::format("{}: the unit '{}' does not convert to {}", quantity.name, unit, wanted),
          units_hint(unit, wanted));
      return;
    }
    const double area = from.area_mm2 > 0 ? from.area_mm2 : 1;
    if (unit == wanted && area == 1) return; // keeps the file's own bits
    for (double& value : column.values)
      value = (*conversion)(value) / area;
    const std::string over =
        from.area_mm2 > 0 ? fmt::format(" over {} mm2: {}", shortest(area), quantity.unit) : "";
    out_.notes.push_back(
        fmt::format("{}: {} {}, converted to {}{}", quantity.name, unit, where, wanted, over));
  }

  // Records an assumed unit for a column without one; a canonical name states its unit, and so does
  // a name that ends with it.
  void assume(const Quantity& quantity, const CsvColumn& raw, const std::string& wanted) {
    const std::string& name = headers_[std::size_t(&raw - raw_.columns.data())].name;
    if (wanted == "1" || options_.find_quantity(name)) return;
    if (!says_by_name(raw, wanted))
      out_.assumed.push_back({quantity.name, raw.name, wanted, unit_in_name(name, wanted)});
  }

  // Whether the name of a column ends with this unit.
  bool says_by_name(const CsvColumn& raw, const std::string& wanted) const {
    const std::string& name = headers_[std::size_t(&raw - raw_.columns.data())].name;
    const std::string own = unit_in_name(name, wanted);
    const auto says = own.empty() ? std::nullopt : convert(own, wanted);
    return says && says->factor == 1 && says->offset == 0;
  }

  static std::string units_hint(const std::string& unit, const std::string& wanted) {
    const std::vector<std::string> known = units_like(wanted);
    const std::string near = nearest_name(unit, known);
    if (unit == "kg" && convert("kgf", wanted)) return "its weight in N? Give the unit \"kgf\"";
    return (near.empty() ? "" : "did you mean '" + near + "'? ") +
           "units that do: " + join(known, ", ");
  }

  // The column that names the experiments; nullptr if experiments are files or intervals.
  const CsvColumn* experiment_source() {
    if (options_.experiment == "file" || options_.experiment == by_pauses) return nullptr;
    const std::string name = experiment_column_of(options_);
    if (name.empty() || options_.columns.count(experiment_column)) return source(experiment_column);
    const CsvColumn* column = by_name(name);
    if (!column)
      faults_.add(header(), fmt::format("there is no column '{}' (data.experiment)", name),
                  suggest(name, present()));
    return column;
  }

  void map_experiment() {
    if (options_.experiment == "interval") {
      if (raw_.interval.empty())
        faults_.add(header(), "a file without lines has no intervals (data.experiment)",
                    "one group or file per experiment, or a column that names it");
      out_.intervals = true;
      for (const std::size_t interval : raw_.interval)
        out_.experiment.push_back(fmt::format("{} {}", label_, interval + 1));
      return;
    }
    if (options_.experiment == "row") {
      for (std::size_t i = 0; i < raw_.rows(); ++i)
        out_.experiment.push_back(fmt::format("{} {}", label_, i + 1));
      return;
    }
    const CsvColumn* column = experiment_source();
    if (!column) return;
    used_.insert(column);
    read_experiments(column);
    if (options_.experiment.starts_with(file_and_column) || options_.experiment == by_columns)
      for (std::string& name : out_.experiment)
        name = label_ + " " + name;
  }

  void read_experiments(const CsvColumn* column) {
    out_.experiment.resize(raw_.rows());
    std::size_t text = 0;
    for (std::size_t i = 0; i < raw_.rows(); ++i) {
      while (text < column->texts.size() && column->texts[text].row < i)
        ++text;
      const bool is_text = text < column->texts.size() && column->texts[text].row == i;
      out_.experiment[i] = is_text ? column->texts[text].text : shortest(column->numbers[i]);
      if (out_.experiment[i].empty())
        cell_fault(i, 0, experiment_column, Cause::no_number, "the cell is empty",
                   "every row needs the name of its test");
    }
  }

  Column* find(const std::string& name) {
    for (Column& column : out_.columns)
      if (column.name == name) return &column;
    return nullptr;
  }

  void map_bystanders() {
    std::set<std::string> keep;
    if (options_.bystanders) keep.insert(options_.bystanders->begin(), options_.bystanders->end());
    if (options_.bystanders)
      for (const std::string& name : *options_.bystanders)
        if (!by_name(name)) check_elsewhere(name);
    for (const CsvColumn& column : raw_.columns) {
      if (used_.count(&column) || column.name.empty()) continue;
      if (options_.find_quantity(column.name))
        continue; // its canonical name is mapped from elsewhere
      const bool is_wanted = !options_.bystanders || keep.count(column.name) ||
                             column.name == origin_column || is_dropped_by(column.name) ||
                             !computed_from(options_, column.name).empty();
      if (!is_wanted || is_left_out_as_repeat(column)) {
        out_.not_read.push_back(column.name);
        continue;
      }
      check_case(column);
      add_bystander(column, bystander_name(column));
    }
  }

  bool is_dropped_by(const std::string& name) const {
    return std::any_of(options_.drop.begin(), options_.drop.end(),
                       [&](const DropRule& rule) { return rule.column == name; });
  }

  bool is_left_out_as_repeat(const CsvColumn& column) {
    const std::size_t number = std::size_t(&column - raw_.columns.data()) + 1;
    const auto found = repeats_.find(number);
    if (found == repeats_.end()) return false;
    repeated_[found->second].push_back(number);
    return true;
  }

  void report_repeats() {
    for (const auto& [first, numbers] : repeated_)
      out_.notes.push_back(fmt::format("'{}' of column {} comes again and is not read: number {}",
                                       raw_.columns[first - 1].name, first, list(numbers)));
  }

  // The name of a recorded column; its number is part of it if other columns have the same name.
  std::string bystander_name(const CsvColumn& column) {
    const std::vector<std::size_t>& alike = numbers_of(column.name);
    if (alike.size() == 1) return column.name;
    return fmt::format("{} (column {})", column.name, &column - raw_.columns.data() + 1);
  }

  // Accepts columns that the job gives for the whole file or its tests; these are kept even if not
  // named.
  void check_elsewhere(const std::string& name) {
    if (options_.columns_beside.count(name) || options_.constants.count(name) ||
        options_.labels.count(name))
      return;
    std::vector<std::string> known = present();
    known.insert(known.end(), options_.columns_beside.begin(), options_.columns_beside.end());
    for (const auto& [constant, value] : options_.constants)
      known.push_back(constant);
    for (const auto& [label, text] : options_.labels)
      known.push_back(label);
    faults_.add(header(), fmt::format("there is no column '{}' (data.bystanders)", name),
                suggest(name, known));
  }

  // Rejects a name that differs from a quantity only by case: as a separate column, "TAU_R_MPA"
  // would be a candidate cause of tau_R_MPa in tracing.
  void check_case(const CsvColumn& column) {
    const std::string& name = headers_[std::size_t(&column - raw_.columns.data())].name;
    const std::string lower = lower_case(name);
    for (const Quantity& quantity : options_.quantities)
      if (lower == lower_case(quantity.name))
        faults_.add(header(),
                    fmt::format("column '{}' differs from {} only in upper and lower case{}",
                                column.name, quantity.name,
                                find(quantity.name) ? ", which is there as well" : ""),
                    fmt::format("take one of the two: [data.columns] {} = \"{}\"; or list the "
                                "further columns to keep in data.bystanders",
                                quantity.name, column.name));
  }

  // Reports nameless columns with content. Empty ones come from delimiters at the end of a line.
  void report_nameless_columns() {
    std::vector<std::size_t> nameless;
    for (std::size_t i = 0; i < raw_.columns.size(); ++i) {
      const CsvColumn& column = raw_.columns[i];
      const auto is_empty = [](const CsvColumn::Text& cell) { return cell.text.empty(); };
      const bool holds = column.texts.size() < column.numbers.size() ||
                         !std::all_of(column.texts.begin(), column.texts.end(), is_empty);
      if (column.name.empty() && !used_.count(&column) && holds) nameless.push_back(i + 1);
    }
    if (nameless.empty()) return;
    for (const std::size_t number : nameless)
      out_.not_read.push_back(fmt::format("column {}", number));
    out_.notes.push_back(
        fmt::format("{} without a name {} not read: number {}",
                    nameless.size() == 1 ? "a column" : thousands(nameless.size()) + " columns",
                    nameless.size() == 1 ? "is" : "are", list(nameless)));
  }

  void add_bystander(const CsvColumn& raw, const std::string& name) {
    const auto missing = static_cast<std::size_t>(
        std::count_if(raw.texts.begin(), raw.texts.end(),
                      [&](const CsvColumn::Text& cell) { return is_missing(cell.text); }));
    const std::size_t words = raw.texts.size() - missing;
    const auto numeric = static_cast<std::size_t>(std::count_if(
        raw.numbers.begin(), raw.numbers.end(), [](double value) { return !std::isnan(value); }));
    Column column{name, "", {}, {}};
    if (words > 0 && words >= (words + numeric) / 2) { // empty cells count as neither
      const bool is_filled_once = missing > words && !is_missing(raw.texts[0].text);
      make_categorical(column, raw);
      if (missing > 0)
        report_empty_cells(name, missing,
                           is_filled_once
                               ? ": a level of their own; of merged cells? data.fill_down"
                               : ": a level of their own");
      out_.columns.push_back(std::move(column));
      return;
    }
    for (const CsvColumn::Text& cell : raw.texts)
      if (!is_missing(cell.text))
        cell_fault(cell.row, cell.column, name, Cause::no_number,
                   fmt::format("'{}' is not a number, as most of the column is", cell.text),
                   "repair the cell, or leave the column out by listing the others in "
                   "data.bystanders");
    for (std::size_t i = 0; i < raw.numbers.size(); ++i)
      if (std::isinf(raw.numbers[i])) not_finite(i, 0, name, shortest(raw.numbers[i]));
    const auto empty = std::count_if(raw.numbers.begin(), raw.numbers.end(),
                                     [](double value) { return std::isnan(value); });
    if (empty > 0) report_empty_cells(name, static_cast<std::size_t>(empty), "");
    column.values = taken(raw);
    out_.columns.push_back(std::move(column));
  }

  void report_empty_cells(const std::string& name, std::size_t rows, const char* then) {
    note_counted(name + ": ", fmt::format(" rows without a value{}", then), rows, false);
  }

  void note_counted(std::string before, std::string after, std::size_t rows, bool of_all) {
    out_.counted_notes.push_back(
        {out_.notes.size(), std::move(before), std::move(after), of_all, rows, raw_.rows()});
    out_.notes.push_back(out_.counted_notes.back().text());
  }

  // Adds the job's values for the whole file: constants other than quantities, and labels.
  void add_same_for_all() {
    const auto add = [&](const std::string& name, double value, std::vector<std::string> levels) {
      if (find(name))
        faults_.add(header(), fmt::format("'{}' is a column of the file as well", name),
                    "give the constant, label or group another name");
      out_.columns.push_back(
          {name, "", std::vector<double>(raw_.rows(), value), std::move(levels)});
    };
    for (const auto& [name, value] : options_.constants)
      if (!options_.find_quantity(name)) add(name, value, {});
    for (const auto& [name, text] : options_.labels)
      add(name, 0, {text});
  }

  void make_categorical(Column& column, const CsvColumn& raw) {
    std::map<std::string, double> index;
    for_each_text(raw, [&](std::size_t, const std::string& cell) { index.emplace(cell, 0); });
    for (auto& [level, code] : index) {
      code = static_cast<double>(column.levels.size());
      column.levels.push_back(level);
    }
    column.values.resize(raw_.rows());
    const std::string* last = nullptr; // mostly the same text again
    for_each_text(raw, [&](std::size_t i, const std::string& cell) {
      const bool again = last && *last == cell;
      const auto found = again ? index.end() : index.find(cell);
      column.values[i] = again ? column.values[i - 1] : found->second;
      if (!again) last = &found->first;
    });
    forget(raw);
  }

  // Frees a file's column after it has been taken.
  void forget(const CsvColumn& raw) {
    raw_.columns[std::size_t(&raw - raw_.columns.data())] = {raw.name, raw.unit, {}, {}};
  }

  // Passes all cells as text in turn, numbers in their shortest form.
  template <class Take> void for_each_text(const CsvColumn& raw, const Take& take) const {
    std::size_t text = 0;
    for (std::size_t i = 0; i < raw_.rows(); ++i)
      if (text < raw.texts.size() && raw.texts[text].row == i)
        take(i, raw.texts[text++].text);
      else
        take(i, shortest(raw.numbers[i]));
  }

  io::CsvTable& raw_;
  const Reading& options_;
  const std::string& label_;
  FaultList& faults_;
  std::vector<io::HeaderName> headers_; // of each column
  // Column numbers, from 1, by name.
  std::unordered_map<std::string, std::vector<std::size_t>> whole_names_, bare_names_;
  MappedFile out_;
  std::set<const CsvColumn*> used_;
  std::map<const CsvColumn*, std::size_t> uses_; // number of quantities that use its numbers
  std::map<std::size_t, std::size_t> repeats_; // numbers of equal columns of one name: later, first
  std::map<std::size_t, std::vector<std::size_t>> repeated_; // those left out, by the first one
  std::set<std::string> ambiguous_;
};

} // namespace

std::string MappedFile::CountedNote::text() const {
  return before + thousands(rows) + (of_all ? "" : " of " + thousands(of)) + after;
}

MappedFile map_columns(io::CsvTable& raw, const Reading& options, const std::string& label,
                       FaultList& faults) {
  add_values_above(raw, options, faults);
  return Mapper(raw, options, label, faults).map();
}

std::vector<ExperimentRun> experiment_runs(io::CsvTable& raw, const Reading& options,
                                           FaultList& faults) {
  add_values_above(raw, options, faults);
  return Mapper(raw, options, "", faults).runs();
}

} // namespace frictab::data
