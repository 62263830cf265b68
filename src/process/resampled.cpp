// Fits laws to resampled tests, chooses one, and judges it in the process.
#include "process/resampled.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include <Eigen/Cholesky>

#include "calibrate/fit.h"
#include "calibrate/fit_weights.h"
#include "calibrate/input_columns.h"
#include "calibrate/recommended.h"
#include "core/columns.h"
#include "core/parallel.h"
#include "data/recordings.h"
#include "expr/program.h"
#include "models/assembled_law.h"
#include "process/smooth.h"
#include "stats/resampling.h"

namespace frictab::process {

using calibrate::ModelFit;
using data::Dataset;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t rows_of_a_fit = 40;

// ---- rows ----

// A few rows of each test, and how much each counts in a fit.
struct SomeRows {
  const Dataset& data;
  std::vector<std::size_t> rows, test;  // number in the data, test of each
  std::vector<double> measured, weight; // in fits
  std::vector<double> count;            // rows that each stands for, in errors
  data::Units units;

  explicit SomeRows(const Dataset& of) : data(of), units(data::units_of(of)) {
    const std::vector<double> weights = calibrate::fit_weights(data);
    const auto tau = data.values("tau_R_MPa");
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      const auto some = some_rows(data.first_row[e], data.first_row[e + 1], rows_of_a_fit);
      const double each = static_cast<double>(data.first_row[e + 1] - data.first_row[e]) /
                          static_cast<double>(some.size());
      for (const std::size_t row : some) {
        rows.push_back(row);
        test.push_back(e);
        measured.push_back(tau[row]);
        weight.push_back(each * (weights.empty() ? 1 : weights[row]));
        count.push_back(each);
      }
    }
  }

  // How often each test counts where its unit counts `times`.
  std::vector<double> by_test(std::span<const double> times) const {
    std::vector<double> out;
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      out.push_back(times[units.of[e]]);
    return out;
  }

  // Errors of each test, each of its rows here standing for as many.
  std::vector<stats::ErrorSums> errors(std::span<const double> tau) const {
    std::vector<stats::ErrorSums> sums(data.experiments.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      sums[test[i]].absolute += count[i] * std::abs(tau[i] - measured[i]);
      sums[test[i]].rows += count[i];
    }
    return sums;
  }
};

// A law's inputs at some rows, bound to its formula.
class BoundRows {
public:
  BoundRows(const models::AssembledLaw& law, const expr::Program& program, const Dataset& data,
            std::span<const std::size_t> rows) {
    const calibrate::InputColumns inputs = calibrate::input_columns(law, law.inputs, data);
    for (std::size_t c = 0; c < inputs.names().size(); ++c) {
      std::vector<double>& column = columns_.emplace_back();
      for (const std::size_t row : rows)
        column.push_back(inputs[c][row]);
    }
    bound_.emplace(program, rows.size(), pointers(columns_));
  }

  const expr::BoundProgram& bound() const { return *bound_; }

  std::vector<double> tau(std::span<const double> parameters) const {
    std::vector<double> out(bound_->rows());
    bound_->sweep(parameters, false, [&](const expr::BoundProgram::Block& block) {
      std::copy(block.value, block.value + block.count,
                out.begin() + static_cast<std::ptrdiff_t>(block.first));
    });
    return out;
  }

private:
  std::vector<std::vector<double>> columns_;
  std::optional<expr::BoundProgram> bound_;
};

