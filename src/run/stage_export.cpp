// Stage export: generates the routines of the tables, or of the laws themselves.
#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "run/law_accuracy.h"
#include "run/stage_functions.h"

namespace frictab::run {

using table::Table;

namespace {

// Names the failing target, and replaces the job key by its location in the job file.
Fault with_job_location(Fault fault, const std::string& target,
                        const codegen::ExportOptions& exports) {
  fault.what = target + ": " + fault.what;
  const JobKey key = fault.place.key;
  const std::string own = "export." + target + ".inputs";
  for (const std::string& table : {own, key.table})
    if (const auto known = exports.input_places.find(table + "." + key.name);
        known != exports.input_places.end()) {
      fault.place = known->second;
      if (table != own)
        fault.hint +=
            (fault.hint.empty() ? "for" : "; for") + (" this target alone: [" + own + "]");
      break;
    }
  return fault;
}

void write_sources(Run& run, const codegen::Exporter& exporter,
                   const codegen::ExportRequest& request, const std::string& directory) {
  codegen::SourceBundle& bundle = run.sources[directory] = exporter.generate(request);
  const std::string caution = exporter.caution(request);
  if (!caution.empty() && std::ranges::find(run.notes, caution) == run.notes.end())
    run.notes.push_back(caution);
  for (const auto& [path, text] : bundle)
    run.workspace.write(directory + "/" + path, text);
}

} // namespace

std::string export_directory(const Run& run, const std::string& target, const Table& table) {
  return "export/" + target + (run.tables.size() > 1 ? "/" + table.model : "");
}

std::string source_directory(const Run& run, const codegen::Exporter& exporter,
                             const Table& table) {
  const std::string directory = export_directory(run, exporter.name, table);
  return run.sources.count(directory)
             ? directory
             : run.workspace.earlier().source_directory(exporter.name, table.model);
}

bool is_of_law(const job::Job& job, const codegen::Exporter& exporter) {
  return job.exports.form == codegen::ExportForm::direct || !exporter.is_routine();
}

codegen::ExportRequest export_request(const job::Job& job, const std::string& target,
                                      const Table& form) {
  return {form, job.exports.solver_units(), job.exports.inputs_for(target), job.exports.options};
}

void export_sources(Run& run) {
  const auto targets = codegen::exporters_named(run.job.exports.targets);
  for (const auto& [target, inputs] : run.job.exports.inputs_of_target)
    if (std::ranges::find(targets, codegen::find_exporter(target)) == targets.end())
      run.notes.push_back(
          fmt::format("[export.{0}.inputs] is not used: {0} is not among export.targets", target));
  run.workspace.remove_earlier(run.workspace.earlier().source_files(), "export/");
  FaultList faults; // of all targets: one may accept what another refuses
  std::set<const codegen::Exporter*> refused;
  for (const Table& table : run.tables) {
    std::optional<Table> direct; // made for the first target that takes the law itself
    for (const codegen::Exporter* exporter : targets) {
      if (refused.count(exporter)) continue; // every table would fail for the same reason
      const bool of_law = is_of_law(run.job, *exporter);
      if (of_law && !direct) direct = direct_with_tolerance(law_of(run, table), table);
      try {
        write_sources(run, *exporter,
                      export_request(run.job, exporter->name, of_law ? *direct : table),
                      export_directory(run, exporter->name, table));
      } catch (const InputError& error) {
        refused.insert(exporter);
        for (const Fault& fault : error.faults()) {
          const Fault placed = with_job_location(fault, exporter->name, run.job.exports);
          faults.add(placed.place, placed.what, placed.hint);
        }
      }
    }
  }
  faults.throw_if_any();
  run.finish("export");
}

} // namespace frictab::run
