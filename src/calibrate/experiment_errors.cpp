// Sums over each experiment become its errors.
#include "calibrate/experiment_errors.h"

#include <cmath>

#include <fmt/format.h>

#include "calibrate/band.h"
#include "calibrate/resampling.h"
#include "io/csv.h"

namespace frictab::calibrate {

namespace {

void add_rows(std::string& out, const models::Model& model, const data::Dataset& data,
              bool held_out) {
  const std::span<const double> measured = data.values("tau_R_MPa");
  const std::vector<double> predicted = predict(model, data);
  const std::vector<ErrorSums> sums = error_sums(measured, predicted, data.first_row);
  const std::vector<double> gains = experiment_gains(measured, predicted, data.first_row);
  for (std::size_t e = 0; e < sums.size(); ++e) {
    const ErrorSums& one = sums[e];
    out +=
        fmt::format("{},{},{:d},{:.0f},{:.6g},{:.6g},{:.6g},{}\n", model.law->name,
                    io::csv_cell(data.experiments[e]), held_out, one.rows, one.absolute / one.rows,
                    std::sqrt(one.square / one.rows), one.residual / one.rows,
                    std::isnan(gains[e]) ? "" : fmt::format("{:.6g}", gains[e]));
  }
}

} // namespace

std::string errors_by_experiment(const Calibration& calibration, const data::Dataset& training,
                                 const data::Dataset& validation) {
  std::string out = "law,experiment,held_out,n,mae_MPa,rmse_MPa,bias_MPa,gain\n";
  for (const ModelFit& fit : calibration.fits) {
    add_rows(out, fit.model, training, false);
    add_rows(out, fit.model, validation, true);
  }
  return out;
}

} // namespace frictab::calibrate
