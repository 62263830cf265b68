// Prints data, laws, effects, tables and drift; the findings in short; the files written.
#include "run/summary.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "codegen/table_text.h"
#include "core/column_width.h"
#include "core/text.h"
#include "report/judged.h"
#include "report/numbers.h"
#include "run/ranking_text.h"
#include "table/beyond_data.h"
#include "table/distance.h"
#include "trace/trace_text.h"
#include "verify/forms.h"

namespace frictab::run {

namespace {

std::string data_text(const Run& run) {
  if (!run.data) return "";
  const data::Dataset &training = run.data->training, &validation = run.data->validation;
  const bool synthetic = calibrate::is_synthetic(training);
  std::string out =
      fmt::format("Data: {}{}\n", report::size_text(run.data->judged_by, training, validation),
                  synthetic ? " - SYNTHETIC data" : "");
  if (run.data->judged_by == calibrate::JudgedBy::fit)
    out += "  if they are of several tests, data.experiment names the column that distinguishes "
           "them\n";
  if (const std::string how = report::condensed_text(training, validation); !how.empty())
    out += "  " + how + "\n";
  if (const std::string how = report::uneven_text(run.data->judged_by, training, validation);
      !how.empty())
    out += "  " + how + "\n";
  for (const data::Dataset* data : {&training, &validation})
    for (const auto& dropped : data->dropped)
      out +=
          fmt::format("  left out: {}, {}\n", report::count_of(dropped.rows, "row"), dropped.rule);
  for (const data::Dataset* data : {&training, &validation})
    for (const std::string& line : data->interventions)
      out += "  " + line + "\n";
  for (const data::Dataset* data : {&training, &validation})
    for (const std::string& line : data->unit_questions)
      out += "  unit not given: " + line + "\n";
  for (const data::Dataset* data : {&training, &validation})
    for (const std::string& line : data->implausible)
      out += "  implausible: " + line + "\n";
  return out;
}

// Largest node count for which linear tables compile fast and fit into a core's cache.
constexpr std::size_t many_nodes = 50000;

std::string tables_text(const Run& run) {
  if (run.tables.empty()) return "";
  std::string out = "\nTables:\n";
  std::vector<std::string> names;
  for (const table::Table& table : run.tables)
    names.push_back(table.model);
  const std::size_t width = column_width(names);
  for (const table::Table& table : run.tables) {
    std::string grid;
    for (const table::TableAxis& axis : table.axes)
      grid += fmt::format("{}{} {}", grid.empty() ? "" : " x ", axis.nodes.size(), axis.name);
    if (grid.empty()) grid = "a constant";
    out += fmt::format("  {:<{}} {}, {}: {}{}\n", table.model, width,
                       report::count_of(table.nodes(), "node"),
                       human_bytes(static_cast<double>(table.bytes())), grid,
                       table.axes.empty() || table.interpolation == table::Interpolation::linear
                           ? ""
                           : ", " + std::string(table::interpolation_name(table.interpolation)));
    if (const std::string edge = codegen::edge_text(table); !edge.empty())
      out += fmt::format("  {:<{}} {}\n", "", width, edge);
    for (const table::TableAxis& axis : table.axes)
      if (const std::string beyond = table::beyond_data_text(axis); !beyond.empty())
        out += fmt::format("  {:<{}} {}: {}\n", "", width, axis.name, beyond);
    for (const auto& [name, input] : table.record.inputs)
      if (input.held_why) out += fmt::format("  {:<{}} {}: {}\n", "", width, name, *input.held_why);
    if (const std::string far = table::distance_text(table); !far.empty())
      out += fmt::format("  {:<{}} {}\n", "", width, far);
    if (table.interpolation == table::Interpolation::linear && table.nodes() > many_nodes)
      out += fmt::format("  {:<{}} table.interpolation = \"cubic\" needs far fewer nodes where the "
                         "law is smooth\n",
                         "", width);
  }
  return out;
}

// Groups files by directory: "report.html, models/ (15), ...".
std::string file_list(const std::vector<std::string>& files) {
  std::vector<std::pair<std::string, std::size_t>> groups;
  for (const std::string& file : files) {
    const std::size_t slash = file.find('/');
    const std::string name = slash == std::string::npos ? file : file.substr(0, slash + 1);
    if (groups.empty() || groups.back().first != name) groups.emplace_back(name, 0);
    ++groups.back().second;
  }
  std::string text;
  for (const auto& [name, count] : groups)
    text += (text.empty() ? "" : ", ") + name +
            (name.back() == '/' ? fmt::format(" ({})", count) : std::string());
  return text;
}

// Suggests the next step: fix the drift, open the page, or run the next stage.
std::string next_step(const Run& run) {
  const std::vector<std::string> files = run.workspace.files();
  const auto wrote = [&](std::string_view start) {
    return std::any_of(files.begin(), files.end(),
                       [&](const std::string& file) { return file.starts_with(start); });
  };
  const std::string page = (std::filesystem::path(run.job.directory) / "report.html").string();
  if (wrote("report.html")) return "open " + shell_word(page);
  const std::string job = " " + run.job.arguments();
  if (wrote("verify.json"))
    return run.verification->passed() && run.missed.empty()
               ? "frictab report" + job
               : "a smaller table.tolerance_MPa, then frictab tabulate" + job;
  if (wrote("export/")) return "frictab verify" + job;
  if (wrote("tables/")) return "frictab export" + job;
  return "frictab tabulate" + job;
}

void add_in_short(std::string& out, const Run& run) {
  std::vector<std::pair<const char*, std::string>> lines;
  if (run.calibration) lines.emplace_back("best law", best_law_in_short(*run.calibration));
  if (run.verification) lines.emplace_back("tables", drift_in_short(*run.verification));
  for (const trace::Trace& t : run.traces)
    lines.emplace_back("missing", trace::trace_in_short(t));
  lines.emplace_back("form", verify::forms_in_short(run.forms));
  out += "\nIn short:\n";
  for (const auto& [what, text] : lines)
    if (!text.empty()) out += fmt::format("  {:<10}{}\n", what, text);
}

} // namespace

std::string summary_text(const Run& run, Detail detail) {
  std::string out = data_text(run);
  if (run.calibration) out += "\n" + ranking_text(*run.calibration);
  for (const trace::Trace& trace : run.traces)
    out += "\n" + (detail == Detail::brief ? trace::trace_brief(trace)
                                           : trace::trace_text(trace, detail == Detail::verbose));
  out += tables_text(run);
  if (run.verification && !run.verification->records.empty())
    out += "\n" + drift_text(*run.verification, detail);
  if (detail != Detail::brief && !run.forms.empty()) out += "\n" + verify::forms_text(run.forms);
  if (detail == Detail::brief) add_in_short(out, run);
  const auto files = run.workspace.files();
  out += fmt::format("\nWrote {} to {}: {}\n", report::count_of(files.size(), "file"),
                     run.job.directory, file_list(files));
  return out + "next: " + next_step(run) + "\n";
}

} // namespace frictab::run