std::vector<std::size_t> all_rows(const Dataset& data) {
  std::vector<std::size_t> rows(data.rows());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

// ---- the linear model, fitted to resamples ----

class SmoothAgain {
public:
  SmoothAgain(const Tests& tests, const SomeRows& judged, const ContactHistory& history,
              const std::vector<std::string>& names)
      : smooth_(tests.calibration, tests.training, names, ranges_of(tests.training, names)) {
    const auto tau = tests.training.values("tau_R_MPa"),
               load = tests.training.values("sigma_n_MPa");
    for (std::size_t e = 0; e < tests.training.experiments.size(); ++e) {
      const auto rows =
          some_rows(tests.training.first_row[e], tests.training.first_row[e + 1], rows_of_a_fit);
      const MatrixXd g = smooth_.bins(smooth_.design(states_at(tests.training, names, rows)));
      const VectorXd y = ln_mu(tau, load, rows);
      information_.push_back(g.transpose() * smooth_.weight() * g);
      score_.push_back(g.transpose() * smooth_.weight() * y);
    }
    all_ = fitted(std::vector<double>(score_.size(), 1.0));
    at_judged_ = smooth_.design(states_at(judged.data, names, judged.rows));
    at_process_ = smooth_.design(states_at(history.states, names, all_rows(history.states)));
  }

  // Change of the coefficients where tests count `times`.
  VectorXd moved(std::span<const double> times) const { return fitted(times) - all_; }
  std::vector<double> factors_judged(const VectorXd& moved) const {
    return factors(at_judged_, moved);
  }
  std::vector<double> factors_in_process(const VectorXd& moved) const {
    return factors(at_process_, moved);
  }

private:
  static VectorXd ln_mu(std::span<const double> tau, std::span<const double> load,
                        const std::vector<std::size_t>& rows) {
    constexpr double least_mu = 1e-4;
    VectorXd y(Smooth::bins_of_a_test);
    const auto n = static_cast<Index>(rows.size());
    for (Index b = 0; b < y.size(); ++b) {
      const Index from = std::min(b * n / y.size(), n - 1),
                  to = std::max((b + 1) * n / y.size(), from + 1);
      double stress = 0, pressure = 0;
      for (Index i = from; i < std::min(to, n); ++i) {
        stress += tau[rows[static_cast<std::size_t>(i)]];
        pressure += load[rows[static_cast<std::size_t>(i)]];
      }
      y(b) = std::log(std::max(pressure > 0 ? stress / pressure : 0, least_mu));
    }
    return y;
  }

  VectorXd fitted(std::span<const double> times) const {
    MatrixXd precision = smooth_.prior().cwiseInverse().asDiagonal();
    VectorXd right = VectorXd::Zero(smooth_.terms());
    for (std::size_t e = 0; e < score_.size(); ++e) {
      if (times[e] == 0) continue;
      precision += times[e] * information_[e];
      right += times[e] * score_[e];
    }
    return precision.ldlt().solve(right);
  }

  static std::vector<double> factors(const MatrixXd& design, const VectorXd& moved) {
    const VectorXd f = (design * moved).array().exp();
    return {f.begin(), f.end()};
  }

  Smooth smooth_;
  std::vector<MatrixXd> information_; // of each test
  std::vector<VectorXd> score_;
  VectorXd all_;
  MatrixXd at_judged_, at_process_;
};

// ---- one law ----

class LawAgain {
public:
  LawAgain(const ModelFit& fit, const SomeRows& fitted, const SomeRows& judged,
           const ContactHistory& history)
      : model_(fit.delivered().model), law_(model_),
        program_(law_.tau_R, law_.inputs, law_.parameters), how_(model_.law->calibrated),
        fit_rows_(fitted), fitted_(law_, program_, fitted.data, fitted.rows),
        judged_(law_, program_, judged.data, judged.rows),
        process_(law_, program_, history.states, all_rows(history.states)) {
    limit_ = model_.conventions.shear_limit ? std::optional(model_.conventions.k_over_sigma_f)
                                            : std::nullopt;
    if (is_trained()) {
      base_judged_ = judged_.tau(model_.parameters);
      base_process_ = process_.tau(model_.parameters);
    } else {
      as_fitted_ = parameters_of(std::vector<double>(fitted.data.experiments.size(), 1.0));
    }
  }

  bool is_trained() const { return models::is_trained(how_); }
  const std::string& name() const { return model_.law->name; }

  // Parameters where tests count `times`: the calibrated ones, moved as the fit to few rows moves.
  std::vector<double> again(std::span<const double> times) const {
    std::vector<double> p = parameters_of(times);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const models::Parameter& one = model_.law->parameters[i];
      p[i] = calibrate::is_scale(one) ? model_.parameters[i] * p[i] / as_fitted_[i]
                                      : model_.parameters[i] + p[i] - as_fitted_[i];
      p[i] = std::clamp(p[i], one.lower, one.upper);
    }
    return p;
  }

  std::vector<double> judged(std::span<const double> p) const { return judged_.tau(p); }
  std::vector<double> in_process(std::span<const double> p) const { return process_.tau(p); }
  std::vector<double> judged(const std::vector<double>& factors, const SomeRows& rows) const {
    return times(base_judged_, factors, rows.data, rows.rows);
  }
  std::vector<double> in_process(const std::vector<double>& factors, const Dataset& states) const {
    return times(base_process_, factors, states, {});
  }

private:
  std::vector<double> parameters_of(std::span<const double> times) const {
    if (how_ == models::Calibrated::fixed || model_.law->parameters.empty())
      return model_.parameters;
    std::vector<double> weights;
    for (std::size_t i = 0; i < fit_rows_.rows.size(); ++i)
      weights.push_back(times[fit_rows_.test[i]] * fit_rows_.weight[i]);
    if (how_ == models::Calibrated::mean) return means(weights);
    const calibrate::FitProblem problem{fitted_.bound(), fit_rows_.measured, model_.law->parameters,
                                        weights};
    return calibrate::fit_from(problem, {calibrate::Loss::l2, 0}, model_.parameters,
                               {.tolerance = 1e-7, .most_steps = 15})
        .parameters;
  }

  std::vector<double> means(std::span<const double> weights) const {
    std::vector<double> out;
    for (const models::Parameter& parameter : model_.law->parameters) {
      const bool is_mu = parameter.name == "mu";
      const auto per = fit_rows_.data.values(is_mu ? "sigma_n_MPa" : "sigma_f_MPa");
      const double factor = is_mu ? 1 : model_.conventions.k_over_sigma_f;
      double sum = 0, all = 0;
      for (std::size_t i = 0; i < weights.size(); ++i)
        if (const double x = factor * per[fit_rows_.rows[i]]; x > 0) {
          sum += weights[i] * fit_rows_.measured[i] / x;
          all += weights[i];
        }
      out.push_back(all > 0 ? sum / all : 0);
    }
    return out;
  }

  // `rows`: of the data; empty: all.
  std::vector<double> times(std::vector<double> tau, const std::vector<double>& factors,
                            const Dataset& data, std::span<const std::size_t> rows) const {
    const std::span<const double> flow =
        limit_ ? data.values("sigma_f_MPa") : std::span<const double>();
    for (std::size_t i = 0; i < tau.size(); ++i) {
      tau[i] *= factors[i];
      if (limit_) tau[i] = std::min(tau[i], *limit_ * flow[rows.empty() ? i : rows[i]]);
    }
    return tau;
  }

  models::Model model_;
  models::AssembledLaw law_;
  expr::Program program_;
  models::Calibrated how_;
  const SomeRows& fit_rows_;
  BoundRows fitted_, judged_, process_;
  std::optional<double> limit_; // k/sigma_f
  std::vector<double> as_fitted_, base_judged_, base_process_;
};

