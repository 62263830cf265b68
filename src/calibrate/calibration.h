// The calibration stage: laws fitted to all rows of a campaign, and how well they predict
// experiments they have not seen.
//
// The folder, in the order in which a calibration runs:
//   calibrate.cpp       the stage: which laws the columns allow, fits, errors, ranking
//   how a law is fitted
//     input_columns     the columns of the data that a law's inputs stand for
//     law_problem       from starts on few rows to a fit on all rows
//     loss              L2, L1, Huber
//     normal_equations  sums over rows that a step needs
//     fit               Levenberg-Marquardt within bounds
//     median            least absolute deviations of one parameter, exactly
//     slip_distance     of rate-and-state friction, around the fit of all else
//     network           training of the neural network: ensemble and weight decay
//     network_fit       one of its nets
//     polynomial        the polynomial and its order
//     polynomial_bins   the rows it is fitted to, few per experiment
//     polynomial_fit    its coefficients, with everything that scatters estimated
//     fit_law           any law, by its own way
//   how well it is known, and how well it does
//     sandwich          standard errors by experiment
//     stress_error      the standard error of a law's stress at any state
//     determined        which parameters the tests leave open
//     influence         which test, left out, moves them or changes the ranking
//     resampling        errors per experiment, whole experiments resampled
//     metrics           MAE, RMSE, bias with intervals
//     experiment_errors the same for single experiments
//     row_errors        the same of condensed data, by a second look at their rows
//     refit             laws fitted again to all experiments, to be delivered
//     cross_validation  experiments predicted by laws fitted without them
//     comparison        which law is better than which
//     choice            what the best law's error owes to its having been chosen
//     recommended       the simplest law that is hardly worse than the best
//     noise_floor       what no law can go below, with replicates (repeated tests)
//     band              how experiments lie around a law, and laws at their quantiles
//     conditional       one gain per experiment from its own first millimetres
//     folds             experiments parted for cross-validation
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
  std::vector<double> std_error; // per parameter; NaN where the data do not determine it
  std::string std_error_method;
  std::string termination; // why the solver stopped
  std::size_t evaluations = 0;
  double seconds = 0;               // wall time; kept out of files that must be reproducible
  std::vector<std::string> remarks; // a bound that was hit, a parameter the data do not determine
  std::shared_ptr<const Uncertainty> uncertainty; // of a law of few parameters; kept out of files
  Determination determination;
  Metrics training;
  Metrics validation;
  BandCheck band; // of model.experiment_gains, on the validation experiments
  // Where each experiment was left out: its error by the law fitted without it, as filed.
  std::vector<ExperimentError> unseen;
  std::vector<models::Model> without; // that law, per experiment; kept out of files
  // Condensed data judged on other experiments: errors on the rows of all training experiments,
  // then of all validation experiments (row_errors.h); kept out of files.
  std::vector<ExperimentError> on_rows;
  std::optional<NetworkRecord> network;       // how a neural network was trained
  std::optional<PolynomialRecord> polynomial; // what a polynomial is made of
  // Least and largest of each input in the training data, by name; empty in files of versions that
  // did not write it.
  std::map<std::string, std::pair<double, double>> data_range;
  // deliver = all: the same law fitted to training and validation experiments together. Its
  // `training` errors are of all of them, its `validation` errors cross-validated over them.
  std::shared_ptr<const ModelFit> on_all;
  bool fitted_to_all = false; // it is such a one itself
  // A constant of the literature that the job does not name: shown beside the laws, no candidate.
  bool reference = false;

  // What tables, sources, predictions and models/NAME.json are made of.
  const ModelFit& delivered() const { return on_all ? *on_all : *this; }
};

// How large a law is whose numbers stand in its formula: "order 2, 20 terms"; empty of others.
std::string size_of_trained(const ModelFit& fit);

// A law that the columns do not allow.
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
  bool synthetic = false;                          // the data say they are
  std::string data_hash;                           // 16 hex digits, training and validation
  std::vector<std::string> validation_experiments; // by name, as filed
  Comparisons comparisons;                         // of all pairs, on the validation experiments
  std::vector<Influence> influence;                // by law as ranked, then by how far it moves
  Choice choice;                        // what choosing the best of them does to its error
  Recommended recommended;              // which law to take
  std::vector<NoiseFloor> noise_floors; // the most trustworthy first
  Conditional conditional;
  Deliver deliver = Deliver::training;
  std::size_t recordings = 0;     // that training experiments are intervals of; 0: each is one
  std::size_t delivery_folds = 0; // of experiments, that cross-validated ModelFit::on_all
};

struct CalibrationInput {
  const data::Dataset& training;
  const data::Dataset& validation; // leave_one_out, fit: the same data as training
  ModelOptions models;
  CalibrationOptions options;
  JudgedBy judged_by = JudgedBy::validation_files;
  const data::Dataset* undivided = nullptr; // held_out: both together, to draw the split again
  const data::Dataset* all = nullptr; // options.deliver: both together; nullptr: made where needed
};

// The job's conventions, with the shear limit off where the data have no flow stress.
models::Conventions conventions_of(const ModelOptions& models, const data::Dataset& data);

// Throws InputError where no law can be used, a law asked for by name lacks columns, or
// options.condition_on_mm cannot be done with these data.
Calibration calibrate(const CalibrationInput& input);

// The laws it would fit, in the order of the registry. Throws as calibrate() does.
std::vector<std::string> names_of_laws(const CalibrationInput& input);

// tau_R in MPa of every row; histories of the law's own stress are self-consistent. Throws
// InputError that names the inputs the data do not have.
std::vector<double> predict(const models::Model& model, const data::Dataset& data);

// The data's own word: a column `origin` that says "synthetic".
bool is_synthetic(const data::Dataset& data);

} // namespace frictab::calibrate
