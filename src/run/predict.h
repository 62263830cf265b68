// One calibrated law on rows of data: what `frictab predict` writes.
//
// The band is that in which EXPERIMENTS lie around the law: a share of 5 % of new experiments lies
// below its low end, as a whole, and 5 % above its high end. Each end is the law times one factor
// (calibrate/band.h), under the same shear limit, as in a table at that quantile. It is no interval
// for a single row, whose noise within its test comes on top, nor one for the law's parameters.
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

// A law, and how columns of a file become those it takes.
struct LawToPredict {
  calibrate::ModelFit fit;
  data::DataOptions mapping; // of the job; of a model file none: the columns are canonical
};

// The law `name` of the calibration in the job's output directory; where the name is empty, the
// first that table.model names, "best" being the first of the ranking. Throws InputError where
// there is no calibration, or no such law in it.
LawToPredict law_of_job(const job::Job& job, const std::string& name);

// models/NAME.json. Throws InputError where it is none.
LawToPredict law_of_model_file(const std::string& file);

// The law where 5 % and 95 % of new experiments stay below, MPa per row.
struct PredictedBand {
  std::vector<double> low_MPa, high_MPa;
};

struct Prediction {
  models::Model model;
  std::string file;                         // as named by the user
  data::Dataset data;                       // as read
  std::vector<std::string> inputs;          // of the law: states, columns, histories
  std::vector<std::vector<double>> states;  // of each input, per row, canonical unit
  std::vector<double> tau_MPa;              // of the law, per row
  bool fitted_to_all = false;               // calibrate::ModelFit
  std::optional<PredictedBand> band;        // none where the calibration has too few experiments
  std::vector<double> residual_MPa;         // measured - law, NaN in rows without a measured
                                            // stress; empty where all are
  std::size_t rows_measured = 0;            // with a measured stress
  std::optional<calibrate::Metrics> errors; // of these, without intervals
  std::map<std::string, std::pair<double, double>> data_range; // of the calibration, by input
  // Of each input, rows outside the range of the data that the law was calibrated on, ascending.
  std::vector<std::vector<std::size_t>> outside;
  std::size_t rows_outside = 0; // along any input

  bool measured() const { return !residual_MPa.empty(); }
};

// Reads DATA (a file, a folder or a glob, relative to where the command runs) and predicts every
// row. A measured stress is compared with where there is one. Throws InputError for a file that
// cannot be read, inputs that the data do not have, text that the law does not know, an empty cell
// that it needs, and a law that does not say what its data reached.
Prediction predict(const LawToPredict& law, const std::string& file);

// One line per row: experiment, its row in it from 1, inputs, tau_R_MPa of the law, the band
// (tau_R_q05_MPa, tau_R_q95_MPa), measured_tau_R_MPa and residual_MPa, and in `outside` the inputs
// that lie outside the data of the calibration, with blanks between. Columns that are not known are
// left out. Numbers read back to the same bits.
void write_prediction(const Prediction& prediction, std::ostream& out);

std::string prediction_text(const Prediction& prediction); // summary, for people
std::string prediction_json(const Prediction& prediction);

} // namespace frictab::run