// ---- the draws ----

struct Draw {
  std::size_t chosen = 0;           // law
  std::vector<double> late_percent; // per law
};

double standard_deviation(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = 0;
  for (const double x : values)
    square += (x - mean) * (x - mean);
  return n > 1 ? std::sqrt(square / (n - 1)) : 0;
}

class Draws {
public:
  Draws(const Tests& tests, std::span<const std::string> laws, const ContactHistory& history,
        const UsedLaw& used, const Effects& effects)
      : tests_(tests), history_(history), used_(used), effects_(effects), fitted_(tests.training),
        judged_(tests.judged) {
    bool trained = false;
    for (const std::string& name : laws) {
      const ModelFit& fit = *calibrate::find_fit(tests.calibration, name);
      laws_.push_back(std::make_unique<LawAgain>(fit, fitted_, judged_, history));
      numbers_.push_back(calibrate::numbers_of(fit, tests.calibration.fits));
      trained = trained || laws_.back()->is_trained();
    }
    if (trained) smooth_.emplace(tests, judged_, history, smooth_states(tests.training));
  }

  const std::vector<std::unique_ptr<LawAgain>>& laws() const { return laws_; }

  Draw draw(std::size_t index) const {
    constexpr std::uint64_t of_judged = 0x6a756467; // "judg"
    const std::uint64_t seed = tests_.calibration.seed;
    std::vector<double> units(fitted_.units.count);
    stats::resample(seed, index, units);
    const std::vector<double> times = fitted_.by_test(units);
    std::vector<double> judged_times;
    if (calibrate::on_other_experiments(tests_.calibration.judged_by)) {
      std::vector<double> judged_units(judged_.units.count);
      stats::resample(seed ^ of_judged, index, judged_units);
      judged_times = judged_.by_test(judged_units);
    } else { // on the tests that the resample left out
      for (const double n : times)
        judged_times.push_back(n == 0 ? 1 : 0);
    }
    VectorXd moved;
    std::vector<double> judged_factors, process_factors;
    if (smooth_) {
      moved = smooth_->moved(times);
      judged_factors = smooth_->factors_judged(moved);
      process_factors = smooth_->factors_in_process(moved);
    }
    Draw out;
    std::vector<calibrate::LawErrors> errors;
    for (const auto& law : laws_) {
      std::vector<double> tau, there;
      if (law->is_trained()) {
        tau = law->judged(judged_factors, judged_);
        there = law->in_process(process_factors, history_.states);
      } else {
        const std::vector<double> p = law->again(times);
        tau = law->judged(p);
        there = law->in_process(p);
      }
      for (std::size_t row = 0; row < there.size(); ++row)
        there[row] *= used_.factor[row];
      errors.push_back({law->name(), repeated(judged_.errors(tau), judged_times)});
      out.late_percent.push_back(effects_.late_percent(there));
    }
    out.chosen = chosen(errors);
    return out;
  }

private:
  static std::vector<stats::ErrorSums> repeated(const std::vector<stats::ErrorSums>& sums,
                                                std::span<const double> times) {
    std::vector<stats::ErrorSums> out;
    for (std::size_t e = 0; e < sums.size(); ++e)
      out.insert(out.end(), static_cast<std::size_t>(times[e]), sums[e]);
    return out;
  }

