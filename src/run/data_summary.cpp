// Lists the tests as lines of a table.
#include "run/data_summary.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/calibration.h"
#include "core/text.h"
#include "data/append.h"
#include "data/overview.h"
#include "data/phases.h"
#include "data/quantity.h"
#include "data/roles.h"
#include "io/json.h"
#include "report/judged.h"
#include "report/numbers.h"

namespace frictab::run {

namespace {

using data::Dataset;
using Json = nlohmann::ordered_json;

const char* const uses[] = {"train", "validate"};

using Cells = std::vector<std::string>;

std::string span_text(const std::pair<double, double>& span) {
  const std::string low = report::short_figures(span.first, 3);
  return span.first == span.second ? low : low + ".." + report::short_figures(span.second, 3);
}

bool is_shown(const std::string& name) {
  const data::Quantity* quantity = data::find_quantity(name);
  return quantity->state || name == "time_s" || name == "tau_R_MPa";
}

Cells header_of(const Dataset& data) {
  Cells cells = {"test", "use", "rows", "mean mu", "tau_R/k"};
  for (const data::Quantity& quantity : data::quantities())
    if (data.has(quantity.name) && is_shown(quantity.name)) cells.push_back(quantity.name);
  return cells;
}

Cells cells_of(const data::TestOverview& test, const char* use) {
  Cells cells = {test.experiment, use, thousands(test.rows), report::figures(test.mean_mu),
                 test.mean_of_k ? report::figures(*test.mean_of_k) : "-"};
  for (const auto& [name, span] : test.spans)
    if (is_shown(name)) cells.push_back(span_text(span));
  return cells;
}

// Pads columns to their widest cell; aligns the first `names` columns left, numbers right.
std::string aligned(const std::vector<Cells>& rows, std::size_t names = 2) {
  std::vector<std::size_t> width(rows.front().size());
  for (const Cells& cells : rows)
    for (std::size_t i = 0; i < cells.size(); ++i)
      width[i] = std::max(width[i], fmt::formatted_size("{}", cells[i]));
  std::string out;
  for (const Cells& cells : rows) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
      line += i < names ? fmt::format("{:<{}}  ", cells[i], width[i])
                        : fmt::format("{:>{}}  ", cells[i], width[i]);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

void add_lines(std::string& out, const char* title, const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    out += fmt::format("{}: {}\n", title, line);
}

std::vector<std::string> dropped_lines(const Dataset& data) {
  std::vector<std::string> lines;
  for (const Dataset::Dropped& dropped : data.dropped)
    lines.push_back(fmt::format("{} rows, {}", thousands(dropped.rows), dropped.rule));
  return lines;
}

// Notes of training and validation, each once.
std::vector<std::string> notes_of(const JobData& data) {
  std::vector<std::string> notes = data.training.notes;
  for (const std::string& note : data.validation.notes)
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  return notes;
}

std::string clock_text(const data::ClockOffset& clock) {
  return fmt::format("test {}: offset {:.5g} +- {:.2g}, correlation {:.4f}", clock.experiment,
                     clock.offset, clock.std_error, clock.correlation);
}

// Roles of the columns in friction; leaves out quantities, whose names state their role.
std::string roles_text(const Dataset& data) {
  constexpr std::size_t shown = 100;
  std::vector<Cells> rows = {{"column", "role", "why"}};
  std::size_t more = 0;
  for (const data::Column& column : data.columns)
    if (!data::find_quantity(column.name)) {
      if (rows.size() <= shown)
        rows.push_back({column.name, data::role_name(column.role), column.why});
      else
        ++more;
    }
  return rows.size() == 1 ? "" : aligned(rows, 3) + (more ? and_more(more, "column") + "\n" : "");
}

Json roles_json(const Dataset& data) {
  Json roles = Json::array();
  for (const data::Column& column : data.columns)
    roles.push_back(
        {{"column", column.name}, {"role", data::role_name(column.role)}, {"why", column.why}});
  return roles;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json test_json(const data::TestOverview& test, const char* use) {
  Json json = {{"experiment", test.experiment},
               {"use", use},
               {"rows", test.rows},
               {"mean_mu", number(test.mean_mu)},
               {"mean_tau_R_over_k", test.mean_of_k ? number(*test.mean_of_k) : Json()},
               {"spans", Json::object()}};
  for (const auto& [name, span] : test.spans)
    json["spans"][name] = {number(span.first), number(span.second)};
  return json;
}

} // namespace

std::string data_text(const JobData& data) {
  std::vector<Cells> rows = {header_of(data.training)};
  std::size_t use = 0;
  for (const Dataset* part : {&data.training, &data.validation}) {
    for (const data::TestOverview& test : data::overview(*part))
      rows.push_back(cells_of(test, uses[use]));
    ++use;
  }
  std::string out = aligned(rows) + "\n";
  add_lines(out, "read", notes_of(data));
  for (const Dataset* part : {&data.training, &data.validation}) {
    for (const data::ClockOffset& clock : part->clocks)
      out += "joined: " + clock_text(clock) + "\n";
    if (const std::string phases = report::phases_text(*part); !phases.empty())
      out += "rows read: " + phases + "\n";
    add_lines(out, "left out", dropped_lines(*part));
    add_lines(out, "unit not given", part->unit_questions);
    add_lines(out, "implausible", part->implausible);
  }
  add_lines(out, "in none of the data", data.training.unused);
  if (const std::string roles = roles_text(data.training); !roles.empty())
    out += "\n" + roles + "\n";
  if (const std::string how = report::condensed_text(data.training, data.validation); !how.empty())
    out += "rows are " + how + "\n";
  if (const std::string how = report::uneven_text(data.judged_by, data.training, data.validation);
      !how.empty())
    out += how + "\n";
  return out + report::size_text(data.judged_by, data.training, data.validation) +
         (calibrate::is_synthetic(data.training) ? " - SYNTHETIC data\n" : "\n");
}

std::string data_json(const JobData& data) {
  Json json = {{"synthetic_data", calibrate::is_synthetic(data.training)},
               {"tests", Json::array()},
               {"read", notes_of(data)},
               {"phases", Json::object()},
               {"left_out", Json::array()},
               {"clocks", Json::array()},
               {"units_not_given", Json::array()},
               {"implausible", Json::array()},
               {"unused", data.training.unused},
               {"columns", roles_json(data.training)}};
  std::size_t use = 0;
  for (const Dataset* part : {&data.training, &data.validation}) {
    for (const data::TestOverview& test : data::overview(*part))
      json["tests"].push_back(test_json(test, uses[use]));
    for (std::size_t p = 0; p < data::phase_count; ++p) {
      Json& count = json["phases"][data::phase_name(static_cast<data::Phase>(p))];
      count = (count.is_null() ? 0 : count.get<std::size_t>()) + part->phases[p];
    }
    for (const Dataset::Dropped& dropped : part->dropped)
      json["left_out"].push_back({{"rule", dropped.rule}, {"rows", dropped.rows}});
    for (const data::ClockOffset& clock : part->clocks)
      json["clocks"].push_back({{"experiment", clock.experiment},
                                {"offset", number(clock.offset)},
                                {"std_error", number(clock.std_error)},
                                {"correlation", number(clock.correlation)}});
    for (const std::string& line : part->unit_questions)
      json["units_not_given"].push_back(line);
    for (const std::string& line : part->implausible)
      json["implausible"].push_back(line);
    ++use;
  }
  return io::json_text(json);
}

Dataset canonical(const JobData& data) {
  Dataset all = data.training;
  const auto with_use = [](Dataset& part, std::size_t use) {
    if (part.has("use")) return; // from an earlier call: canonical data that were read again
    part.columns.push_back(
        {"use", "", std::vector<double>(part.rows(), 0.0), {std::string(uses[use])}});
  };
  with_use(all, 0);
  Dataset validation = data.validation;
  with_use(validation, 1);
  FaultList faults;
  data::append(all, std::move(validation), "data.validation", faults);
  faults.throw_if_any();
  return all;
}

} // namespace frictab::run
