// Calibration stage: fits laws to all rows of a campaign and judges how well they predict unseen
// experiments.
//
// Files, in the order in which a calibration runs:
//   calibrate.cpp       the stage: laws that the columns allow, fits, errors, ranking
//   fitting a law
//     input_columns     the columns of the data for a law's inputs
//     law_problem       from starts on few rows to a fit on all rows
//     loss              L2, L1, Huber
//     fit_weights       weights of rows in a fit
//     normal_equations  sums over rows for a step
//     fit               Levenberg-Marquardt within bounds
//     median            least absolute deviations of one parameter, exactly
//     slip_distance     of rate-and-state friction, around the fit of all other parameters
//     network           training of the neural network: ensemble and weight decay
//     network_fit       one of its nets
//     polynomial        the polynomial and its order
//     polynomial_bins   the rows it is fitted to, few per experiment
//     polynomial_fit    its coefficients, with all variance components estimated
//     fit_law           any law, by its own method
//   uncertainty and errors
//     sandwich          standard errors by experiment
//     stress_error      the standard error of a law's stress at any state
//     determined        parameters that the tests leave open
//     influence         tests that, left out, move parameters or change the ranking
//     resampling        errors per experiment, resampling of whole experiments
//     metrics           MAE, RMSE, bias with intervals
//     experiment_errors the same for single experiments
//     row_errors        the same for condensed data, by a second reading of their rows
//     beyond_ends       rows outside the range to which a law clamps its inputs
//     refit             laws fitted again to all experiments, to be delivered
//     cross_validation  experiments predicted by laws fitted without them
//     comparison        significance of differences between laws
//     choice            the optimism of the best law's error, due to its selection
//     recommended       the simplest law that is hardly worse than the best
//     noise_floor       the least error any law can have, with replicates (repeated tests)
//     band              spread of experiments around a law, and laws at its quantiles
//     conditional       one gain per experiment from its own first millimetres
//     folds             partition of experiments for cross-validation
//   judgement           all these results as plain values; judgement_json, calibration_file as JSON
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibrate/band.h"
#include "calibrate/judgement.h"
#include "calibrate/network.h"
#include "calibrate/options.h"
#include "calibrate/polynomial.h"
#include "data/dataset.h"
#include "models/law.h"

namespace frictab::calibrate {

struct Uncertainty; // sandwich.h

struct ModelFit {
  models::Model model;
  std::vector<double> std_error; // per parameter; NaN if the data do not determine it
  std::string std_error_method;
  std::string termination; // why the solver stopped
  std::size_t evaluations = 0;
  double seconds = 0; // wall time; kept out of files that must be reproducible
  // bounds that were reached, parameters the data do not determine
  std::vector<std::string> remarks;
  std::shared_ptr<const Uncertainty> uncertainty; // for laws of few parameters; kept out of files
  Determination determination;
  Metrics training;
  Metrics validation;
  BandCheck band; // of model.experiment_gains, on the validation experiments
  // In leave-one-out: the error of each experiment by the law fitted without it, in file order.
  std::vector<ExperimentError> unseen;
  std::vector<models::Model> without; // that law, per experiment; kept out of files
  // For held_out, where the held-out tests are few: the error of each experiment of training and
  // validation by the law fitted without its part, in the order of Calibration::all_experiments.
  std::vector<ExperimentError> over_all;
  // For condensed data judged on other experiments: errors on the rows of all training experiments,
  // then of all validation experiments (row_errors.h); kept out of files.
  std::vector<ExperimentError> on_rows;
  std::optional<NetworkRecord> network;       // how a neural network was trained
  std::optional<PolynomialRecord> polynomial; // terms and fit of a polynomial
  // Range of each input in the training data, by name; empty when read from files of versions that
  // did not write it.
  std::map<std::string, std::pair<double, double>> data_range;
  // For deliver = all: the same law fitted to training and validation experiments together. Its
  // `training` errors are on all of them, its `validation` errors cross-validated over them.
  std::shared_ptr<const ModelFit> on_all;
  bool fitted_to_all = false; // true for a fit that is stored in another fit's on_all
  // A constant from the literature that the job does not name: shown for comparison, not a
  // candidate.
  bool reference = false;

  // The fit from which tables, sources, predictions and models/NAME.json are made.
  const ModelFit& delivered() const { return on_all ? *on_all : *this; }
};

// Size of a law with its numbers in the formula: "order 2, 20 terms"; empty for other laws.
std::string size_of_trained(const ModelFit& fit);

// A law that cannot be fitted because columns are missing.
struct LeftOut {
  std::string law;
  std::string needs;        // "sigma_f_MPa, psi"
  std::string text() const; // "levanov: needs sigma_f_MPa, psi"
};

struct Calibration {
  std::vector<ModelFit> fits; // ranked by validation MAE
  JudgedBy judged_by = JudgedBy::validation_files;
  std::vector<LeftOut> left_out;
  Loss loss = Loss::l2;
  std::uint64_t seed = 1;
  bool synthetic = false;                          // as declared by the data
  std::string data_hash;                           // 16 hex digits, training and validation
  std::vector<std::string> validation_experiments; // by name, in file order
  std::vector<std::string> all_experiments;        // of ModelFit::over_all; else empty
  Comparisons comparisons;                         // of all pairs, on the validation experiments
  std::vector<Influence> influence;     // by law in ranking order, then by size of the shift
  Choice choice;                        // optimism of the best law's error, due to its selection
  Recommended recommended;              // law to use
  std::vector<NoiseFloor> noise_floors; // most trustworthy first
  // Mean of |tau_R| over the rows on which the laws are judged; 0 in files of 0.2.
  double mean_stress_MPa = 0;
  Conditional conditional;
  Deliver deliver = Deliver::training;
  // number of recordings that contain the training experiments as intervals; 0: each is its own
  std::size_t recordings = 0;
  std::size_t delivery_folds = 0; // folds of experiments that cross-validated ModelFit::on_all
};

// The fit of the law with this name; nullptr if there is none.
const ModelFit* find_fit(const Calibration& calibration, std::string_view law);

struct CalibrationInput {
  const data::Dataset& training;
  const data::Dataset& validation; // same as training for leave_one_out and fit
  ModelOptions models;
  CalibrationOptions options;
  JudgedBy judged_by = JudgedBy::validation_files;
  const data::Dataset* undivided = nullptr; // for held_out: both together, to draw other splits
  // for options.deliver = all: both together; nullptr: made when needed
  const data::Dataset* all = nullptr;
};

// Returns the job's conventions, with the shear limit off if the data have no flow stress.
models::Conventions conventions_of(const ModelOptions& models, const data::Dataset& data);

// Fits and judges the laws. Throws InputError if no law can be used, a law requested by name lacks
// columns, or options.condition_on_mm is not possible with these data.
Calibration calibrate(const CalibrationInput& input);

// Returns the laws that calibrate() would fit, in the order of the registry. Throws as calibrate()
// does.
std::vector<std::string> names_of_laws(const CalibrationInput& input);

// Predicts tau_R in MPa for every row; histories of the law's own stress are self-consistent.
// Throws InputError that names inputs missing from the data.
std::vector<double> predict(const models::Model& model, const data::Dataset& data);

// Whether the data declare themselves synthetic: a column `origin` with the value "synthetic".
bool is_synthetic(const data::Dataset& data);

} // namespace frictab::calibrate