  static double error_of(const calibrate::LawErrors& law) {
    double sum = 0, rows = 0;
    for (const stats::ErrorSums& one : law.sums) {
      sum += one.absolute;
      rows += one.rows;
    }
    return rows > 0 ? sum / rows : HUGE_VAL;
  }

  // By the rule of the recommendation: the simplest law that is not worse than the best.
  std::size_t chosen(const std::vector<calibrate::LawErrors>& errors) const {
    std::vector<std::size_t> order(errors.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return error_of(errors[a]) < error_of(errors[b]);
    });
    std::vector<calibrate::LawErrors> ranked;
    std::vector<std::size_t> numbers;
    for (const std::size_t l : order) {
      ranked.push_back(errors[l]);
      numbers.push_back(numbers_[l]);
    }
    const std::string law = calibrate::recommend(ranked, numbers).law;
    for (std::size_t l = 0; l < errors.size(); ++l)
      if (errors[l].law == law) return l;
    return order.front();
  }

  const Tests& tests_;
  const ContactHistory& history_;
  const UsedLaw& used_;
  const Effects& effects_;
  SomeRows fitted_, judged_;
  std::vector<std::unique_ptr<LawAgain>> laws_;
  std::vector<std::size_t> numbers_; // that each law has fitted
  std::optional<SmoothAgain> smooth_;
};

} // namespace

Resampled resample_tests(const Tests& tests, std::span<const std::string> laws,
                         const ContactHistory& history, const UsedLaw& used, const Effects& effects,
                         std::size_t draws) {
  Resampled out;
  if (draws == 0 || laws.empty() || data::units_of(tests.training).count < 3) return out;
  const Draws all(tests, laws, history, used, effects);
  std::vector<Draw> drawn(draws);
  parallel_for(draws, [&](std::size_t i) { drawn[i] = all.draw(i); });
  out.draws = draws;
  std::vector<double> chosen;
  for (const auto& law : all.laws())
    out.laws.push_back({law->name()});
  for (const Draw& draw : drawn) {
    out.laws[draw.chosen].share += 1 / static_cast<double>(draws);
    chosen.push_back(draw.late_percent[draw.chosen]);
  }
  for (std::size_t l = 0; l < out.laws.size(); ++l) {
    std::vector<double> own;
    for (const Draw& draw : drawn)
      own.push_back(draw.late_percent[l]);
    out.laws[l].sd_percent = standard_deviation(own);
  }
  out.median_percent = stats::quantile_of(chosen, 0.5);
  out.late_percent = {stats::quantile_of(chosen, 0.025), stats::quantile_of(chosen, 0.975)};
  return out;
}

} // namespace frictab::process
