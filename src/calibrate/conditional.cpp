// Gain per experiment, its weight, and the remaining errors.
#include "calibrate/conditional.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/comparison.h"
#include "calibrate/cross_validation.h"
#include "calibrate/metrics.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"

namespace frictab::calibrate {

using data::Dataset;

namespace {

using Rows = std::span<const double>;

// Rows of one experiment; `weights`: number of rows each represents, empty: 1.
struct TestRows {
  Rows s_mm, measured, predicted, weights;
  double weight(std::size_t i) const { return weights.empty() ? 1 : weights[i]; }
};

TestRows rows_of(const Dataset& data, std::size_t e, Rows predicted) {
  const Rows weights = data.row_weights();
  return {data.of_test(data.values("s_mm"), e), data.of_test(data.values("tau_R_MPa"), e),
          data.of_test(predicted, e), weights.empty() ? weights : data.of_test(weights, e)};
}

// sum measured predicted / sum predicted^2 over the rows on one side of x; 0 without rows.
double gain_of(const TestRows& rows, double x_mm, bool beyond) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < rows.s_mm.size(); ++i)
    if ((rows.s_mm[i] > x_mm) == beyond) {
      product += rows.weight(i) * rows.measured[i] * rows.predicted[i];
      square += rows.weight(i) * rows.predicted[i] * rows.predicted[i];
    }
  return square > 0 ? product / square : 0;
}

FirstPart first_part(const TestRows& rows, double x_mm) {
  FirstPart part;
  for (std::size_t i = 0; i < rows.s_mm.size(); ++i)
    if (rows.s_mm[i] <= x_mm) part.rows += static_cast<std::size_t>(rows.weight(i));
  const double gain = gain_of(rows, x_mm, false);
  if (gain > 0) part.gain = gain;
  return part;
}

// Errors on the rows beyond x of every experiment that has some.
struct Rest {
  std::vector<stats::ErrorSums> plain, gained;
};

Rest rest_of(const Dataset& data, Rows plain, Rows gained, double x_mm) {
  const Rows s = data.values("s_mm"), tau = data.values("tau_R_MPa");
  Rest rest;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    stats::ErrorSums without, with;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      if (!(s[i] > x_mm)) continue;
      stats::add_row(without, data, i, tau[i] - plain[i]);
      stats::add_row(with, data, i, tau[i] - gained[i]);
    }
    if (without.rows == 0) continue;
    rest.plain.push_back(without);
    rest.gained.push_back(with);
  }
  return rest;
}

std::vector<double> shear_limit(const models::Model& model, const Dataset& data) {
  std::vector<double> limit;
  if (!model.conventions.shear_limit) return limit;
  for (const double sigma_f : data.values("sigma_f_MPa"))
    limit.push_back(model.conventions.k_over_sigma_f * sigma_f);
  return limit;
}

GainPrior prior_of(const models::Model& model, const Dataset& training, double x_mm) {
  return gain_prior(training, predict(model, training), x_mm);
}

// Adds errors with and without the gain, on the rests of the experiments of `data`.
void add_rests(std::vector<LawErrors>& both, const models::Model& model, const GainPrior& prior,
               const Dataset& data, double x_mm) {
  const std::vector<double> plain = predict(model, data);
  const Rest rest =
      rest_of(data, plain,
              conditioned_predictions(data, plain, shear_limit(model, data), prior, x_mm), x_mm);
  both[0].sums.insert(both[0].sums.end(), rest.gained.begin(), rest.gained.end());
  both[1].sums.insert(both[1].sums.end(), rest.plain.begin(), rest.plain.end());
}

// Predicts each experiment by the law fitted without it, with a prior from the others.
void add_left_out_rests(std::vector<LawErrors>& both, const ModelFit& fit, const Dataset& data,
                        double x_mm) {
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const GainPrior prior = prior_of(fit.without[e], without_kin(data, e), x_mm);
    add_rests(both, fit.without[e], prior, data.subset(std::array{e}), x_mm);
  }
}

ConditionalFit fit_of(const ModelFit& judged, const CalibrationInput& input, double x_mm) {
  const models::Model& model = judged.model;
  const GainPrior prior = prior_of(model, input.training, x_mm);
  std::vector<LawErrors> both = {{"conditional", {}}, {"unconditional", {}}};
  if (input.judged_by == JudgedBy::leave_one_out)
    add_left_out_rests(both, judged, input.training, x_mm);
  else
    add_rests(both, model, prior, input.validation, x_mm);
  const std::size_t resamples = input.options.bootstrap;
  const std::uint64_t seed = input.options.seed;
  ConditionalFit fit;
  fit.law = model.law->name;
  fit.usual_first = prior.usual_first;
  fit.usual_rest = prior.usual_rest;
  fit.between_sd = std::sqrt(prior.between);
  fit.error_sd = std::sqrt(prior.error);
  fit.trust = prior.trust(static_cast<std::size_t>(prior.usual_rows));
  fit.conditional = metrics(both[0].sums, resamples, seed);
  fit.unconditional = metrics(both[1].sums, resamples, seed);
  const Comparisons comparison = compare(both, resamples, seed);
  if (!comparison.pairs.empty())
    fit.gain = comparison.pairs.front().mae;
  else
    fit.gain.value_MPa = fit.unconditional.mae_MPa - fit.conditional.mae_MPa;
  return fit;
}

