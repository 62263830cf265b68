// Faults of cells, values and experiments.
#include "data/checks.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/computed.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/test_table.h"

namespace frictab::data {

void report_odd_cells(Part& part) {
  if (part.cell_faults.empty()) return;
  const std::set<std::size_t> kept(part.row.begin(), part.row.end());
  FaultsByCause causes;
  for (MappedFile::CellFault& cell : part.cell_faults)
    if (kept.count(cell.row) > 0) causes.add(cell.cause, std::move(cell.fault));
  causes.tell(part.faults, "cell");
  part.cell_faults.clear();
}

void check_needed(Part& part, const DataOptions& options) {
  if (!part.find("sigma_n_MPa") && !options.columns.count("sigma_n_MPa"))
    part.faults.add(part.header(), "there is no column sigma_n_MPa",
                    "map it in [data.columns], or give it in [data.constants]; the file has: " +
                        join(part.raw_names(), ", "));
}

namespace {

// Remedy for a path below 0: what its file's column is meant for.
std::string hint_of_path(const ReadRequest& options) {
  const auto from = options.columns.find("s_mm");
  const bool mapped = from != options.columns.end() && !from->second.names.empty();
  const std::string name = mapped ? from->second.names.front() : "s_mm";
  return fmt::format(
      "; of noise before the stroke: {}; of a path to and fro: v_rel_mm_s = {{ "
      "column = \"{}\", slope_rows = 9 }}",
      mapped ? fmt::format("s_mm = {{ formula = \"maximum({}, 0)\" }}", name_in_formulas(name))
             : "data.drop = { s_mm = { below = 0 } }",
      name);
}

} // namespace

// Limit in the canonical unit of any quantity, including seconds since 1970: a larger value cannot
// be a measurement.
constexpr double more_than_anything = 1e12;

namespace {

bool is_friction(const std::string& column) {
  return column == "tau_R_MPa" || column == "F_R_N";
}
bool is_load(const std::string& column) {
  return column == "sigma_n_MPa" || column == "F_N_N";
}

} // namespace

void check_values(Part& part, const ReadRequest& options) {
  FaultsByCause causes;
  for (const Column& column : part.data.columns) {
    const Quantity* quantity = options.find_quantity(column.name);
    if (!quantity) continue;
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      if (column.name == "F_N_N" && !part.measured_tau && column.values[i] == 0)
        causes.add("no load",
                   {part.place(i), "F_N_N is 0: there is no friction coefficient",
                    "leave rows without load out: data.drop = { F_N_N = { below = 1 } }"});
      if (column.name == "sigma_f_MPa" && column.values[i] == 0)
        causes.add("no flow stress",
                   {part.place(i), "sigma_f_MPa is 0: no metal flows without stress",
                    "was it not measured there? leave such rows out: data.drop = { sigma_f_MPa = { "
                    "below = 1 } }"});
      if (column.name == "tau_R_error_MPa" && column.values[i] == 0)
        causes.add("no uncertainty",
                   {part.place(i), "tau_R_error_MPa is 0: no stress is measured exactly",
                    "the standard uncertainty of tau_R in MPa, above 0; leave the column out where "
                    "it is not known"});
      if (std::isfinite(column.values[i]) && std::abs(column.values[i]) > more_than_anything)
        causes.add(
            "high " + column.name,
            {part.place(i), fmt::format("{} is {}", column.name, column.values[i]),
             fmt::format("what a device writes where it measured nothing? Such rows are left "
                         "out with data.drop = {{ {} = {{ above = 1e6 }} }}",
                         column.name)});
      if (!(column.values[i] < quantity->lowest) || is_friction(column.name)) continue;
      causes.add("low " + column.name,
                 {part.place(i), fmt::format("{} is {}", column.name, column.values[i]),
                  fmt::format("a {} cannot be below {}{}{}", quantity->meaning, quantity->lowest,
                              quantity->unit == "1" ? "" : " " + quantity->unit,
                              is_load(column.name) && options.experiment == "interval"
                                  ? "; both signs in one test: are the intervals phases of a test? "
                                    "data.experiment = \"file\""
                              : is_load(column.name)
                                  ? "; both signs in one test: a zero that is off, or a channel of "
                                    "something else?"
                              : column.name == "s_mm" ? hint_of_path(options)
                                                      : "")});
    }
  }
  causes.tell(part.faults, "row");
}

void check_computed(Part& part, const ReadRequest& options) {
  if (!part.faults.empty()) return;
  FaultsByCause causes;
  for (const Column& column : part.data.columns)
    for (std::size_t i = 0; options.find_quantity(column.name) && i < column.values.size(); ++i)
      if (!std::isfinite(column.values[i]) && (options.measured || !is_measured(column.name)))
        causes.add(column.name,
                   {part.place(i), column.name + " cannot be computed here",
                    "time stands still, a neighbouring row holds no number, or the numbers "
                    "are too large"});
  causes.tell(part.faults, "row");
}

