// Reads rows experiment by experiment, and predicts each of them by every law.
#include "calibrate/row_errors.h"

#include "calibrate/band.h"
#include "calibrate/experiment_errors.h"
#include "data/condense.h"

namespace frictab::calibrate {

using data::Dataset;

namespace {

// Errors of one law on the rows of one experiment; adds the rows outside its clamped range.
ExperimentError judged(const models::AssembledLaw& law, const Dataset& rows,
                       const std::string& experiment, bool held_out, RowsBeyond& beyond) {
  const auto [columns, tau] = predict_with_columns(law, law.inputs, rows);
  beyond.add(*law.model.law, columns, rows);
  return error_of(experiment, held_out, stats::error_sums(rows, tau).front(),
                  experiment_gains(rows, tau)[0]);
}

} // namespace

std::vector<RowFindings> judge_rows(std::span<const RowsToJudge> all) {
  std::vector<RowFindings> found;
  std::vector<const Dataset*> data;
  for (const RowsToJudge& one : all) {
    const std::size_t laws = one.laws.size(), tests = one.data->experiments.size();
    data.push_back(one.data);
    found.push_back({std::vector(laws, std::vector<ExperimentError>(tests)),
                     std::vector(laws, std::vector<RowsBeyond>(tests)),
                     std::vector<stats::ErrorSums>(tests)});
  }
  data::read_again(data, [&](std::size_t d, std::size_t e, const Dataset& rows) {
    const Dataset& whole = *all[d].data;
    found[d].scatter[e] = scatter_within(rows.values("tau_R_MPa"));
    for (std::size_t l = 0; l < all[d].laws.size(); ++l) {
      const std::vector<models::AssembledLaw>& laws = all[d].laws[l];
      ExperimentError& error = found[d].errors[l][e];
      error = judged(laws.size() == 1 ? laws.front() : laws[e], rows, whole.experiments[e],
                     all[d].held_out, found[d].beyond[l][e]);
      if (!whole.recording.empty()) error.recording = whole.recording[e];
    }
  });
  return found;
}

namespace {

std::vector<double> gains_of(const std::vector<ExperimentError>& errors) {
  std::vector<double> gains;
  for (const ExperimentError& one : errors)
    gains.push_back(one.gain);
  return gains;
}

void remark_rows_beyond(ModelFit& fit, const std::vector<RowsBeyond>& of_experiments,
                        const char* called) {
  RowsBeyond all;
  for (const RowsBeyond& one : of_experiments)
    all.add(one);
  all.add_remark(fit.remarks, *fit.model.law, called);
}

// Takes the findings on law `l`: of the training rows and, if there are any, of those that judge.
void take(ModelFit& fit, std::size_t l, const std::vector<RowFindings>& found,
          const CalibrationInput& input) {
  const std::vector<ExperimentError>& training = found.front().errors[l];
  fit.on_rows.clear();
  fit.training = metrics_of(training, input.options);
  remark_rows_beyond(fit, found.front().beyond[l], "training");
  if (found.size() < 2 && input.judged_by != JudgedBy::fit) return;
  const std::vector<ExperimentError>& judging = found.back().errors[l];
  fit.validation = metrics_of(judging, input.options);
  if (!on_other_experiments(input.judged_by)) {
    fit.unseen = judging;
    return;
  }
  fit.on_rows = training;
  fit.on_rows.insert(fit.on_rows.end(), judging.begin(), judging.end());
  fit.band = check_band(fit.model, gains_of(judging));
  remark_rows_beyond(fit, found.back().beyond[l], "validation");
}

} // namespace

ScatterWithin judge_on_rows(const std::vector<ModelFit*>& fits, const CalibrationInput& input) {
  if (!input.training.condensed || fits.empty()) return {};
  const bool on_others = on_other_experiments(input.judged_by);
  const bool leaves_out =
      input.judged_by == JudgedBy::leave_one_out && !fits.front()->without.empty();
  std::vector<RowsToJudge> all{{&input.training, false}};
  if (on_others || leaves_out)
    all.push_back({on_others ? &input.validation : &input.training, true});
  for (const ModelFit* fit : fits) {
    all.front().laws.push_back({models::AssembledLaw(fit->model)});
    if (on_others) all.back().laws.push_back(all.front().laws.back());
    if (leaves_out) all.back().laws.emplace_back(fit->without.begin(), fit->without.end());
  }
  std::vector<RowFindings> found = judge_rows(all);
  for (std::size_t l = 0; l < fits.size(); ++l)
    take(*fits[l], l, found, input);
  ScatterWithin scatter{std::move(found.front().scatter), {}};
  if (on_others) scatter.validation = std::move(found.back().scatter);
  return scatter;
}

} // namespace frictab::calibrate
