// Sums over each experiment become its errors.
#include "calibrate/experiment_errors.h"

#include <cmath>

#include <fmt/format.h>

#include "calibrate/band.h"
#include "calibrate/resampling.h"
#include "core/parallel.h"
#include "io/csv.h"

namespace frictab::calibrate {

namespace {

void add_experiments(ErrorsOfLaw& law, const models::Model& model, const data::Dataset& data,
                     bool held_out) {
  const std::span<const double> measured = data.values("tau_R_MPa");
  const std::vector<double> predicted = predict(model, data);
  const std::vector<ErrorSums> sums = error_sums(measured, predicted, data.first_row);
  const std::vector<double> gains = experiment_gains(measured, predicted, data.first_row);
  for (std::size_t e = 0; e < sums.size(); ++e) {
    const ErrorSums& one = sums[e];
    law.experiments.push_back({data.experiments[e], held_out, static_cast<std::size_t>(one.rows),
                               one.absolute / one.rows, std::sqrt(one.square / one.rows),
                               one.residual / one.rows, gains[e]});
  }
}

} // namespace

std::vector<ErrorsOfLaw> errors_by_experiment(const Calibration& calibration,
                                              const data::Dataset& training,
                                              const data::Dataset& validation) {
  std::vector<ErrorsOfLaw> laws(calibration.fits.size());
  parallel_for(laws.size(), [&](std::size_t i) {
    const models::Model& model = calibration.fits[i].model;
    laws[i].law = model.law->name;
    add_experiments(laws[i], model, training, false);
    add_experiments(laws[i], model, validation, true);
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
