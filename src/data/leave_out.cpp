// data.drop and data.missing.
#include "data/leave_out.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/computed.h"
#include "data/plausibility.h"
#include "data/quantity.h"
#include "data/signs.h"

namespace frictab::data {

namespace {

std::string text_rule(const DropRule& rule, const std::string& text) {
  return fmt::format("{} is '{}'", rule.column, text);
}

// A number stands for its text: 0 for '0'.
bool has_text(const Column& column, std::size_t row, const std::string& text) {
  const double value = column.values[row];
  if (!column.levels.empty()) return column.levels[static_cast<std::size_t>(value)] == text;
  return std::isnan(value) ? text.empty() : shortest(value) == text;
}

constexpr std::string_view names_of_tests = "experiment";

// A file that lacks the column has none of the texts; check_texts_to_drop finds that all lack it.
void drop_texts(const DropRule& rule, Part& part, std::vector<char>& keep) {
  const Column* const column = part.find(rule.column);
  const Dataset& data = part.data;
  if (!column && rule.column != names_of_tests) return;
  for (const std::string& text : rule.texts) {
    std::size_t dropped = 0;
    bool is_there = false; // also in rows that another rule leaves out
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
        if (!(column ? has_text(*column, i, text) : data.experiments[e] == text)) continue;
        is_there = true;
        dropped += keep[i] != 0;
        keep[i] = 0;
      }
    if (is_there) part.data.dropped.push_back({text_rule(rule, text), dropped});
  }
}

} // namespace

void drop_rows(Part& part, const Reading& options) {
  std::vector<char> keep(part.row.size(), 1);
  for (const DropRule& rule : options.drop) {
    drop_texts(rule, part, keep);
    if (!rule.below && !rule.above) continue;
    const Column* column = part.find(rule.column);
    if (!column && !options.measured && is_measured(rule.column)) continue;
    if (!column || !column->levels.empty()) {
      part.faults.add(
          rule.place,
          column ? fmt::format("data.drop: {} holds texts, no numbers", rule.column)
                 : fmt::format("data.drop: the data have no column {}", rule.column),
          column ? fmt::format("drop = {{ {} = [\"{}\"] }}", rule.column, column->levels.back())
                 : suggest(rule.column, part.raw_names()));
      continue;
    }
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      const double x = column->values[i];
      const bool out = (rule.below && x < *rule.below) || (rule.above && x > *rule.above);
      dropped += out && keep[i];
      if (out) keep[i] = 0;
    }
    std::string text = rule.column;
    if (rule.below) text += " below " + shortest(*rule.below);
    if (rule.above)
      text += std::string(rule.below ? " or" : "") + " above " + shortest(*rule.above);
    part.data.dropped.push_back({text, dropped});
  }
  keep_rows(part, keep, "data.drop leaves no row");
}

void check_texts_to_drop(std::span<const Dataset* const> parts, const DataOptions& options,
                         FaultList& faults) {
  for (const DropRule& rule : options.drop)
    for (const std::string& text : rule.texts) {
      bool is_there = false, is_column = rule.column == names_of_tests;
      std::vector<std::string> known, columns;
      for (const Dataset* part : parts) {
        for (const Dataset::Dropped& one : part->dropped)
          is_there = is_there || one.rule == text_rule(rule, text);
        if (rule.column == names_of_tests)
          known.insert(known.end(), part->experiments.begin(), part->experiments.end());
        for (const Column& column : part->columns) {
          columns.push_back(column.name);
          if (column.name != rule.column) continue;
          is_column = true;
          known.insert(known.end(), column.levels.begin(), column.levels.end());
        }
      }
      if (is_there) continue;
      if (!is_column) {
        faults.add(rule.place, fmt::format("data.drop: the data have no column '{}'", rule.column),
                   suggest(rule.column, columns));
        break;
      }
      faults.add(rule.place, fmt::format("data.drop: no row has '{}' in {}", text, rule.column),
                 known.empty() ? "leave the text out" : suggest(text, known));
    }
}

void check_filled_columns(std::span<const Dataset* const> parts, const DataOptions& options,
                          FaultList& faults) {
  std::vector<std::string> known = {std::string(names_of_tests), experiment_column_of(options)};
  for (const Dataset* part : parts)
    for (const Column& column : part->columns)
      known.push_back(column.name);
  for (const auto& [canonical, source] : options.columns)
    known.insert(known.end(), source.names.begin(), source.names.end());
  std::erase(known, "");
  const std::set<std::string> in_formulas = names_in_formulas(options);
  for (const std::string& name : options.fill_down) {
    const std::string bare = io::read_header_name(name).name;
    if (std::none_of(known.begin(), known.end(),
                     [&](const std::string& one) {
                       return one == name || one == bare || io::read_header_name(one).name == name;
                     }) &&
        !is_named_by(in_formulas, name) && !is_named_by(in_formulas, bare))
      faults.add(options.fill_down_place,
                 fmt::format("data.fill_down: the data have no column '{}'", name),
                 suggest(name, known));
  }
}

