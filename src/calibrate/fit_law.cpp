// Fits constants, means, parameters, the network and the polynomial through one interface.
#include "calibrate/fit_law.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/determined.h"
#include "calibrate/fit_weights.h"
#include "calibrate/law_problem.h"
#include "calibrate/slip_distance.h"
#include "core/no_value.h"
#include "core/text.h"

namespace frictab::calibrate {

using data::Dataset;
using models::Calibrated;

namespace {

// Sum and rows of tau over `per` in an experiment, weighted by row; for condensed data over the
// source rows, or over blocks if these differ in their uncertainty.
data::RatioSum ratio_in(const Dataset& data, std::size_t e, std::span<const double> per,
                        bool over_pressure, double factor, std::span<const double> weights) {
  if (data.condensed && !has_uncertainties(data)) {
    const data::RowsOfExperiment& one = data.condensed->experiments[e];
    data::RatioSum ratio = over_pressure ? one.over_pressure : one.over_flow;
    ratio.sum /= factor;
    return ratio;
  }
  const auto tau = data.values("tau_R_MPa");
  data::RatioSum ratio;
  for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
    if (!(per[i] > 0)) continue;
    const double weight = weights.empty() ? 1 : weights[i];
    ratio.sum += weight * tau[i] / (factor * per[i]);
    ratio.rows += weight;
  }
  return ratio;
}

void keep(ModelFit& fit, Uncertainty uncertainty) {
  fit.std_error = uncertainty.std_error;
  fit.model.covariance = row_by_row(known_covariance(uncertainty));
  fit.uncertainty = std::make_shared<const Uncertainty>(std::move(uncertainty));
}

// A mean over rows of experiments.
struct Mean {
  std::vector<data::RatioSum> parts; // per experiment
  double rows = 0, value = 0;

  double off(std::size_t e) const { return parts[e].sum - value * parts[e].rows; }
};

// Number of rows of an experiment without load or without resistance.
std::size_t count_unloaded(const Dataset& data, std::size_t e, std::span<const double> per,
                           const data::RatioSum& ratio) {
  if (!has_uncertainties(data)) return data.source_rows(e) - static_cast<std::size_t>(ratio.rows);
  return static_cast<std::size_t>(
      std::ranges::count_if(data.of_test(per, e), [](double x) { return !(x > 0); }));
}

// Covariance of means of experiments, and their values without each experiment.
Uncertainty uncertainty_of(const std::vector<Mean>& means) {
  const Eigen::Index size = means.size();
  const std::size_t experiments = means.front().parts.size();
  const auto count = static_cast<double>(experiments);
  Uncertainty u;
  u.correlation.setIdentity(size, size);
  u.condition = 1;
  u.covariance.setConstant(size, size, no_value);
  u.moved_without.setZero(size, experiments);
  u.error_without = u.moved_without;
  for (Eigen::Index a = 0; a < size; ++a) {
    const Mean& mean = means[static_cast<std::size_t>(a)];
    for (Eigen::Index b = 0; b < size && experiments > 1; ++b) {
      const Mean& other = means[static_cast<std::size_t>(b)];
      double sum = 0;
      for (std::size_t e = 0; e < experiments; ++e)
        sum += mean.off(e) * other.off(e);
      u.covariance(a, b) = sum * count / (count - 1) / (mean.rows * other.rows);
    }
    for (std::size_t e = 0; e < experiments; ++e) {
      const Eigen::Index at = e;
      const double part = mean.off(e) / mean.rows;
      u.moved_without(a, at) = -mean.off(e) / std::max(mean.rows - mean.parts[e].rows, 1.0);
      u.error_without(a, at) =
          std::sqrt(std::max(0.0, u.covariance(a, a) - part * part * count / (count - 1)));
    }
    u.std_error.push_back(std::sqrt(u.covariance(a, a)));
    u.why_none.emplace_back(experiments > 1 ? "" : "one experiment only");
  }
  return u;
}

// Calibrates as in the paper: the mean over all rows of mu_meas = tau/sigma_N or m_meas = tau/k,
// with the standard error of a mean of experiments.
void fit_means(ModelFit& fit, const Dataset& data) {
  std::vector<Mean> means;
  const std::vector<double> weights = fit_weights(data);
  for (const models::Parameter& parameter : fit.model.law->parameters) {
    const bool is_mu = parameter.name == "mu";
    const auto per = data.values(is_mu ? "sigma_n_MPa" : "sigma_f_MPa");
    const double factor = is_mu ? 1 : fit.model.conventions.k_over_sigma_f;
    Mean mean;
    double sum = 0;
    std::size_t unloaded = 0;
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      mean.parts.push_back(ratio_in(data, e, per, is_mu, factor, weights));
      unloaded += count_unloaded(data, e, per, mean.parts.back());
      sum += mean.parts.back().sum;
      mean.rows += mean.parts.back().rows;
    }
    mean.value = sum / mean.rows;
    fit.model.parameters.push_back(mean.value);
    means.push_back(std::move(mean));
    if (unloaded > 0)
      fit.remarks.push_back(fmt::format("{} rows without load are not in the mean of {}",
                                        thousands(unloaded), parameter.name));
  }
  keep(fit, uncertainty_of(means));
  fit.termination = "closed form";
  fit.std_error_method = "cluster by experiment";
  fit.evaluations = 1;
}

