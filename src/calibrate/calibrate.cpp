// The calibration stage: which laws the columns allow, their parameters, their errors, the ranking.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "calibrate/comparison.h"
#include "calibrate/conditional.h"
#include "calibrate/input_columns.h"
#include "calibrate/law_problem.h"
#include "calibrate/metrics.h"
#include "calibrate/noise_floor.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "data/quantity.h"

namespace frictab::calibrate {

using data::Dataset;
using models::Calibrated;

namespace {

std::vector<std::string> missing_for(const models::Law& law, const models::Conventions& conventions,
                                     const CalibrationInput& input) {
  std::vector<std::string> missing;
  std::vector<std::string> needed = models::inputs(law, conventions);
  if (law.calibrated == Calibrated::train) {
    const auto states = network_inputs(law, input.training);
    needed.insert(needed.end(), states.begin(), states.end());
    if (input.training.experiments.size() < network_experiments)
      missing.push_back(fmt::format("{} experiments to train", network_experiments));
    if (states.empty()) missing.push_back("a state that varies");
  }
  for (const std::string& name : needed)
    if (!input.training.has(name) || !input.validation.has(name)) missing.push_back(name);
  return missing;
}

struct Selection {
  std::vector<const models::Law*> laws;
  std::vector<LeftOut> left_out;
};

Selection select_laws(const CalibrationInput& input, const models::Conventions& conventions) {
  Selection selection;
  FaultList faults;
  const auto& use = input.models.use;
  for (const models::Law& law : models::all_laws()) {
    const bool asked = std::find(use.begin(), use.end(), law.name) != use.end();
    if (!use.empty() && !asked) continue;
    const auto missing = missing_for(law, conventions, input);
    if (missing.empty()) {
      selection.laws.push_back(&law);
      continue;
    }
    const LeftOut left{law.name, join(missing, ", ")};
    if (asked)
      faults.add(input.models.place, "law " + left.text() + ", which the data do not have",
                 "map the columns in [data.columns], give a constant in [data.constants], or leave "
                 "the law out of models.use");
    else
      selection.left_out.push_back(left);
  }
  faults.throw_if_any();
  if (selection.laws.empty())
    throw InputError(input.models.place, "the data allow no friction law",
                     "needed at least: sigma_n_MPa and tau_R_MPa");
  return selection;
}

// The paper's calibration: the mean over all rows of mu_meas = tau/sigma_N or m_meas = tau/k, with
// the standard error of a mean of experiments.
void fit_means(ModelFit& fit, const Dataset& data) {
  const auto tau = data.values("tau_R_MPa");
  for (const models::Parameter& parameter : fit.model.law->parameters) {
    const bool is_mu = parameter.name == "mu";
    const auto per = data.values(is_mu ? "sigma_n_MPa" : "sigma_f_MPa");
    const double factor = is_mu ? 1 : fit.model.conventions.k_over_sigma_f;
    double sum = 0, rows = 0;
    std::vector<std::pair<double, double>> parts; // per experiment: sum, rows
    std::size_t unloaded = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      double part = 0, count = 0;
      for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
        if (!(per[i] > 0)) {
          ++unloaded;
          continue;
        }
        part += tau[i] / (factor * per[i]);
        ++count;
      }
      parts.emplace_back(part, count);
      sum += part;
      rows += count;
    }
    const double mean = sum / rows;
    double variance = 0;
    for (const auto& [part, count] : parts)
      variance += std::pow(part - mean * count, 2);
    const double experiments = static_cast<double>(parts.size());
    fit.model.parameters.push_back(mean);
    fit.std_error.push_back(experiments > 1
                                ? std::sqrt(variance * experiments / (experiments - 1)) / rows
                                : std::numeric_limits<double>::quiet_NaN());
    if (unloaded > 0)
      fit.remarks.push_back(fmt::format("{} rows without load are not in the mean of {}",
                                        thousands(unloaded), parameter.name));
  }
  fit.termination = "closed form";
  fit.std_error_method = "cluster by experiment";
  fit.evaluations = 1;
}

void remark_constant_inputs(ModelFit& fit, const Dataset& data) {
  for (const std::string& name : models::inputs(*fit.model.law, fit.model.conventions)) {
    const auto values = data.values(name);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (*low == *high && std::any_of(fit.std_error.begin(), fit.std_error.end(),
                                     [](double e) { return std::isnan(e); }))
      fit.remarks.push_back(fmt::format(
          "{} is {} in every row: experiments at other values would settle it", name, *low));
  }
}

void fit_parameters(ModelFit& fit, const Dataset& data, const CalibrationOptions& options) {
  const LawProblem problem(*fit.model.law, fit.model.conventions, data);
  LawFit found = problem.fit(options.loss, options.huber_delta_MPa);
  problem.add_uncertainty(found, options.loss, options.huber_delta_MPa, data.first_row);
  fit.model.parameters = std::move(found.result.parameters);
  fit.termination = std::move(found.result.termination);
  fit.evaluations = found.result.evaluations;
  fit.std_error = std::move(found.uncertainty.std_error);
  fit.remarks = std::move(found.uncertainty.remarks);
  fit.std_error_method = "cluster sandwich by experiment";
  remark_constant_inputs(fit, data);
}

