// Makes again what can be made again, and takes the rest from stages.json.
#include "run/origins.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "calibrate/calibration_file.h"
#include "codegen/recipe.h"
#include "core/error.h"
#include "io/file_streams.h"
#include "run/chosen.h"
#include "run/law_accuracy.h"
#include "run/stage_functions.h"
#include "verify/compare_table.h"
#include "verify/compare_text.h"

namespace frictab::run {

namespace fs = std::filesystem;

using table::Table;
using verify::Finding;

namespace {

std::string mend_of(const Run& run) {
  return fmt::format("`frictab run {}` makes it again", run.job.arguments());
}

// Adds the law and the mend to what was found in its files.
std::vector<Finding> completed(const Run& run, const std::string& model,
                               std::vector<Finding> findings) {
  for (Finding& finding : findings) {
    finding.model = model;
    if (finding.failed) finding.mend = mend_of(run);
  }
  return findings;
}

void append(std::vector<Finding>& to, std::vector<Finding> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::string model_path(const calibrate::ModelFit& fit) {
  return "models/" + fit.model.law->name + ".json";
}

void check_sources_there(const Run& run, const Table& table, FaultList& faults) {
  for (const codegen::Exporter* exporter : codegen::exporters_named(run.job.exports.targets)) {
    const fs::path place = run.path(source_directory(run, *exporter, table)),
                   recipe = place / "recipe.json";
    const std::string mend = fmt::format("`frictab export {}` makes them", run.job.arguments());
    if (!fs::is_directory(place)) {
      faults.add({run.path(export_directory(run, exporter->name, table)), 0, 0},
                 "there are no generated sources", mend);
      continue;
    }
    if (!fs::exists(recipe)) {
      faults.add({recipe.string(), 0, 0}, "no such file", mend);
      continue;
    }
    for (const std::string& file : codegen::files_of_recipe(io::read_file(recipe), recipe.string()))
      if (!fs::exists(place / file))
        faults.add({(place / file).string(), 0, 0}, "no such file", mend);
  }
}

} // namespace

void check_all_there(const Run& run) {
  FaultList faults;
  const std::string mend = fmt::format("`frictab run {}` makes it", run.job.arguments());
  for (const calibrate::ModelFit& fit : run.calibration->fits)
    if (const std::string file = run.path(model_path(fit)); !fs::exists(file))
      faults.add({file, 0, 0}, "no such file", mend);
  for (const models::Model& model : models_to_tabulate(*run.calibration, run.job.table)) {
    const bool is_there = std::ranges::any_of(
        run.tables, [&](const Table& table) { return table.model == model.name(); });
    if (!is_there)
      faults.add({run.path("tables/" + model.name() + ".h5"), 0, 0}, "no such file", mend);
  }
  for (const Table& table : run.tables)
    check_sources_there(run, table, faults);
  faults.throw_if_any();
}

std::vector<Finding> compare_models(const Run& run) {
  std::vector<Finding> findings;
  const auto add = [&](const std::string& model, std::vector<Finding> found) {
    append(findings, completed(run, model, std::move(found)));
  };
  for (const calibrate::ModelFit& fit : run.calibration->fits) {
    const std::string file = run.path(model_path(fit));
    add(fit.model.law->name,
        verify::compare_json(io::read_file(file), calibrate::model_json(fit, *run.calibration),
                             file));
  }
  if (!run.workspace.record().is_as_written("trace.json").value_or(true))
    add("", {{"", run.path("trace.json"), "", "was changed since `frictab trace` wrote it", ""}});
  return findings;
}

namespace {

// The table as this job makes it, on the nodes of `grid` or, without it, on nodes searched again.
Table wanted_table(const Run& run, const models::AssembledLaw& law, const Table* grid,
                   const verify::DriftRecord& drift) {
  Table wanted = sampled_table(run, law, grid);
  verify::set_drift(wanted.record, drift);
  return wanted;
}

// The drift of the table as tabulate measured it: with the tolerance that the table is made to.
verify::DriftRecord drift_to_tolerance(const Run& run, const models::AssembledLaw& law,
                                       const Table& table) {
  verify::VerifyInput input = verify_input(run, law, table, table.model);
  input.max_drift_MPa = *table_options(run, law.model).tolerance_MPa;
  return verify::verify(input, {}).front();
}

bool any_drift_figure(const std::vector<Finding>& findings) {
  return std::ranges::any_of(findings, verify::is_drift_figure);
}

} // namespace

std::vector<Finding> compare_table(const Run& run, const models::AssembledLaw& law,
                                   const Table& table, const verify::DriftRecord& drift) {
  const std::string path = "tables/" + table.model + ".h5", file = run.path(path);
  const std::optional<bool> recorded = run.workspace.record().is_as_written(path);
  const bool as_written = recorded.value_or(false);
  const auto found_on = [&](const Table* grid, const verify::DriftRecord& measured) {
    return verify::compare_table(file, wanted_table(run, law, grid, measured));
  };
  std::vector<Finding> findings = found_on(&table, drift);
  if (any_drift_figure(findings) &&
      drift.allowed_MPa != table_options(run, law.model).tolerance_MPa)
    findings = found_on(&table, drift_to_tolerance(run, law, table));
  // [verify] may have had other samples and boxes when tabulate wrote the file: then its figures
  // are of another search, and only a drift found above the proven one contradicts them.
  const double claimed = table.record.proven_drift_MPa.value_or(HUGE_VAL);
  if (as_written && drift.worst_case_MPa <= claimed)
    std::erase_if(findings, verify::is_drift_figure);
  const bool right = std::ranges::none_of(findings, &Finding::failed);
  if (right && !as_written) {
    append(findings, found_on(nullptr, drift));
    if (findings.empty() && recorded)
      findings.push_back({"", file, "",
                          "is not stored as it was written; its values and attributes are right",
                          "", false});
  }
  return completed(run, table.model, std::move(findings));
}

std::vector<Finding> compare_sources(const Run& run, const models::AssembledLaw& law,
                                     const Table& table, bool differs) {
  Table right = table;
  if (differs) { // sources were made from the table before it was changed
    right = sampled_table(run, law);
    const verify::VerifyInput input = verify_input(run, law, right, table.model);
    verify::set_drift(right.record, verify::verify(input, {}).front());
  }
  std::vector<Finding> findings;
  for (const codegen::Exporter* exporter : codegen::exporters_named(run.job.exports.targets)) {
    const std::string directory = source_directory(run, *exporter, table);
    std::vector<Finding> fewest;
    // A table without a record is exported with a remark that its drift is a claim.
    for (const bool claimed : {false, true}) {
      right.drift_is_claimed = claimed;
      const Table direct = direct_with_tolerance(law, right);
      const bool of_law = is_of_law(run.job, *exporter);
      const codegen::ExportRequest request =
          export_request(run.job, exporter->name, of_law ? direct : right);
      std::vector<Finding> found = verify::compare_bundle(
          run.sources.at(directory), exporter->generate(request), run.path(directory));
      if (!claimed || found.size() < fewest.size()) fewest = std::move(found);
      if (fewest.empty()) break;
    }
    append(findings, completed(run, table.model, std::move(fewest)));
  }
  return findings;
}

} // namespace frictab::run