bool rows_look_like_tests(std::span<const std::vector<double>> settings, std::size_t rows) {
  if (rows < 8 || rows > 1000) return false;
  std::vector<const std::vector<double>*> few;
  for (const std::vector<double>& column : settings)
    if (std::any_of(column.begin(), column.end(), [](double v) { return std::isnan(v); }))
      continue;
    else if (const std::set<double> levels(column.begin(), column.end());
             levels.size() > 1 && 3 * levels.size() <= rows)
      few.push_back(&column);
  if (few.size() < 2) return false;
  const auto levels_of = [&](std::size_t row) {
    std::vector<double> levels;
    for (const std::vector<double>* column : few)
      levels.push_back((*column)[row]);
    return levels;
  };
  std::set<std::vector<double>> combinations{levels_of(0)};
  std::size_t changes = 0;
  for (std::size_t i = 1; i < rows; ++i) {
    changes += levels_of(i) != levels_of(i - 1);
    combinations.insert(levels_of(i));
  }
  return 3 * combinations.size() >= rows && 5 * changes >= 4 * (rows - 1);
}

bool counts_rows_of_a_test(const std::string& name) {
  return has_word(words_of_name(name), {"cycle", "zyklus", "lap", "laps", "position", "increment"});
}

namespace {

// Applies only if the job does not define tests, so that the whole file counts as one.
void check_rows(Part& part, const DataOptions& options) {
  const Dataset& data = part.data;
  if (!options.experiment.empty() || !options.wide.empty() || !part.whole_file ||
      data.experiments.size() != 1 || data.has("time_s"))
    return;
  std::vector<std::vector<double>> settings;
  for (const Column& column : data.columns) {
    if (counts_rows_of_a_test(column.name)) return;
    if (!is_measured(column.name)) settings.push_back(column.values);
  }
  if (rows_look_like_tests(settings, data.rows()))
    part.faults.add(part.header(),
                    fmt::format("is each of these {} rows a test? They differ in settings from "
                                "row to row, and no column names the tests",
                                data.rows()),
                    "data.experiment = \"row\" where they are; \"file\" where they are the course "
                    "of one test");
}

// A column that numbers the rows would make every row a test.
void check_names(Part& part) {
  const Dataset& data = part.data;
  const bool named_by_column = data.experiments.size() > 1;
  if (named_by_column && data.rows() == data.experiments.size() && data.rows() > 1 &&
      data.has("time_s"))
    part.faults.add(part.place(0), "every row is a test of its own, though there is time_s",
                    "is this the right experiment column? Tests of one row each have no time: "
                    "leave it out");
  const auto is_numbered = [](const std::string& name) { return first_number(name) >= 0; };
  if (named_by_column && part.whole_file && names_sums(data.experiments.back()) &&
      std::all_of(data.experiments.begin(), data.experiments.end() - 1, is_numbered))
    part.faults.add(part.place(data.first_row[data.experiments.size() - 1]),
                    fmt::format("'{}' sums up the tests above it, and is not one of them",
                                data.experiments.back()),
                    "leave it out: data.skip_footer = 1");
}

// A campaign of one row per test is valid; a single such test among time series is a mistake.
void check_single_rows(Part& part) {
  const Dataset& data = part.data;
  std::vector<std::size_t> single;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    if (data.first_row[e + 1] - data.first_row[e] == 1) single.push_back(e);
  if (single.empty()) return;
  if (single.size() == data.experiments.size()) {
    part.data.notes.emplace_back("one row per test: values of whole tests, not of their course");
    return;
  }
  for (const std::size_t e : single)
    part.faults.add(part.place(data.first_row[e]),
                    fmt::format("experiment '{}' has one row only", data.experiments[e]),
                    "the others of its file are time series; is this the right experiment column?");
}

} // namespace

void check_experiments(Part& part, const ReadRequest& options) {
  if (options.measured) {
    if (options.experiment != "row") check_names(part);
    check_single_rows(part);
    check_rows(part, options);
  }
  const Dataset& data = part.data;
  const Column* time = part.find("time_s");
  for (std::size_t e = 0; time && e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e] + 1; i < data.first_row[e + 1]; ++i)
      if (time->values[i] < time->values[i - 1]) {
        part.faults.add(part.place(i),
                        fmt::format("time_s goes back from {} to {} inside experiment '{}'",
                                    time->values[i - 1], time->values[i], data.experiments[e]),
                        "rows are in time order; is this two experiments?");
        break; // once per experiment
      }
}

} // namespace frictab::data
