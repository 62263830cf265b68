// Data, tables and drift as rows of report.html.
#include "report/sections.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/text.h"
#include "data/quantity.h"
#include "report/number.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

std::string lines(const std::vector<std::string>& texts) {
  return texts.empty() ? "none" : join(texts, "<br/>");
}

// The same job in another place must give the same page: of absolute paths, only the name.
std::string file_name(const std::string& path) {
  const std::filesystem::path p(path);
  return svg::escape(p.is_absolute() ? p.filename().string() : path);
}

TemplateValues data_set(const std::string& use, const Dataset& data) {
  std::vector<std::string> files, dropped, notes;
  for (const std::string& source : data.sources)
    files.push_back("<code>" + file_name(source) + "</code>");
  for (const Dataset::Dropped& d : data.dropped)
    dropped.push_back(fmt::format("{}: {}", thousands(d.rows), svg::escape(d.rule)));
  for (const std::string& note : data.notes)
    notes.push_back(svg::escape(note));
  TemplateValues values;
  values.text = {{"use", use},
                 {"files", lines(files)},
                 {"experiments", thousands(data.experiments.size())},
                 {"rows", thousands(data.rows())},
                 {"dropped", lines(dropped)},
                 {"notes", lines(notes)}};
  return values;
}

std::string range_text(const Dataset& data, const std::string& name) {
  const Column* column = data.find(name);
  if (!column || column->values.empty()) return "n/a";
  std::vector<double> v = column->values;
  std::sort(v.begin(), v.end());
  return fmt::format("{}, {}, {}", number(v.front()), number(v[v.size() / 2]), number(v.back()));
}

std::string table_text(const Table& table) {
  std::string text;
  if (table.axes.empty()) {
    text = "One constant: the law's tabulated piece depends on no state.";
  } else {
    std::vector<std::string> sizes;
    for (const TableAxis& axis : table.axes)
      sizes.push_back(thousands(axis.nodes.size()));
    text = fmt::format("{} = {} nodes, {}; {} interpolation of {}{}.", join(sizes, " \u00d7 "),
                       thousands(table.nodes()), human_bytes(static_cast<double>(table.bytes())),
                       svg::escape(table.interpolation), table.log_value ? "ln " : "",
                       svg::escape(table.quantity));
  }
  text += " tau_R_MPa = <span class=\"mono\">" + svg::escape(to_text(table.combine)) + "</span>";
  return text;
}

// What else the table says of itself, as a sentence each.
std::string table_details(const Table& table) {
  std::vector<std::string> details;
  const auto& numbers = table.number_attributes;
  const auto& texts = table.text_attributes;
  if (const auto found = numbers.find("tolerance_MPa"); found != numbers.end())
    details.push_back("Grid made for a drift of at most " + number(found->second) + " MPa.");
  if (const auto found = texts.find("refinement"); found != texts.end())
    details.push_back("Refinement, largest drift found: " + svg::escape(found->second) + ".");
  if (const auto found = numbers.find("worst_case_MPa"); found != numbers.end())
    details.push_back("Worst case found when verified: " + number(found->second) + " MPa.");
  std::vector<std::string> ranges;
  for (const auto& [name, value] : table.constants)
    ranges.push_back("<code>" + svg::escape(name) + "</code> = " + number(value, 4));
  if (!ranges.empty()) details.push_back("Constants: " + join(ranges, ", ") + ".");
  return details.empty() ? "" : "<p class=\"soft\">" + join(details, "<br/>") + "</p>";
}

TemplateValues axis_values(const Table& table, const TableAxis& axis) {
  std::string low = "n/a", high = "n/a";
  if (!axis.nodes.empty()) low = number(axis.nodes.front()), high = number(axis.nodes.back());
  std::string meaning = svg::escape(axis.long_name);
  const auto from = table.text_attributes.find("range_from_" + axis.name);
  if (from != table.text_attributes.end())
    meaning += "<br/><span class=\"small\">range: " + svg::escape(from->second) + "</span>";
  TemplateValues values;
  values.text = {{"name", svg::escape(axis.name)},
                 {"meaning", meaning},
                 {"unit", svg::escape(axis.unit)},
                 {"low", low},
                 {"high", high},
                 {"nodes", thousands(axis.nodes.size())},
                 {"spacing", axis.log ? "logarithm" : "value itself"}};
  return values;
}

std::string where(const DriftRecord& record) {
  std::string text;
  for (const auto& [name, value] : record.worst_state)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", svg::escape(name), number(value, 4));
  const auto add = [&](const std::string& line) { text += (text.empty() ? "" : "<br/>") + line; };
  if (record.n_outside > 0)
    add(fmt::format("outside the range, clamped: up to {} MPa from the law",
                    number(record.max_abs_outside_MPa)));
  if (record.max_vs_table_MPa > 0)
    add(fmt::format("up to {} MPa from the table", number(record.max_vs_table_MPa)));
  if (!record.ran) add("Not run: " + svg::escape(record.why_not));
  return text;
}

} // namespace

Items data_sets(const ReportInput& input) {
  return {data_set("calibration", input.training), data_set("validation", input.validation)};
}

Items columns(const ReportInput& input) {
  Items items;
  for (const Quantity& quantity : quantities())
    if (input.training.has(quantity.name) || input.validation.has(quantity.name))
      items.emplace_back().text = {{"name", svg::escape(quantity.name)},
                                   {"meaning", svg::escape(quantity.meaning)},
                                   {"unit", svg::escape(quantity.unit)},
                                   {"training", range_text(input.training, quantity.name)},
                                   {"validation", range_text(input.validation, quantity.name)}};
  return items;
}

Items tables(const std::vector<Table>& tables) {
  Items items;
  for (const Table& table : tables) {
    TemplateValues& values = items.emplace_back();
    values.text = {{"model", svg::escape(table.model)},
                   {"text", table_text(table)},
                   {"details", table_details(table)}};
    values.flags["has_axes"] = !table.axes.empty();
    Items& axes = values.lists["axes"];
    for (const TableAxis& axis : table.axes)
      axes.push_back(axis_values(table, axis));
  }
  return items;
}

Items records(const Verification& verification) {
  Items items;
  for (const DriftRecord& r : verification.records) {
    const bool rows = r.ran && r.n_rows > r.n_outside;
    const auto on_rows = [&](double value) { return rows ? number(value) : "n/a"; };
    items.emplace_back().text = {{"model", svg::escape(r.model)},
                                 {"subject", svg::escape(r.subject)},
                                 {"css", !r.ran     ? "idle"
                                         : r.passed ? "pass"
                                                    : "fail"},
                                 {"result", !r.ran     ? "not run"
                                            : r.passed ? "pass"
                                                       : "FAIL"},
                                 {"worst", r.ran ? number(r.worst_case_MPa) : "n/a"},
                                 {"max", on_rows(r.rows.max_abs)},
                                 {"mean", on_rows(r.rows.mean_abs)},
                                 {"rms", on_rows(r.rows.rms)},
                                 {"p99", on_rows(r.rows.p99)},
                                 {"outside", r.ran ? percent(r.n_outside, r.n_rows) : "n/a"},
                                 {"where", where(r)}};
  }
  return items;
}

} // namespace frictab::report
