// Stage calibrate: fits and ranks the laws.
#include <fmt/format.h>

#include "calibrate/calibration_file.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/row_errors.h"
#include "core/error.h"
#include "core/large_work.h"
#include "core/text.h"
#include "report/report.h"
#include "run/stage_functions.h"

namespace frictab::run {

void with_rows_in_memory(const JobData& data, const std::function<void()>& work) {
  const std::size_t rows = data.training.rows() + data.validation.rows();
  large_work(fmt::format("with {} rows in memory", thousands(rows)), rows, fewer_rows, work);
}

void write_calibration(Run& run) {
  const calibrate::Calibration& calibration = *run.calibration;
  run.workspace.write("calibration.json", calibrate::calibration_json(calibration));
  run.workspace.write("benchmark.md", report::benchmark_md(calibration));
  run.workspace.write("errors_by_experiment.csv",
                      calibrate::errors_csv(calibrate::errors_by_experiment(
                          calibration, run.data->training, run.data->judged())));
  for (const calibrate::ModelFit& fit : calibration.fits)
    run.workspace.write("models/" + fit.model.law->name + ".json",
                        calibrate::model_json(fit, calibration));
}

void calibrate_laws(Run& run) {
  Workspace& workspace = run.workspace;
  const Checkpoint* kept = workspace.checkpoint();
  const bool is_kept = kept && kept->has_calibration(run.data_fingerprint());
  if (!is_kept)
    with_rows_in_memory(*run.data, [&] {
      run.calibration = calibrate::calibrate(run.data->calibration_input(run.job));
    });
  workspace.remove_earlier(workspace.earlier().model_files(), "models/");
  workspace.remove_earlier("trace.json"); // belongs to the replaced calibration
  if (is_kept) {
    for (const std::string& path : kept->calibration_files())
      workspace.take_from_checkpoint(path);
    run.calibration = kept->files().calibration();
    run.notes.push_back("the calibration is that of a run that did not end");
  } else {
    write_calibration(run);
  }
  run.finish("calibrate");
  run.present.insert("trace"); // this calibration has no traces yet
  if (!is_kept) workspace.save_checkpoint();
}

void load_calibration(Run& run, std::string_view) {
  run.workspace.check_as_written("calibrate", "calibration.json");
  run.calibration = run.workspace.earlier().calibration();
  // Compares the data here as well, because check_fresh cannot without stages.json.
  const std::string wanted = data::fingerprint(run.data->training, run.data->judged());
  if (run.calibration->data_hash != wanted)
    throw InputError({run.path("calibration.json"), 0, 0},
                     "was made from other data: their fingerprint is " + run.calibration->data_hash,
                     "`frictab calibrate " + run.job.arguments() + "` rebuilds it");
}

} // namespace frictab::run
