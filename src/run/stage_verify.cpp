// Stage verify: compares tables and routines with their laws; times tables against the laws
// themselves.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "codegen/recipe.h"
#include "core/progress.h"
#include "run/law_accuracy.h"
#include "run/origins.h"
#include "run/stage_functions.h"

namespace frictab::run {

using table::Table;

namespace {

const codegen::SourceBundle& sources_in(Run& run, const std::string& directory) {
  const auto [found, is_new] = run.sources.try_emplace(directory);
  if (is_new) found->second = run.workspace.earlier().sources(directory);
  return found->second;
}

// Sources of each target; their recipes record whether they were made from the table or the law.
std::vector<verify::GeneratedSource> sources_of(Run& run, const Table& table, const Table& direct) {
  std::vector<verify::GeneratedSource> sources;
  for (const codegen::Exporter* exporter : codegen::exporters_named(run.job.exports.targets)) {
    const std::string directory = source_directory(run, *exporter, table);
    const codegen::SourceBundle& bundle = sources_in(run, directory);
    const bool of_law =
        codegen::is_direct_recipe(bundle.at("recipe.json"), directory + "/recipe.json");
    sources.push_back(
        {exporter, export_request(run.job, exporter->name, of_law ? direct : table), bundle});
  }
  return sources;
}

std::vector<verify::DriftRecord> records_of(Run& run, const Table& table,
                                            const models::AssembledLaw& law) {
  const Table direct = direct_with_tolerance(law, table);
  verify::VerifyInput input =
      verify_input(run, law, table, run.job.directory + "/tables/" + table.model + ".h5");
  const auto known = run.drift_of_tables.find(table.model);
  if (known != run.drift_of_tables.end()) input.known = &known->second;
  return verify::verify(input, sources_of(run, table, direct));
}

// Compares what was loaded, not made by this command, with what it was made from.
void compare_with_origins(Run& run, const Table& table, const models::AssembledLaw& law,
                          const verify::DriftRecord& drift) {
  std::vector<verify::Finding>& findings = run.verification->findings;
  const auto add = [&](const std::vector<verify::Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
    return std::ranges::any_of(more, &verify::Finding::failed);
  };
  const bool differs =
      run.made.count("tabulate") == 0 && add(compare_table(run, law, table, drift));
  if (run.made.count("export") == 0) add(compare_sources(run, law, table, differs));
}

// Records of tables that a run that did not end had verified completely.
std::vector<verify::DriftRecord> kept_records(const Run& run) {
  const Checkpoint* kept = run.workspace.checkpoint();
  if (!kept || !kept->has_file("verify", "verify.json", run.data_fingerprint())) return {};
  return kept->files().verification()->records;
}

} // namespace

void verify_tables(Run& run) {
  Workspace& workspace = run.workspace;
  verify::Verification& verification = run.verification.emplace(
      verify::Verification{0, {}, run.job.verify.require_proof, run.job.verify.require_run});
  for (const Table& table : run.tables)
    verification.max_drift_MPa =
        std::max(verification.max_drift_MPa, drift_allowed(run, model_of(run, table)).MPa);
  workspace.begin("verify", run.data_fingerprint());
  if (run.made.count("calibrate") == 0) {
    check_all_there(run);
    verification.findings = compare_models(run);
  }
  const std::vector<verify::DriftRecord> kept = kept_records(run);
  Progress progress("verifying", run.tables.size());
  for (const Table& table : run.tables) {
    std::vector<verify::DriftRecord> records;
    std::ranges::copy_if(kept, std::back_inserter(records),
                         [&](const verify::DriftRecord& r) { return r.model == table.model; });
    const bool is_kept = !records.empty();
    const models::AssembledLaw law = law_of(run, table);
    if (!is_kept) records = records_of(run, table, law);
    compare_with_origins(run, table, law, records.front());
    verification.records.insert(verification.records.end(), records.begin(), records.end());
    if (!is_kept) {
      workspace.write("verify.json", verify::verification_json(verification));
      workspace.save_checkpoint();
    }
    progress.tick();
  }
  workspace.write("verify.json", verify::verification_json(verification));
  workspace.write("verify.xml", verify::verification_junit(verification));
  run.finish("verify");
}

void load_verification(Run& run, std::string_view wanted_by) {
  if (run.is_current("verify", wanted_by))
    run.verification = run.workspace.earlier().verification();
  if (!run.verification) run.verification.emplace();
}

void time_forms(Run& run) {
  Progress progress("timing", run.tables.size());
  for (const Table& table : run.tables) {
    run.forms.push_back(verify::compare_forms(law_of(run, table), table));
    progress.tick();
  }
}

} // namespace frictab::run
