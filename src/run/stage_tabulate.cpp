// Stage tabulate: makes tables of the chosen laws.
#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/large_work.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/version.h"
#include "run/chosen.h"
#include "run/law_accuracy.h"
#include "run/stage_functions.h"
#include "table/build.h"
#include "table/distance.h"
#include "table/table_file.h"

namespace frictab::run {

using table::Table;

namespace {

std::string path_of(const std::string& model) {
  return "tables/" + model + ".h5";
}

// Reads the table back from its file, so that verification measures what users get.
Table staged_table(const Workspace& workspace, const std::string& model) {
  Table table = table::read_table(workspace.staged(path_of(model)));
  table.drift_is_claimed = false;
  return table;
}

// Measures the drift before the table is written, so that the file carries it.
void measure_drift(Run& run, const models::AssembledLaw& law, Table& table) {
  const verify::DriftRecord drift =
      verify::verify(verify_input(run, law, table, "the new table"), {}).front();
  const bool to_tolerance = !run.job.table.nodes && !run.job.table.max_bytes;
  if (!drift.passed && to_tolerance)
    run.missed.push_back(
        fmt::format("the table of {} drifts by up to {:.3g} MPa, more than the {:.3g} MPa "
                    "allowed{}: more nodes in [table.axes], or a larger table.tolerance_MPa",
                    table.model, verify::largest_drift_MPa(drift), drift.allowed_MPa,
                    drift.allowed_from.empty() ? "" : " (" + drift.allowed_from + ")"));
  verify::set_drift(table.record, drift);
  run.drift_of_tables[table.model] = drift;
}

Table made_table(Run& run, const models::AssembledLaw& law) {
  const std::string name = law.model.name();
  const Checkpoint* kept = run.workspace.checkpoint();
  if (kept && kept->has_file("tabulate", path_of(name), run.data_fingerprint())) {
    run.workspace.take_from_checkpoint(path_of(name));
    Table table = staged_table(run.workspace, name);
    run.notes.push_back("the table of " + name + " is that of a run that did not end");
    measure_drift(run, law, table);
    return table;
  }
  Table table = sampled_table(run, law);
  measure_drift(run, law, table);
  table::write_table(table, run.workspace.stage_file(path_of(name)), run.job.table.hdf5);
  return staged_table(run.workspace, name);
}

// Keeps the loaded tables that table.model names. Keeps all if it names no laws ("best", "all"),
// because the earlier run has resolved that choice.
void keep_named(std::vector<Table>& tables, const table::TableOptions& options,
                const models::Laws& laws) {
  const std::vector<std::string>& names = options.model;
  if (!options.names_laws()) return;
  std::string there;
  for (const Table& table : tables)
    there += (there.empty() ? "" : ", ") + table.model;
  const auto is_named = [&](const Table& table) {
    const models::ModelName name = models::read_model_name(table.model, laws);
    std::string law = table.model; // name without the quantile
    if (name.base) law = name.base->name + (name.traced ? "_traced" : "");
    return std::ranges::find(names, law) != names.end() ||
           std::ranges::find(names, table.model) != names.end();
  };
  std::erase_if(tables, [&](const Table& table) { return !is_named(table); });
  if (tables.empty())
    throw InputError(options.place, "there is no table of " + join(names, ", "),
                     "there are tables of " + there + "; frictab tabulate makes others");
}

// Checks that a table was made from these data and not changed since. Verification measures a
// changed table and notes it; other stages refuse it.
void check_origin(Run& run, Table& table, bool to_verify) {
  const std::string file = run.path(path_of(table.model));
  const std::string wanted = run.calibration->data_hash;
  const std::string hash = table.record.data_hash.value_or(wanted);
  if (hash != wanted)
    throw InputError(
        {file, 0, 0},
        fmt::format(
            "was made from other data: their fingerprint is {}, that of calibration.json is {}",
            hash, wanted),
        "`frictab tabulate " + run.job.arguments() + "` rebuilds it");
  const std::optional<bool> as_written = run.workspace.record().is_as_written(path_of(table.model));
  table.drift_is_claimed = !as_written.value_or(false);
  if (as_written.value_or(true)) return;
  if (!to_verify) run.workspace.check_as_written("tabulate", path_of(table.model));
  run.notes.push_back(file + " was changed since `frictab tabulate` wrote it");
}

} // namespace

Table sampled_table(const Run& run, const models::AssembledLaw& law, const Table* grid) {
  const table::TableOptions options = table_options(run, law.model);
  const data::Dataset& tests = fitted_tests(run, law.model);
  const auto ranges = table::state_ranges(law, tests, options);
  Table table = large_work("making the table of " + law.model.name(), 0,
                           "fewer nodes in [table.axes], or a larger table.tolerance_MPa", [&] {
                             return grid ? table::table_on_nodes(law, ranges, options, *grid)
                                         : table::build_table(law, ranges, options);
                           });
  if (options.distance) table::add_distance(table, law, tests);
  table.record.tool_version = tool_version();
  table.record.data_hash = run.calibration->data_hash;
  table.record.data_origin = run.calibration->synthetic ? "synthetic" : "measured";
  return table;
}

void tabulate_laws(Run& run) {
  Workspace& workspace = run.workspace;
  workspace.remove_earlier(workspace.earlier().table_files(), "tables/");
  run.tables.clear();
  const std::vector<models::Model> models = models_to_tabulate(*run.calibration, run.job.table);
  workspace.begin("tabulate", run.data_fingerprint());
  Progress progress("tabulating", models.size());
  for (const models::Model& model : models) {
    run.tables.push_back(made_table(run, models::AssembledLaw(model)));
    workspace.save_checkpoint();
    progress.tick();
  }
  // Sorts by name, the order in which later stages load them.
  std::ranges::sort(run.tables, {}, &Table::model);
  run.finish("tabulate");
}

void load_tables(Run& run, std::string_view wanted_by) {
  run.tables = run.workspace.earlier().tables();
  keep_named(run.tables, run.job.table, run.job.models.laws);
  for (Table& table : run.tables)
    check_origin(run, table, wanted_by == "verify");
}

} // namespace frictab::run