namespace {

constexpr const char *empty_cell = "an empty cell",
                     *no_row_left = "data.missing = \"drop\" leaves no row";

// Drops the rows without a number in this column, unless they are dropped already.
void drop_without(const Column& column, Part& part, std::vector<char>& keep) {
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const bool out = !std::isfinite(column.values[i]);
    dropped += out && keep[i];
    if (out) keep[i] = 0;
  }
  if (dropped > 0) part.data.dropped.push_back({"no " + column.name, dropped});
}

} // namespace

void drop_empty_rows(Part& part, const Reading& options) {
  if (options.missing != Missing::drop) return;
  std::set<std::size_t> raw_rows;
  for (const MappedFile::CellFault& cell : part.cell_faults)
    if (cell.missing) raw_rows.insert(cell.row);
  std::vector<char> keep;
  for (const std::size_t row : part.row)
    keep.push_back(raw_rows.count(row) == 0);
  const auto rows = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), 0));
  if (rows == 0) return;
  std::vector<Dataset::Dropped>& dropped = part.data.dropped;
  const auto known = std::find_if(dropped.begin(), dropped.end(),
                                  [](const auto& one) { return one.rule == empty_cell; });
  if (known == dropped.end())
    dropped.push_back({empty_cell, rows});
  else
    known->rows += rows;
  keep_rows(part, keep, no_row_left);
}

void drop_missing(Part& part, const Reading& options) {
  if (options.missing != Missing::drop) return;
  drop_empty_rows(part, options); // those that formulas found
  std::vector<char> keep(part.row.size(), 1);
  for (const Column& column : part.data.columns)
    if (options.needed && !find_quantity(column.name) && options.needed(column.name))
      drop_without(column, part, keep);
  keep_rows(part, keep, no_row_left);
}

// ---- phases ----

namespace {

// Reason for leaving out the rows of a phase.
const char* phase_rule(Phase phase) {
  if (phase == Phase::rest)
    return "at rest: without motion, by the speed, the path or the friction";
  if (phase == Phase::turning) return "turning: where a stroke begins and ends";
  return "unloaded: below 5 % of the load of its test";
}

// The left-out rows, with the columns used to plot a stroke.
std::shared_ptr<const Dataset> rows_aside(const Part& part, const std::vector<char>& keep,
                                          const std::vector<Phase>& phases) {
  const Dataset& data = part.data;
  const auto aside = std::make_shared<Dataset>();
  Column row{"row", "1", {}, {}}, phase{"phase", "", {}, {}};
  for (std::size_t p = 0; p < phase_count; ++p)
    phase.levels.emplace_back(phase_name(static_cast<Phase>(p)));
  std::sort(phase.levels.begin(), phase.levels.end());
  std::vector<const Column*> from;
  for (const Column& column : data.columns)
    if (column.name == "time_s" || column.name == "s_mm" || column.name == "tau_R_MPa") {
      from.push_back(&column);
      aside->columns.push_back({column.name, column.unit, {}, {}});
    }
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      if (keep[i]) continue;
      for (std::size_t c = 0; c < from.size(); ++c)
        aside->columns[c].values.push_back(from[c]->values[i]);
      row.values.push_back(static_cast<double>(i - data.first_row[e] + 1));
      const auto level = std::find(phase.levels.begin(), phase.levels.end(), phase_name(phases[i]));
      phase.values.push_back(static_cast<double>(level - phase.levels.begin()));
    }
    if (row.values.size() == aside->first_row.back()) continue;
    aside->experiments.push_back(data.experiments[e]);
    aside->first_row.push_back(row.values.size());
  }
  aside->columns.push_back(std::move(row));
  aside->columns.push_back(std::move(phase));
  return aside;
}

} // namespace