double longest(const Dataset& data) {
  const Rows s = data.values("s_mm");
  return s.empty() ? 0 : *std::ranges::max_element(s);
}

bool has_both_parts(const Dataset& data, std::size_t e, double x_mm) {
  const Rows s = data.of_test(data.values("s_mm"), e);
  const auto [low, high] = std::ranges::minmax_element(s);
  return *low <= x_mm && *high > x_mm;
}

} // namespace

double GainPrior::trust(std::size_t rows) const {
  if (rows == 0 || !(between > 0)) return 0;
  return between / (between + error * std::max(1.0, usual_rows / static_cast<double>(rows)));
}

double GainPrior::gain(const FirstPart& first) const {
  return std::max(0.0, usual_rest + trust(first.rows) * (first.gain - usual_first));
}

GainPrior gain_prior(const Dataset& training, Rows predicted, double x_mm) {
  GainPrior prior;
  std::vector<double> rows, firsts, rests;
  for (std::size_t e = 0; e < training.experiments.size(); ++e) {
    const TestRows test = rows_of(training, e, predicted);
    const double rest = gain_of(test, x_mm, true);
    const FirstPart first = first_part(test, x_mm);
    if (first.rows == 0 || rest == 0) continue;
    firsts.push_back(first.gain);
    rests.push_back(rest);
    rows.push_back(static_cast<double>(first.rows));
  }
  if (rows.empty()) return prior;
  const double n = static_cast<double>(rows.size());
  prior.usual_first = std::accumulate(firsts.begin(), firsts.end(), 0.0) / n;
  prior.usual_rest = std::accumulate(rests.begin(), rests.end(), 0.0) / n;
  double product = 0, square = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    product += (firsts[i] - prior.usual_first) * (rests[i] - prior.usual_rest);
    square += (firsts[i] - prior.usual_first) * (firsts[i] - prior.usual_first);
  }
  prior.between = std::max(0.0, product / n);
  prior.error = std::max(0.0, square / n - prior.between);
  prior.usual_rows = std::floor(stats::quantile_of(rows, 0.5));
  return prior;
}

std::vector<double> conditioned_predictions(const Dataset& data, Rows predicted, Rows limit,
                                            const GainPrior& prior, double x_mm) {
  std::vector<double> out(predicted.begin(), predicted.end());
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const double gain = prior.gain(first_part(rows_of(data, e, predicted), x_mm));
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      out[i] *= gain;
      if (!limit.empty()) out[i] = std::min(out[i], limit[i]);
    }
  }
  return out;
}

void check_conditional(const CalibrationInput& input) {
  if (!input.options.condition_on_mm) return;
  const double x = *input.options.condition_on_mm;
  FaultList faults;
  for (const auto& [data, part] :
       {std::pair{&input.training, "training"}, std::pair{&input.validation, "validation"}}) {
    if (!data->has("s_mm")) {
      faults.add(input.options.place,
                 fmt::format(
                     "calibration.condition_on_mm needs s_mm, which the {} data do not have", part),
                 "map s_mm in [data.columns], or time_s and v_rel_mm_s, from which it is "
                 "integrated; or leave the key out");
      continue;
    }
    std::size_t usable = 0;
    for (std::size_t e = 0; e < data->experiments.size(); ++e)
      usable += has_both_parts(*data, e, x);
    const double most = longest(*data);
    if (!(most > x))
      faults.add(input.options.place,
                 fmt::format("calibration.condition_on_mm = {} leaves no row of the {} data to be "
                             "judged on: the longest sliding distance is {} mm",
                             shortest(x), part, shortest(most)),
                 "use a small part of the distance, for example " +
                     fmt::format("{:.2g}", most / 10));
    else if (usable == 0)
      faults.add(input.options.place,
                 fmt::format("no experiment of the {} data has rows on both sides of "
                             "calibration.condition_on_mm = {}",
                             part, shortest(x)),
                 "choose a distance inside the experiments, or leave the key out");
  }
  faults.throw_if_any();
}

void add_conditional(Calibration& calibration, const CalibrationInput& input) {
  if (!input.options.condition_on_mm) return;
  Conditional& c = calibration.conditional;
  c.condition_on_mm = *input.options.condition_on_mm;
  const Rows s = input.validation.values("s_mm");
  c.n_experiments = input.validation.experiments.size();
  for (std::size_t e = 0; e < c.n_experiments; ++e) {
    const Rows own = input.validation.of_test(s, e);
    const auto [low, high] = std::ranges::minmax_element(own);
    c.n_without_start += !(*low <= c.condition_on_mm);
    c.n_without_rest += !(*high > c.condition_on_mm);
  }
  // any prediction gives the same number of rows
  c.usual_rows = static_cast<std::size_t>(
      gain_prior(input.training, input.training.values("tau_R_MPa"), c.condition_on_mm).usual_rows);
  c.laws.resize(calibration.fits.size());
  const Progress progress("laws at a known sliding distance", c.laws.size());
  parallel_for(c.laws.size(), [&](std::size_t i) {
    c.laws[i] = fit_of(calibration.fits[i], input, c.condition_on_mm);
    progress.tick();
  });
  std::ranges::stable_sort(c.laws, {},
                           [](const ConditionalFit& fit) { return fit.conditional.mae_MPa; });
}

} // namespace frictab::calibrate
