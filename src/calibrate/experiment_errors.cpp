// Converts sums over each experiment to its errors.
#include "calibrate/experiment_errors.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/band.h"
#include "calibrate/metrics.h"
#include "calibrate/row_errors.h"
#include "core/parallel.h"
#include "io/csv.h"
#include "stats/resampling.h"

namespace frictab::calibrate {

std::vector<ExperimentError> experiment_errors(const models::Model& model,
                                               const data::Dataset& data, bool held_out) {
  const std::vector<double> predicted = predict(model, data);
  const std::vector<stats::ErrorSums> sums = stats::error_sums(data, predicted);
  const std::vector<double> gains = experiment_gains(data, predicted);
  std::vector<ExperimentError> errors;
  for (std::size_t e = 0; e < sums.size(); ++e)
    errors.push_back(error_of(data.experiments[e], held_out, sums[e], gains[e]));
  return errors;
}

ExperimentError error_of(const std::string& experiment, bool held_out, const stats::ErrorSums& sums,
                         double gain) {
  return {experiment,
          held_out,
          static_cast<std::size_t>(sums.rows),
          sums.absolute / sums.rows,
          std::sqrt(sums.square / sums.rows),
          sums.residual / sums.rows,
          gain,
          sums.recording};
}

std::vector<stats::ErrorSums> sums_of(const std::vector<ExperimentError>& errors) {
  std::vector<stats::ErrorSums> sums;
  for (const ExperimentError& one : errors) {
    const auto rows = static_cast<double>(one.n_rows);
    sums.push_back({rows * one.mae_MPa, rows * one.rmse_MPa * one.rmse_MPa, rows * one.bias_MPa,
                    rows, one.recording});
  }
  return sums;
}

std::vector<stats::ErrorSums> sums_of(const std::vector<ExperimentError>& errors,
                                      const data::Dataset& of) {
  std::vector<stats::ErrorSums> sums = sums_of(errors);
  if (of.recording.size() == sums.size())
    for (std::size_t e = 0; e < sums.size(); ++e)
      sums[e].recording = of.recording[e];
  return sums;
}

Metrics metrics_of(const std::vector<ExperimentError>& errors, const CalibrationOptions& options) {
  return metrics(sums_of(errors), options.bootstrap, options.seed);
}

std::vector<stats::ErrorSums> unseen_sums(const ModelFit& fit, const data::Dataset& validation) {
  if (!fit.unseen.empty()) return sums_of(fit.unseen, validation);
  if (!fit.on_rows.empty()) {
    const auto end = fit.on_rows.end();
    return sums_of({end - validation.experiments.size(), end});
  }
  return stats::error_sums(validation, predict(fit.model, validation));
}

namespace {

// Reads the rows for laws that were not judged on the rows of condensed data, such as those of an
// earlier run.
void judge_rows_where_unknown(std::vector<ErrorsOfLaw>& laws, const Calibration& calibration,
                              const data::Dataset& training, const data::Dataset& validation) {
  std::vector<std::size_t> unknown;
  RowsToJudge fitted{&training, false}, unseen{&validation, true};
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (const ModelFit& fit = calibration.fits[i]; fit.unseen.empty() && fit.on_rows.empty()) {
      unknown.push_back(i);
      fitted.laws.push_back({models::AssembledLaw(fit.model)});
    }
  if (unknown.empty()) return;
  unseen.laws = fitted.laws;
  for (const RowFindings& found : judge_rows(std::array{fitted, unseen}))
    for (std::size_t l = 0; l < unknown.size(); ++l) {
      std::vector<ExperimentError>& errors = laws[unknown[l]].experiments;
      errors.insert(errors.end(), found.errors[l].begin(), found.errors[l].end());
    }
}

} // namespace

std::vector<ErrorsOfLaw> errors_by_experiment(const Calibration& calibration,
                                              const data::Dataset& training,
                                              const data::Dataset& validation) {
  std::vector<ErrorsOfLaw> laws(calibration.fits.size());
  if (training.condensed) judge_rows_where_unknown(laws, calibration, training, validation);
  parallel_for(laws.size(), [&](std::size_t i) {
    const ModelFit& fit = calibration.fits[i];
    laws[i].law = fit.model.law->name;
    std::vector<ExperimentError>& errors = laws[i].experiments;
    if (!errors.empty()) return;
    errors = fit.unseen.empty() ? fit.on_rows : fit.unseen;
    if (!errors.empty()) return;
    errors = experiment_errors(fit.model, training, false);
    for (ExperimentError& one : experiment_errors(fit.model, validation, true))
      errors.push_back(std::move(one));
  });
  return laws;
}

std::string errors_csv(const std::vector<ErrorsOfLaw>& laws) {
  std::string out = "law,experiment,held_out,n,mae_MPa,rmse_MPa,bias_MPa,gain\n";
  for (const ErrorsOfLaw& law : laws)
    for (const ExperimentError& one : law.experiments)
      out += fmt::format("{},{},{:d},{},{:.6g},{:.6g},{:.6g},{}\n", law.law,
                         io::csv_cell(one.experiment), one.held_out, one.n_rows, one.mae_MPa,
                         one.rmse_MPa, one.bias_MPa,
                         std::isnan(one.gain) ? "" : fmt::format("{:.6g}", one.gain));
  return out;
}

} // namespace frictab::calibrate
