// Lists findings on the data, tests and columns.
#include "words/data.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "core/text.h"
#include "data/condense.h"
#include "data/overview.h"
#include "data/phases.h"
#include "data/quantity.h"
#include "data/roles.h"
#include "words/judged.h"
#include "words/numbers.h"
#include "words/tables.h"

namespace frictab::words {

using data::Dataset;

namespace {

std::string span_text(double low, double high, int digits = 4) {
  const std::string first = short_figures(low, digits);
  return low == high ? first : first + " to " + short_figures(high, digits);
}

// Findings of one kind, of training and validation, each once.
class Findings {
public:
  Findings(List& list, const DataParts& parts) : list_(list), parts_(parts) {}

  template <class LinesOf> void add(const std::string& title, const LinesOf& lines_of) {
    std::vector<std::string> seen;
    for (const Dataset* part : {&parts_.training, &parts_.validation})
      for (const std::string& line : lines_of(*part))
        if (std::ranges::find(seen, line) == seen.end()) {
          seen.push_back(line);
          list_.items.push_back(title.empty() ? line : title + ": " + line);
        }
  }

private:
  List& list_;
  const DataParts& parts_;
};

std::vector<std::string> dropped_rows(const Dataset& data) {
  std::vector<std::string> lines;
  for (const Dataset::Dropped& dropped : data.dropped)
    lines.push_back(fmt::format("{}, {}", count_of(dropped.rows, "row"), dropped.rule));
  return lines;
}

std::vector<std::string> clock_offsets(const Dataset& data) {
  std::vector<std::string> lines;
  for (const data::ClockOffset& clock : data.clocks)
    lines.push_back(fmt::format("test {}: offset {:.5g} +- {:.2g}, correlation {:.4f}",
                                clock.experiment, clock.offset, clock.std_error,
                                clock.correlation));
  return lines;
}

std::vector<std::string> phases_of(const Dataset& data) {
  const std::string phases = phases_text(data);
  return phases.empty() ? std::vector<std::string>() : std::vector<std::string>{phases};
}

std::vector<std::string> files_of(const Dataset& data) {
  std::vector<std::string> files;
  for (const std::string& source : data.sources)
    files.push_back(shown_path(source));
  return files.empty() ? files : std::vector<std::string>{list_of(files)};
}

// Use of the tests of each part.
constexpr const char* uses[] = {"train", "validate"};

// Quantities that distinguish tests: states, time, the measured stress.
bool is_shown(const std::string& name) {
  const data::Quantity* quantity = data::find_quantity(name);
  return quantity && (quantity->state || name == "time_s" || name == "tau_R_MPa");
}

} // namespace

std::string shown_path(const std::string& path) {
  const std::filesystem::path p(path);
  return p.is_absolute() ? p.filename().string() : path;
}

Section data_read(const DataParts& parts, Detail detail) {
  const Dataset& t = parts.training;
  Section section{"data", "Data", "Data"};
  section.say(size_text(parts.judged_by, t, parts.validation) +
              (calibrate::is_synthetic(t) ? " - SYNTHETIC data" : ""));
  if (parts.judged_by == calibrate::JudgedBy::fit)
    section.say(
        "If they are of several tests, data.experiment names the column that distinguishes them.");
  section.say(sentence(uneven_text(parts.judged_by, t, parts.validation)));
  if (const std::string how = condensed_text(t, parts.validation); !how.empty())
    section.say("Rows are " + how + ".");
  List list;
  Findings findings(list, parts);
  if (detail != Detail::brief) {
    findings.add("files", files_of);
    findings.add("read", [](const Dataset& d) { return d.notes; });
    findings.add("joined", clock_offsets);
    findings.add("rows read", phases_of);
  }
  findings.add("caution", [](const Dataset& d) { return d.cautions; });
  findings.add("left out", dropped_rows);
  if (detail == Detail::brief) // among the conversions, if these are shown
    findings.add("", [](const Dataset& d) { return d.interventions; });
  findings.add("unit not given", [](const Dataset& d) { return d.unit_questions; });
  findings.add("implausible", [](const Dataset& d) { return d.implausible; });
  if (detail != Detail::brief)
    findings.add("in none of the data", [](const Dataset& d) { return d.unused; });
  section.add(std::move(list));
  return section;
}

namespace {

std::string line_text(std::size_t line) {
  return line > 0 ? thousands(line) : "\u2013";
}

Row file_row(const data::FileRead& first, std::size_t files, std::size_t rows) {
  return {{shown_path(first.file) + and_more(files - 1, "file"), first.form,
           line_text(first.header_line), line_text(first.units_line), thousands(rows),
           first.not_read.empty() ? "\u2013" : list_of(first.not_read)}};
}

} // namespace

Section files_read(const DataParts& parts) {
  Section section{"files", "Files", "Files"};
  Table table{"Files",
              {{"file"},
               {"form"},
               {"names in line", true},
               {"units in line", true},
               {"rows", true},
               {"not read"}}};
  std::vector<data::FileRead> files = parts.training.files;
  for (const data::FileRead& file : parts.validation.files)
    if (std::ranges::none_of(files,
                             [&](const data::FileRead& other) { return other.file == file.file; }))
      files.push_back(file);
  for (std::size_t i = 0, end = 0; i < files.size(); i = end) {
    std::size_t rows = 0;
    for (end = i; end < files.size() && files[end].is_like(files[i]); ++end)
      rows += files[end].rows;
    table.rows.push_back(file_row(files[i], end - i, rows));
  }
  section.add(std::move(table));
  return section;
}

Section tests(const DataParts& parts) {
  Section section{"tests", "Tests", "Tests"};
  section.say("Lowest to highest value of each quantity; means of mu = tau_R/sigma_N and of "
              "tau_R/k with k = sigma_f/\u221A3.",
              "", Shown::on_pages);
  Table table{"Tests",
              {{"test"}, {"use"}, {"rows", true}, {"mean mu", true}, {"mean tau_R/k", true}},
              {},
              "tests"};
  std::vector<std::string> shown;
  for (const data::Quantity& quantity : data::quantities())
    if (parts.training.has(quantity.name) && is_shown(quantity.name)) {
      shown.push_back(quantity.name);
      table.columns.push_back({quantity.name, true});
    }
  std::size_t use = 0;
  for (const Dataset* part : {&parts.training, &parts.validation}) {
    for (const data::TestOverview& test : data::overview(*part)) {
      Row row{{test.experiment, uses[use], thousands(test.rows), figures(test.mean_mu),
               test.mean_of_k ? figures(*test.mean_of_k) : "\u2013"}};
      for (const std::string& name : shown) {
        const auto at =
            std::ranges::find_if(test.spans, [&](const auto& span) { return span.first == name; });
        row.cells.emplace_back(
            at == test.spans.end() ? "\u2013" : span_text(at->second.first, at->second.second, 3));
      }
      table.rows.push_back(std::move(row));
    }
    ++use;
  }
  section.add(std::move(table));
  return section;
}

Section column_roles(const Dataset& data) {
  constexpr std::size_t most = 100;
  Section section{"columns", "Columns", "Other columns"};
  Table table{"Columns", {{"column"}, {"role"}, {"why"}}};
  std::size_t more = 0;
  for (const data::Column& column : data.columns)
    if (!data::find_quantity(column.name)) {
      if (table.rows.size() < most)
        table.rows.push_back({{column.name, data::role_name(column.role), column.why}});
      else
        ++more;
    }
  if (table.rows.empty()) return section;
  section.say("What each column is to friction. Settings and labels may be causes that a law "
              "lacks; channels and outcomes may follow from friction and are leads only; a "
              "response is the measured friction itself. [data.roles] overrules it.",
              "", Shown::on_pages);
  section.add(std::move(table));
  if (more > 0) section.say(and_more(more, "column"));
  return section;
}

Table ranges(const DataParts& parts) {
  Table table{"Ranges",
              {{"quantity"}, {"name"}, {"unit"}, {"training", true}, {"validation", true}}};
  const auto range_of = [](const Dataset& data, const std::string& name) -> std::string {
    if (!data.has(name)) return "\u2013";
    const auto [low, high] = data::source_range(data, name, data.values(name));
    return low <= high ? span_text(low, high) : "\u2013";
  };
  for (const data::Quantity& quantity : data::quantities())
    if (parts.training.has(quantity.name) || parts.validation.has(quantity.name))
      table.rows.push_back(
          {{quantity.meaning, code(quantity.name), unit_text(quantity.unit),
            range_of(parts.training, quantity.name), range_of(parts.validation, quantity.name)}});
  return table;
}

} // namespace frictab::words