void remark_constant_inputs(ModelFit& fit, const InputColumns& columns) {
  if (std::ranges::none_of(fit.std_error, [](double e) { return std::isnan(e); })) return;
  const auto ranges = columns.ranges();
  for (const std::string& name : columns.names()) // in the order of inputs
    if (const auto range = ranges.find(name);
        range != ranges.end() && range->second.first == range->second.second)
      fit.remarks.push_back(
          fmt::format("{} is {} in every row: experiments at other values would settle it", name,
                      range->second.first));
}

double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, std::abs(a[i] - b[i]) / (std::abs(a[i]) + std::abs(b[i]) + 1e-12));
  return most;
}

// Alternates between histories that follow the law's own shear stress (friction work) and its
// parameters, starting from Coulomb friction with the mean coefficient. The measured stress is
// never used, because its noise would enter both sides of the fit.
std::vector<double> settled_tau(ModelFit& fit, const Dataset& data,
                                const CalibrationOptions& options) {
  constexpr int most_rounds = 40;
  constexpr double settled = 1e-7;
  const auto tau = data.values("tau_R_MPa"), pressure = data.values("sigma_n_MPa");
  double sum = 0, load = 0;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    sum += data.row_weight(i) * tau[i];
    load += data.row_weight(i) * pressure[i];
  }
  std::vector<double> own(pressure.begin(), pressure.end());
  for (double& value : own)
    value *= load > 0 ? sum / load : 0;
  double change = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<double> before = std::move(fit.model.parameters);
    fit.model.parameters = LawProblem(*fit.model.law, fit.model.conventions, data, own)
                               .fit(options.loss, options.huber_delta_MPa)
                               .result.parameters;
    own = predict(fit.model, data);
    change = before.empty() ? 1 : largest_change(before, fit.model.parameters);
    if (change < settled) break;
  }
  if (!(change < settled))
    fit.remarks.push_back(fmt::format("the history of its own shear stress and its parameters "
                                      "still change each other by {:.1g} after {} rounds",
                                      change, most_rounds));
  return own;
}

void fit_parameters(ModelFit& fit, const Dataset& data, const CalibrationOptions& options) {
  const models::Law& law = *fit.model.law;
  const models::Conventions& conventions = fit.model.conventions;
  std::vector<double> own_tau;
  if (InputColumns(law, models::inputs(law, conventions), data).need_tau())
    own_tau = settled_tau(fit, data, options);
  const LawProblem problem(law, conventions, data, own_tau);
  LawFit found = problem.fit(options.loss, options.huber_delta_MPa);
  problem.add_uncertainty(found, options.loss, options.huber_delta_MPa, data);
  fit.model.parameters = std::move(found.result.parameters);
  fit.termination = std::move(found.result.termination);
  fit.evaluations = found.result.evaluations;
  for (const std::string& remark : found.uncertainty.remarks)
    fit.remarks.push_back(remark);
  keep(fit, std::move(found.uncertainty));
  fit.std_error_method = "cluster sandwich by experiment";
  remark_constant_inputs(fit, problem.columns());
}

// Remarks that the law weights its bins of rows by their estimated scatter.
void remark_uncertainties(ModelFit& fit, const Dataset& data) {
  if (has_uncertainties(data))
    fit.remarks.push_back("does not use tau_R_error_MPa: it estimates the scatter itself");
}

void fit_ensemble(ModelFit& fit, const Dataset& data, const CalibrationOptions& options) {
  TrainedNetwork trained = train_network(*fit.model.law, data, fit.model.conventions, options.seed);
  const NetworkRecord& record = trained.record;
  fit.model.law = models::unregistered_law(std::move(trained.law));
  fit.model.parameters = {trained.mu0};
  fit.std_error = {no_value};
  fit.std_error_method =
      fmt::format("none for weights; the members of the ensemble differ by {:.2g} "
                  "MPa (standard deviation)",
                  record.spread_MPa);
  fit.evaluations = record.iterations;
  fit.termination = fmt::format("trained: {} nets, decay {} of {}", record.nets, record.decay,
                                record.decays.size());
  if (options.loss != Loss::l2)
    fit.remarks.push_back("trained on squared residuals, regardless of calibration.loss");
  remark_uncertainties(fit, data);
  if (record.dropped > 0)
    fit.remarks.push_back(fmt::format("{} of {} nets failed and are not in the ensemble",
                                      record.dropped, record.dropped + record.members));
  fit.model.experiment_gains = gains_of_new_experiments(std::move(trained.held_out_gains), 0);
  fit.network = record;
}