void leave_out_phases(Part& part, const std::vector<Phase>& phases, const Reading& options) {
  Dataset& data = part.data;
  if (!options.measured) return;
  std::vector<char> keep(phases.size(), 1);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    ++data.phases[static_cast<std::size_t>(phases[i])];
    keep[i] = is_fitted(phases[i]);
  }
  if (data.phases[static_cast<std::size_t>(Phase::unloaded)] > 0) count_unloaded(data);
  if (options.rows == UsedRows::all) return;
  for (std::size_t p = 0; p < phase_count; ++p)
    if (const auto phase = static_cast<Phase>(p); data.phases[p] > 0 && !is_fitted(phase))
      data.dropped.push_back({phase_rule(phase), data.phases[p]});
  if (std::count(keep.begin(), keep.end(), 0) == 0) return;
  data.aside = rows_aside(part, keep, phases);
  const std::vector<std::string> before = data.experiments;
  keep_rows(part, keep, nullptr);
  const std::set<std::string> left(data.experiments.begin(), data.experiments.end());
  std::copy_if(before.begin(), before.end(), std::back_inserter(data.at_rest),
               [&](const std::string& name) { return left.count(name) == 0; });
}

// ---- rows that no rig can measure ----

void leave_out_impossible(Part& part, const Reading& options) {
  Dataset& data = part.data;
  if (!options.measured || !part.faults.empty() || !data.has("tau_R_MPa") ||
      !data.has("sigma_n_MPa"))
    return;
  std::set<std::string> allowed(options.allow_implausible.begin(), options.allow_implausible.end());
  if (options.keep_spikes) allowed.insert("spike");
  std::vector<char> keep(part.row.size(), 1);
  std::size_t e = 0;
  for (const ImpossibleRow& found : impossible_rows(data, part.row, allowed)) {
    while (data.first_row[e + 1] <= found.row)
      ++e;
    keep[found.row] = 0;
    auto known = std::find_if(data.apart.begin(), data.apart.end(),
                              [&](const RowsApart& one) { return one.check == found.check; });
    if (known == data.apart.end())
      known = data.apart.insert(known, {found.check, impossible_text(found.check), 0, {}});
    if (++known->rows > RowsApart::named) continue;
    known->first.push_back(fmt::format("{} in test '{}' ({:.4g}{})",
                                       format_place(part.place(found.row)), data.experiments[e],
                                       found.value,
                                       found.check == "friction_coefficient" ? ""
                                       : found.check == "dropout"            ? " degC"
                                                                             : " MPa"));
  }
  for (const RowsApart& one : data.apart)
    data.dropped.push_back({one.what, one.rows});
  keep_rows(part, keep, nullptr);
}

// ---- a campaign ----

void tell(Dataset& data, std::string intervention) {
  data.notes.push_back(intervention);
  data.interventions.push_back(std::move(intervention));
}

bool look_again(const Dataset& data, Reading& options) {
  bool again = false;
  for (const RowsApart& one : data.apart)
    if (one.check == "spike" && is_more_than_few(one, data)) {
      options.keep_spikes = true;
      again = true;
    }
  if (data.rows() == 0 && !data.at_rest.empty()) {
    options.rows = UsedRows::all;
    again = true;
  }
  if (options.force_zero == ForceZero::automatic &&
      directions_differ(data) == DirectionsDiffer::by_friction) {
    options.force_zero = ForceZero::keep;
    again = true;
  }
  if (options.force_zero == ForceZero::automatic && hides_zero(data)) {
    options.force_zero = ForceZero::remove;
    again = true;
  }
  return again;
}

void report_rows_left_out(Dataset& data) {
  constexpr std::size_t named = 12;
  std::size_t all = 0, fitted = 0;
  for (std::size_t p = 0; p < phase_count; ++p) {
    all += data.phases[p];
    if (is_fitted(static_cast<Phase>(p))) fitted += data.phases[p];
  }
  if (all > 0 && fitted == 0)
    tell(data, "no row slides, by v_rel_mm_s and the load: all rows are taken");
  if (!data.at_rest.empty()) {
    std::vector<std::string> names = data.at_rest;
    const std::size_t more = names.size() - std::min(names.size(), named);
    names.resize(names.size() - more);
    tell(data,
         fmt::format("no row of {} slides: left out{} (data.rows = \"all\" takes them)",
                     names.size() + more == 1 ? "test '" + names[0] + "'"
                                              : thousands(names.size() + more) + " tests",
                     names.size() + more == 1 ? ""
                                              : ": " + join(names, ", ") + and_more(more, "test")));
  }
  for (const RowsApart& one : data.apart)
    tell(data, fmt::format("left out, {}: {}{}; data.allow_implausible = [\"{}\"] keeps {}",
                           one.what, join(one.first, ", "),
                           and_more(one.rows - std::min(one.rows, one.first.size()), "row"),
                           one.check, one.rows == 1 ? "it" : "them"));
}

} // namespace frictab::data
