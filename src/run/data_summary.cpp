// Text and JSON of the data as read.
#include "run/data_summary.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "calibrate/calibration.h"
#include "data/append.h"
#include "data/overview.h"
#include "data/phases.h"
#include "data/roles.h"
#include "io/json.h"
#include "words/data.h"
#include "words/render.h"

namespace frictab::run {

namespace {

using data::Dataset;
using Json = nlohmann::ordered_json;

const char* const uses[] = {"train", "validate"};

// Notes of training and validation, each once.
std::vector<std::string> notes_of(const JobData& data) {
  std::vector<std::string> notes = data.training.notes;
  for (const std::string& note : data.validation.notes)
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  return notes;
}

Json roles_json(const Dataset& data) {
  Json roles = Json::array();
  for (const data::Column& column : data.columns)
    roles.push_back(
        {{"column", column.name}, {"role", data::role_name(column.role)}, {"why", column.why}});
  return roles;
}

Json files_json(const JobData& data) {
  Json files = Json::array();
  for (const Dataset* part : {&data.training, &data.validation})
    for (const data::FileRead& file : part->files) {
      Json json = {{"file", file.file},
                   {"form", file.form},
                   {"header_line", file.header_line},
                   {"units_line", file.units_line},
                   {"rows", file.rows},
                   {"not_read", file.not_read}};
      if (std::find(files.begin(), files.end(), json) == files.end())
        files.push_back(std::move(json));
    }
  return files;
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
  const words::DataParts parts{data.training, data.validation, data.judged_by};
  std::string out = words::as_text(words::tests(parts)) + "\n";
  if (const words::Section roles = words::column_roles(data.training); !roles.blocks.empty())
    out += words::as_text(roles) + "\n";
  out += words::as_text(words::files_read(parts)) + "\n";
  return out + words::as_text(words::data_read(parts, words::Detail::full));
}

std::string data_json(const JobData& data) {
  Json json = {{"synthetic_data", calibrate::is_synthetic(data.training)},
               {"tests", Json::array()},
               {"files", files_json(data)},
               {"read", notes_of(data)},
               {"phases", Json::object()},
               {"left_out", Json::array()},
               {"clocks", Json::array()},
               {"units_not_given", Json::array()},
               {"implausible", Json::array()},
               {"cautions", data.training.cautions},
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
