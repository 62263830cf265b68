// Predicts rows of data with one calibrated law, for `frictab predict`.
//
// The band is a prediction interval for whole EXPERIMENTS: 5 % of new experiments lie, as a whole,
// below its low end and 5 % above its high end. Each end is the law times one factor
// (calibrate/band.h), under the same shear limit, as in a table at that quantile. The band is not
// an interval for a single row, whose noise within its test adds to it, nor for the law's
// parameters.
#pragma once

#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "data/dataset.h"
#include "data/options.h"
#include "job/job.h"

namespace frictab::run {

// A law, and the mapping from a file's columns to its inputs.
struct LawToPredict {
  calibrate::ModelFit fit;
  data::DataOptions mapping; // from the job; empty for a model file, whose columns are canonical
};

// Returns law `name` of the calibration in the job's output directory. An empty name stands for the
// first that table.model names, "best" for the first of the ranking. Throws InputError if the
// calibration or the law in it does not exist.
LawToPredict law_of_job(const job::Job& job, const std::string& name);

// Reads models/NAME.json. Throws InputError if the file is not one.
LawToPredict law_of_model_file(const std::string& file);

// The law at its 5 % and 95 % quantiles over experiments, MPa per row.
struct PredictedBand {
  std::vector<double> low_MPa, high_MPa;
};

struct Prediction {
  models::Model model;
  std::string file;                        // as named by the user
  data::Dataset data;                      // as read
  std::vector<std::string> inputs;         // inputs of the law: states, columns, histories
  std::vector<std::vector<double>> states; // per input and row, canonical units
  std::vector<double> tau_MPa;             // of the law, per row
  bool fitted_to_all = false;              // calibrate::ModelFit
  std::optional<PredictedBand> band;       // empty if the calibration has too few experiments
  // Measured - law, per row; NaN in rows without a measured stress; empty if no row has one.
  std::vector<double> residual_MPa;
  std::size_t rows_measured = 0;            // rows with a measured stress
  std::optional<calibrate::Metrics> errors; // on the measured rows, without intervals
  std::map<std::string, std::pair<double, double>> data_range; // of the calibration, by input
  // Rows outside the data range of the calibration, per input, ascending.
  std::vector<std::vector<std::size_t>> outside;
  std::size_t rows_outside = 0; // rows outside along any input

  bool measured() const { return !residual_MPa.empty(); }
};

// Reads `file` (a file, a folder or a glob, relative to the current directory) and predicts every
// row. Compares with the measured stress in rows that have one. Throws InputError for a file that
// cannot be read, inputs that the data do not have, text that the law does not know, an empty cell
// that it needs, and a law without a recorded data range.
Prediction predict(const LawToPredict& law, const std::string& file);

// Writes one line per row: experiment, row number within it from 1, inputs, tau_R_MPa of the law,
// the band (tau_R_q05_MPa, tau_R_q95_MPa), measured_tau_R_MPa and residual_MPa, and in `outside`
// the blank-separated inputs that lie outside the data of the calibration. Omits columns without
// values. Numbers read back to the same bits.
void write_prediction(const Prediction& prediction, std::ostream& out);

std::string prediction_text(const Prediction& prediction); // summary for users
std::string prediction_json(const Prediction& prediction);

} // namespace frictab::run