// Removes one row and its column.
Eigen::MatrixXd without_row(const Eigen::MatrixXd& m, std::size_t which) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    if (i != static_cast<Eigen::Index>(which)) kept.push_back(i);
  return m(kept, kept);
}

// Finds the slip distance of the law's states first; the delivered law has it as a number.
ModelFit fit_at_slip_distance(const models::Law& law, std::size_t parameter,
                              const models::Conventions& conventions, const Dataset& data,
                              const CalibrationOptions& options) {
  const models::Parameter& distance = law.parameters[parameter];
  if (law.calibrated == Calibrated::fixed)
    return fit_law(at_slip_distance(law, parameter, distance.start), conventions, data, options);
  const SlipDistance found = find_slip_distance(law, parameter, conventions, data, options);
  ModelFit fit =
      fit_law(at_slip_distance(law, parameter, found.distance_mm), conventions, data, options);
  fit.evaluations += found.evaluations;
  Uncertainty joint =
      slip_distance_uncertainty(law, parameter, found.distance_mm, fit.model, data, options);
  const std::ptrdiff_t at = parameter;
  const double error = found.at_bound ? no_value : joint.std_error[parameter];
  joint.std_error.erase(joint.std_error.begin() + at);
  if (std::isfinite(error)) {
    fit.std_error = std::move(joint.std_error);
    fit.model.covariance = row_by_row(without_row(known_covariance(joint), parameter));
    fit.std_error_method += ", " + distance.name + " among the parameters";
  } else
    fit.std_error_method += ", at the " + distance.name + " found";
  fit.remarks.push_back(fmt::format(
      "{} = {:.4g} mm{}, the best of {} tries{}{}", distance.name, found.distance_mm,
      std::isfinite(error) ? fmt::format(" \u00B1 {:.2g} (standard error by experiment)", error)
                           : "",
      found.evaluations, found.at_bound ? ", at its bound" : "",
      std::isfinite(error) ? "" : "; it has no standard error"));
  return fit;
}

void fit_terms(ModelFit& fit, const Dataset& data, const CalibrationOptions& options) {
  FittedPolynomial fitted =
      regress_polynomial(*fit.model.law, data, fit.model.conventions, options.seed);
  fit.model.law = models::unregistered_law(std::move(fitted.law));
  fit.model.parameters = {fitted.mu0};
  fit.std_error = {fitted.mu0_error};
  fit.std_error_method = "jackknife by experiment, the ridge held";
  fit.evaluations = fitted.evaluations;
  fit.termination = "closed form, scatter and ridge by restricted likelihood";
  fit.remarks = std::move(fitted.remarks);
  if (options.loss != Loss::l2)
    fit.remarks.push_back("by generalised least squares, regardless of calibration.loss");
  remark_uncertainties(fit, data);
  fit.model.experiment_gains = gains_of_new_experiments(std::move(fitted.held_out_gains), 0);
  fit.polynomial = std::move(fitted.record);
}

} // namespace

ModelFit fit_law(const models::Law& law, const models::Conventions& conventions,
                 const Dataset& data, const CalibrationOptions& options) {
  if (const auto distance = slip_distance(law, conventions))
    return fit_at_slip_distance(law, *distance, conventions, data, options);
  ModelFit fit;
  fit.model.law = models::shared_law(law);
  fit.model.conventions = conventions;
  switch (law.calibrated) {
  case Calibrated::fixed:
    fit.model.parameters = models::start_values(law.parameters);
    fit.std_error.assign(law.parameters.size(), 0.0);
    fit.model.covariance.assign(law.parameters.size() * law.parameters.size(), 0.0);
    fit.std_error_method = "fixed";
    fit.termination = "not calibrated";
    break;
  case Calibrated::mean:
    fit_means(fit, data);
    break;
  case Calibrated::fit:
    fit_parameters(fit, data, options);
    break;
  case Calibrated::train:
    fit_ensemble(fit, data, options);
    break;
  case Calibrated::regress:
    fit_terms(fit, data, options);
    break;
  }
  if (!models::is_trained(law.calibrated))
    fit.model.experiment_gains =
        gains_of_new_experiments(experiment_gains(data, predict(fit.model, data)),
                                 law.calibrated == Calibrated::fixed ? 0 : law.parameters.size());
  return fit;
}

ModelFit fit_and_judge(const models::Law& law, const models::Conventions& conventions,
                       const Dataset& data, const CalibrationOptions& options,
                       const JudgeFit& judge) {
  const auto begin = std::chrono::steady_clock::now();
  ModelFit fit = fit_law(law, conventions, data, options);
  const models::AssembledLaw assembled(fit.model);
  const Predicted fitted = predict_with_columns(assembled, assembled.inputs, data);
  fit.data_range = fitted.columns.ranges();
  add_determination(fit, fitted.columns, data.experiments.size());
  judge(fit, assembled, fitted);
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return fit;
}

} // namespace frictab::calibrate
