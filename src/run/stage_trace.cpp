// Stage trace: finds effects that calibrated laws lack, and adds the extended laws to the
// calibration.
#include <algorithm>

#include <fmt/format.h>

#include "calibrate/comparison.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/recommended.h"
#include "calibrate/row_errors.h"
#include "core/error.h"
#include "core/progress.h"
#include "run/chosen.h"
#include "run/stage_functions.h"
#include "trace/trace_file.h"

namespace frictab::run {

using calibrate::Calibration;
using calibrate::ModelFit;

namespace {

// Sorts errors in the order of `names`, because a trace sorts experiments by name.
std::vector<calibrate::ExperimentError>
in_order_of(const std::vector<std::string>& names,
            const std::vector<calibrate::ExperimentError>& errors) {
  std::vector<calibrate::ExperimentError> sorted;
  for (const std::string& name : names)
    for (const calibrate::ExperimentError& one : errors)
      if (one.experiment == name) sorted.push_back(one);
  return sorted;
}

// Moves a traced law before another, with its error on the left-out tests of the trace, if the
// validation tests rank it after that law. Validation tests may be few; the left-out tests, on
// which the effects were selected, are more. Returns true if it moved the law.
bool put_before(const std::string& law, double error_MPa, std::vector<ModelFit>& fits,
                const trace::Trace& trace) {
  const auto with_name = [&](const std::string& name) {
    return std::ranges::find_if(fits,
                                [&](const ModelFit& fit) { return fit.model.name() == name; });
  };
  const auto traced = with_name(trace.extended_model), own = with_name(law);
  if (trace.unseen == "validation" || trace.effects.empty() || traced == fits.end() || traced < own)
    return false;
  traced->remarks.push_back(
      fmt::format("stands before {} by the {} left-out tests of its trace, {:.4g} MPa there "
                  "against {:.4g}: the validation tests are {}",
                  law, trace.after.validation.n_experiments, trace.after.validation.mae_MPa,
                  error_MPa, traced->validation.n_experiments));
  std::rotate(own, traced, traced + 1);
  return true;
}

// Takes the simplest of the laws with effects that predict unseen tests best, to one standard
// error: a law that ranks first without effects may be the wrong place for them, and one that bends
// more than the others takes up a part of them.
template <class TraceLaw>
trace::Trace or_a_simpler_law(trace::Trace first, const Calibration& calibration,
                              const data::Dataset& validation, const TraceLaw& trace_law) {
  std::vector<trace::Trace> traces{std::move(first)};
  for (const ModelFit* fit : simpler_laws(calibration))
    if (trace::Trace other = trace_law(*fit);
        !other.effects.empty() && other.unseen == traces.front().unseen)
      traces.push_back(std::move(other));
  std::vector<calibrate::LawErrors> errors;
  std::vector<std::size_t> numbers;
  for (const trace::Trace& one : traces) {
    const ModelFit& law = one.extended;
    errors.push_back({one.model, law.over_all.empty() ? calibrate::unseen_sums(law, validation)
                                                      : calibrate::sums_of(law.over_all)});
    numbers.push_back(calibrate::numbers_of(law, calibration.fits));
  }
  trace::Trace& chosen =
      *std::ranges::find(traces, calibrate::recommend(errors, numbers).law, &trace::Trace::model);
  if (&chosen != &traces.front()) {
    chosen.chosen_over = traces.front().model;
    chosen.chosen_over_MPa = traces.front().after.validation.mae_MPa;
    chosen.chosen_over_before_MPa = traces.front().before.validation.mae_MPa;
  }
  return std::move(chosen);
}

std::vector<trace::Trace> traces_of(const Calibration& calibration, const JobData& data,
                                    const job::Job& job) {
  const auto fits = fits_to_trace(calibration, job.trace);
  if (fits.empty())
    throw InputError({job.file, 0, 0}, "trace.models names no law that was calibrated",
                     "\"best\", or a name from the ranking");
  const Progress progress("tracing", fits.size());
  std::vector<trace::Trace> traces;
  const auto trace_law = [&](const ModelFit& fit) {
    return trace::trace({data.training, data.validation, fit, job.trace, job.calibration.bootstrap,
                         job.calibration.seed, data.all()});
  };
  for (const ModelFit* fit : fits) {
    with_rows_in_memory(data, [&] {
      trace::Trace found = trace_law(*fit);
      if (job.trace.models == trace::TraceOptions{}.models && !found.effects.empty())
        found = or_a_simpler_law(std::move(found), calibration, data.validation, trace_law);
      traces.push_back(std::move(found));
    });
    progress.tick();
  }
  return traces;
}

// Adds the extended laws to the calibration, and validates and ranks them with the others.
void add_traced_laws(Calibration& calibration, std::vector<trace::Trace>& traces,
                     const calibrate::CalibrationInput& input) {
  std::vector<ModelFit*> by_validation;
  for (trace::Trace& trace : traces)
    if (trace.extended.model.law && trace.extended.unseen.empty())
      by_validation.push_back(&trace.extended);
  calibrate::judge_on_rows(by_validation, input);
  for (const trace::Trace& trace : traces) {
    if (!trace.extended.model.law) continue;
    ModelFit fit = trace.extended;
    fit.unseen = in_order_of(calibration.validation_experiments, fit.unseen);
    fit.over_all = in_order_of(calibration.all_experiments, fit.over_all);
    calibration.fits.push_back(std::move(fit));
  }
  std::ranges::stable_sort(calibration.fits, [](const ModelFit& a, const ModelFit& b) {
    return a.validation.mae_MPa < b.validation.mae_MPa;
  });
  calibrate::add_comparisons(calibration, input);
  // Laws without an effect that is proven, or ranked after their extension by the left-out tests.
  std::vector<std::string> overruled;
  for (const trace::Trace& trace : traces) {
    if (put_before(trace.model, trace.before.validation.mae_MPa, calibration.fits, trace) ||
        (!trace.effects.empty() && trace.improvement.interval.low > 0))
      overruled.push_back(trace.model);
    if (!trace.chosen_over.empty())
      put_before(trace.chosen_over, trace.chosen_over_before_MPa, calibration.fits, trace);
  }
  calibrate::add_recommended(calibration, input, overruled);
}

} // namespace

void trace_laws(Run& run) {
  Workspace& workspace = run.workspace;
  const std::string data = run.data_fingerprint();
  if (const Checkpoint* kept = workspace.checkpoint();
      kept && kept->has_calibration(data) && kept->has("trace", data)) {
    run.traces = kept->files().traces(); // the checkpoint's calibration contains its laws
  } else {
    std::erase_if(run.calibration->fits, // laws of an earlier trace
                  [](const ModelFit& fit) { return fit.model.traced(); });
    workspace.remove_earlier(workspace.earlier().model_files(), "models/");
    run.traces = traces_of(*run.calibration, *run.data, run.job);
    add_traced_laws(*run.calibration, run.traces, run.data->calibration_input(run.job));
    write_calibration(run);
    workspace.write("trace.json", trace::trace_json(run.traces, run.calibration->synthetic));
  }
  run.finish("trace");
  workspace.save_checkpoint();
}

void load_traces(Run& run, std::string_view wanted_by) {
  if (run.is_current("trace", wanted_by)) run.traces = run.workspace.earlier().traces();
}

} // namespace frictab::run
