// Writes the summary as one JSON object.
#include <nlohmann/json.hpp>

#include "calibrate/calibration_file.h"
#include "io/json.h"
#include "process/process_json.h"
#include "run/summary.h"
#include "table/beyond_data.h"
#include "trace/trace_file.h"
#include "verify/verify.h"
#include "words/judged.h"
#include "words/process.h"
#include "words/render.h"

namespace frictab::run {

namespace {

nlohmann::ordered_json form_json(const verify::FormComparison& c) {
  const auto figures = [&](const verify::FormFigures& f) {
    nlohmann::ordered_json j = {{"bytes", f.bytes}, {"drift_MPa", f.drift_MPa}};
    if (c.why_not.empty()) j["ns_per_query"] = f.ns_per_query;
    return j;
  };
  return {{"model", c.model},
          {"table", figures(c.table)},
          {"direct", figures(c.direct)},
          {"verdict", verify::form_verdict(c)}};
}

nlohmann::ordered_json table_json(const table::Table& table) {
  nlohmann::ordered_json j = {
      {"model", table.model}, {"nodes", table.nodes()}, {"bytes", table.bytes()}};
  if (table.record.share_far) j["share_far"] = *table.record.share_far;
  for (const table::TableAxis& axis : table.axes)
    if (axis.data)
      j["axes"].push_back({{"name", axis.name},
                           {"range", {axis.nodes.front(), axis.nodes.back()}},
                           {"data", {axis.data->first, axis.data->second}},
                           {"share_beyond_data", table::share_beyond_data(axis)}});
  return j;
}

nlohmann::ordered_json condensed_json(const JobData& data) {
  return {{"rows", data.training.source_rows() + data.validation.source_rows()},
          {"blocks", data.training.rows() + data.validation.rows()},
          {"from_blocks", words::from_blocks()}};
}

} // namespace

std::string summary_json(const Run& run) {
  nlohmann::ordered_json j = {{"schema", "frictab/summary/1"}, {"job", run.job.file}};
  if (run.data) j["synthetic_data"] = calibrate::is_synthetic(run.data->training);
  if (run.data) j["cautions"] = run.data->training.cautions;
  if (run.data && run.data->training.condensed) j["condensed"] = condensed_json(*run.data);
  if (run.calibration)
    j["calibration"] =
        io::parse_json(calibrate::calibration_json(*run.calibration), "calibration.json");
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  for (const table::Table& table : run.tables)
    tables.push_back(table_json(table));
  if (!tables.empty()) j["tables"] = tables;
  if (run.verification)
    j["verification"] = io::parse_json(verify::verification_json(*run.verification), "verify.json");
  if (!run.traces.empty())
    j["trace"] = io::parse_json(trace::trace_json(run.traces, j.value("synthetic_data", false)),
                                "trace.json");
  if (run.process)
    j["process"] = io::parse_json(
        process::process_json(*run.process,
                              words::as_json(words::process_in_short(*run.process))["lines"]),
        "process.json");
  for (const verify::FormComparison& form : run.forms)
    j["forms"].push_back(form_json(form));
  const words::Answers answers = answers_of(run);
  j["in_short"] = words::as_json(words::in_short(answers))["lines"];
  words::add_answers(j, answers);
  j["directory"] = run.job.directory;
  j["files"] = run.workspace.files();
  return io::json_text(j);
}

} // namespace frictab::run