void fit_ensemble(ModelFit& fit, const Dataset& data, const CalibrationOptions& options) {
  TrainedNetwork trained = train_network(*fit.model.law, data, fit.model.conventions, options.seed);
  const NetworkRecord& record = trained.record;
  fit.model.law = models::unregistered_law(std::move(trained.law));
  fit.model.parameters = {trained.mu0};
  fit.std_error = {std::numeric_limits<double>::quiet_NaN()};
  fit.std_error_method =
      fmt::format("none for weights; the members of the ensemble differ by {:.2g} "
                  "MPa (standard deviation)",
                  record.spread_MPa);
  fit.evaluations = record.iterations;
  fit.termination = fmt::format("trained: {} nets, decay {} of {}", record.nets, record.decay,
                                record.decays.size());
  if (options.loss != Loss::l2)
    fit.remarks.push_back("trained on squared residuals, whatever calibration.loss says");
  if (record.dropped > 0)
    fit.remarks.push_back(fmt::format("{} of {} nets failed and are not in the ensemble",
                                      record.dropped, record.dropped + record.members));
  fit.model.experiment_gains = gains_of_new_experiments(std::move(trained.held_out_gains), 0);
  fit.network = record;
}

ModelFit fit_law(const models::Law& law, const models::Conventions& conventions,
                 const CalibrationInput& input) {
  const auto begin = std::chrono::steady_clock::now();
  ModelFit fit;
  fit.model.law = models::registered_law(law);
  fit.model.conventions = conventions;
  switch (law.calibrated) {
  case Calibrated::fixed:
    for (const models::Parameter& parameter : law.parameters)
      fit.model.parameters.push_back(parameter.start);
    fit.std_error.assign(law.parameters.size(), 0.0);
    fit.std_error_method = "fixed";
    fit.termination = "not calibrated";
    break;
  case Calibrated::mean:
    fit_means(fit, input.training);
    break;
  case Calibrated::fit:
    fit_parameters(fit, input.training, input.options);
    break;
  case Calibrated::train:
    fit_ensemble(fit, input.training, input.options);
    break;
  }
  const auto judge = [&](const Dataset& data, const std::vector<double>& predicted) {
    return metrics(data.values("tau_R_MPa"), predicted, data.first_row, input.options.bootstrap,
                   input.options.seed);
  };
  const models::AssembledLaw assembled(fit.model);
  const auto [columns, trained] = predict_with_columns(assembled, assembled.inputs, input.training);
  fit.data_range = columns.ranges();
  const std::vector<double> unseen = predict(fit.model, input.validation);
  fit.training = judge(input.training, trained);
  fit.validation = judge(input.validation, unseen);
  if (law.calibrated != Calibrated::train)
    fit.model.experiment_gains = gains_of_new_experiments(
        experiment_gains(input.training.values("tau_R_MPa"), trained, input.training.first_row),
        law.calibrated == Calibrated::fixed ? 0 : law.parameters.size());
  fit.band = check_band(fit.model, unseen, input.validation);
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return fit;
}

} // namespace

std::string LeftOut::text() const {
  return law + ": needs " + needs;
}

models::Conventions conventions_of(const ModelOptions& models, const Dataset& data) {
  models::Conventions conventions;
  conventions.shear_yield = models.shear_yield;
  conventions.k_over_sigma_f = models::shear_yield_ratio(models.shear_yield);
  conventions.shear_limit = models.shear_limit && data.has("sigma_f_MPa");
  return conventions;
}

Calibration calibrate(const CalibrationInput& input) {
  const models::Conventions conventions = conventions_of(input.models, input.training);
  Selection selection = select_laws(input, conventions);
  check_conditional(input);
  Calibration calibration;
  calibration.left_out = std::move(selection.left_out);
  calibration.loss = input.options.loss;
  calibration.seed = input.options.seed;
  calibration.synthetic = is_synthetic(input.training) || is_synthetic(input.validation);
  calibration.data_hash = data::fingerprint(input.training, input.validation);
  calibration.validation_experiments = input.validation.experiments;
  calibration.fits.resize(selection.laws.size());
  Progress progress("calibrating laws", selection.laws.size());
  parallel_for(selection.laws.size(), [&](std::size_t i) {
    calibration.fits[i] = fit_law(*selection.laws[i], conventions, input);
    progress.tick();
  });
  std::stable_sort(calibration.fits.begin(), calibration.fits.end(),
                   [](const ModelFit& a, const ModelFit& b) {
                     return a.validation.mae_MPa < b.validation.mae_MPa;
                   });
  add_comparisons(calibration, input);
  add_noise_floors(calibration, input);
  add_conditional(calibration, input);
  return calibration;
}

std::vector<double> predict(const models::Model& model, const Dataset& data) {
  const models::AssembledLaw law(model);
  return predict_with_columns(law, law.inputs, data).tau_MPa;
}

bool is_synthetic(const Dataset& data) {
  const data::Column* origin = data.find("origin");
  return origin &&
         std::any_of(origin->levels.begin(), origin->levels.end(), [](const std::string& level) {
           return level.find("synthetic") != std::string::npos;
         });
}

} // namespace frictab::calibrate
