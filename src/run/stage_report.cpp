// Stage report: writes report.html, explore.html, report.md and summary.json from all results.
#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "calibrate/experiment_errors.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "report/explore.h"
#include "report/report.h"
#include "run/law_accuracy.h"
#include "run/stage_functions.h"

namespace frictab::run {

namespace fs = std::filesystem;
using table::Table;

namespace {

// Name of the campaign: that of the job file, or of its folder if the file is called job.toml.
std::string campaign_name(const std::string& job_file) {
  const fs::path file(job_file);
  const std::string folder = fs::absolute(file).parent_path().filename().string();
  return file.filename() == "job.toml" && !folder.empty() ? folder : file.filename().string();
}

// The file that this run has made, otherwise that in the directory.
fs::path newest(const Run& run, const std::string& path) {
  const std::vector<std::string> made = run.workspace.files();
  return std::ranges::find(made, path) != made.end() ? run.workspace.staged(path)
                                                     : fs::path(run.path(path));
}

// Recipes of the sources made in this run, otherwise of those in the directory.
std::vector<words::Recipe> recipes_of(const Run& run) {
  std::vector<words::Recipe> found;
  for (const codegen::Exporter* exporter : codegen::exporters_named(run.job.exports.targets))
    for (const Table& table : run.tables) {
      const std::string path = export_directory(run, exporter->name, table) + "/recipe.json";
      if (const fs::path file = newest(run, path); fs::exists(file))
        found.push_back({path, io::read_file(file)});
    }
  return found;
}

// States of the process judged in this command, or else earlier; empty without one.
std::map<std::string, std::vector<double>> states_of_process(const Run& run) {
  const fs::path file = newest(run, "process.json");
  if (!fs::exists(file)) return {};
  return io::parse_json(io::read_file(file), file.string())
      .value("states", std::map<std::string, std::vector<double>>());
}

} // namespace

void write_report(Run& run) {
  for (const char* optional : {"verify", "trace"})
    if (!run.present.count(optional)) {
      stage_named(optional).load(run, "report");
      run.present.insert(optional);
    }
  std::vector<std::vector<double>> predicted;
  for (const calibrate::ModelFit& fit : run.calibration->fits)
    predicted.push_back(calibrate::predict(fit.model, run.data->judged()));
  std::vector<verify::FormComparison> sizes;
  for (const Table& table : run.tables)
    sizes.push_back(verify::form_sizes(law_of(run, table), table));
  std::vector<std::string> written = run.workspace.files();
  written.insert(written.end(), {"report.html", "explore.html", "report.md", "summary.json"});
  const report::ReportInput input{
      campaign_name(run.job.file),
      fs::path(run.job.file).filename().string(),
      *run.calibration,
      run.data->training,
      run.data->judged(),
      std::move(predicted),
      run.tables,
      *run.verification,
      std::move(written),
      std::move(sizes),
      run.traces,
      calibrate::errors_by_experiment(*run.calibration, run.data->training, run.data->judged()),
      recipes_of(run),
      states_of_process(run)};
  run.workspace.write("report.html", report::report_html(input));
  run.workspace.write("explore.html", report::explore_html(input));
  run.workspace.write("report.md", report::report_md(input));
  run.workspace.write("summary.json", report::report_json(input));
  run.present.insert("report");
}

} // namespace frictab::run
