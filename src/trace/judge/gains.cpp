// Means of logarithms over parts of a test; limits of the scatter between tests by chi-square
// (Paule and Mandel's estimate, in which a separate slope in each test does not count as scatter of
// the gain).
#include "trace/judge/gains.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gsl/gsl_cdf.h>

#include "calibrate/replicates.h"
#include "data/middle.h"
#include "data/shares.h"
#include "stats/projection.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

double squares_left(const VectorXd& y, const MatrixXd& columns) {
  const MatrixXd q = stats::orthonormal(columns);
  return std::max((y - q * (q.transpose() * y)).squaredNorm(), tuning::smallest_divisor);
}

// Mean square of the measured rows about a straight line through each block: the noise averaged
// away in block means.
double within_blocks(const data::Dataset& training, const stats::Blocks& blocks) {
  const auto tau = training.values("tau_R_MPa");
  double sum = 0;
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    const std::size_t begin = blocks.first_row[b], end = blocks.first_row[b + 1];
    const auto n = static_cast<double>(end - begin);
    if (end - begin < 2) continue;
    double my = 0, mx = (n - 1) / 2, xy = 0, xx = 0, yy = 0;
    for (std::size_t i = begin; i < end; ++i)
      my += tau[i] / n;
    for (std::size_t i = begin; i < end; ++i) {
      const double dx = static_cast<double>(i - begin) - mx, dy = tau[i] - my;
      xy += dx * dy;
      xx += dx * dx;
      yy += dy * dy;
    }
    // A line through two rows leaves nothing, so their mean is used.
    sum += end - begin == 2 ? yy : std::max(yy - xy * xy / xx, 0.0) * (n - 1) / (n - 2);
  }
  if (training.condensed) // the means scatter less than rows, and lack the scatter within them
    return (std::accumulate(training.condensed->within_MPa2.begin(),
                            training.condensed->within_MPa2.end(), 0.0) +
            sum * static_cast<double>(training.source_rows()) /
                static_cast<double>(training.rows())) /
           static_cast<double>(training.source_rows());
  return sum / static_cast<double>(training.rows());
}

// Excess kurtosis, at least 0. The variance of heavy-tailed values is less certain, as if there
// were fewer of them: their degrees of freedom are divided by 1 + kurtosis/2.
double excess_kurtosis(const VectorXd& values) {
  const Eigen::ArrayXd squares = (values.array() - values.mean()).square();
  const double variance = squares.mean();
  return variance > 0 ? std::max(0.0, squares.square().mean() / (variance * variance) - 3) : 0;
}

// Mean over experiments of the variance of a residual, by the noise model fitted to it.
double modelled_variance(const Search& search, const Rival& last) {
  const VectorXd residual = search.campaign().measured - last.predicted;
  const MatrixXd& nuisance = search.campaign().nuisance;
  const stats::NoiseModel noise = campaign_noise(
      search.campaign(), {residual, last.predicted, search.blocks(), last.jacobian, nuisance},
      &last.noise);
  return stats::Whitener(noise, last.predicted, search.blocks()).variance().mean() +
         within_blocks(search.input().training, search.blocks());
}

void add_floor(Trace& trace, const Search& search, const Rival& last) {
  const data::Dataset& training = search.input().training;
  // Upper bound of the noise: the RMSE of a law, corrected for the fitted parameters. (With few
  // experiments the likelihood may accept any scatter; and under the noise model's weights a law
  // that lacks something within tests may predict tests as a whole far worse than the calibrated
  // law.)
  const calibrate::Metrics &after = trace.after.training, &before = trace.as_calibrated.training;
  const calibrate::Metrics& least = before.rmse_MPa < after.rmse_MPa ? before : after;
  const double experiments = static_cast<double>(training.experiments.size());
  const double share_left = std::max(tuning::smallest_freedom_left, 1 - last.freedom / experiments);
  const double rmse =
      std::min(std::sqrt(modelled_variance(search, last)), least.rmse_MPa / std::sqrt(share_left));
  trace.noise_floor.method =
      "noise model: scatter between experiments, slow and white noise within, "
      "by restricted maximum likelihood; what no law goes below if nothing else is missing";
  trace.noise_floor.part = "training";
  trace.noise_floor.rmse_MPa = rmse;
  trace.noise_floor.mae_MPa = least.rmse_MPa > 0 ? rmse * least.mae_MPa / least.rmse_MPa : 0;
  trace.noise_floor.n_rows = training.source_rows();
  trace.noise_floor.n_experiments = training.experiments.size();
}

// Scatter among repeated tests, pooled; 0 if fewer than three can be compared.
struct Repeats {
  double scatter = 0, degrees = 0;
};
Repeats scatter_of_repeats(const data::Dataset& data, const VectorXd& gain) {
  Repeats repeats;
  double sum = 0;
  for (const auto& group : calibrate::replicate_groups(data)) {
    double mean = 0;
    for (const std::size_t e : group)
      mean += gain(e) / static_cast<double>(group.size());
    for (const std::size_t e : group)
      sum += std::pow(gain(e) - mean, 2);
    repeats.degrees += static_cast<double>(group.size() - 1);
  }
  if (repeats.degrees >= tuning::fewest_degrees_of_repeats)
    repeats.scatter = std::sqrt(sum / repeats.degrees);
  return repeats;
}

} // namespace

TestGains test_gains(const data::Dataset& data, std::span<const double> predicted) {
  const auto measured = data.values("tau_R_MPa");
  const std::size_t tests = data.experiments.size();
  TestGains out{VectorXd(tests), VectorXd(tests)};
  std::vector<double> per_row; // variance of a mean times the number of its rows
  std::vector<std::size_t> unknown;
  for (std::size_t e = 0; e < tests; ++e) {
    const std::size_t rows = data.first_row[e + 1] - data.first_row[e];
    const auto ratio = [&](std::size_t i) {
      const double law = std::max(predicted[i], tuning::smallest_divisor);
      return std::log(std::max(measured[i], tuning::smallest_gain_ratio * law) / law);
    };
    const std::size_t wanted = std::min(tuning::most_gain_parts, rows / tuning::rows_per_gain_part);
    const auto first = data::equal_shares(data, e, std::max<std::size_t>(wanted, 1));
    const std::size_t parts = wanted < 1 ? 0 : first.size() - 1;
    double sum = 0, all = 0;
    std::vector<double> means(first.size() - 1, 0.0);
    for (std::size_t p = 0; p < means.size(); ++p) {
      double weight = 0;
      for (std::size_t i = first[p]; i < first[p + 1]; ++i) {
        means[p] += data.row_weight(i) * ratio(i);
        weight += data.row_weight(i);
      }
      sum += means[p];
      all += weight;
      means[p] /= weight;
    }
    const Index at = e;
    out.gain(at) = sum / all;
    if (parts < tuning::fewest_gain_parts) {
      unknown.push_back(e);
      continue;
    }
    const Eigen::Map<const VectorXd> m(means.data(), parts);
    const auto k = static_cast<double>(parts);
    out.variance(at) = (m.array() - m.mean()).square().sum() / ((k - 1) * k);
    per_row.push_back(out.variance(at) * static_cast<double>(rows));
  }
  const double usual = data::median_of(per_row);
  for (const std::size_t e : unknown)
    out.variance(e) = usual / static_cast<double>(data.first_row[e + 1] - data.first_row[e]);
  return out;
}

double scatter_between(const VectorXd& gain, const VectorXd& variance, const MatrixXd& known) {
  const double free = static_cast<double>(gain.size() - stats::orthonormal(known).cols());
  if (free < 1) return 0;
  const auto excess = [&](double scatter) { // positive if the scatter is larger than that
    const VectorXd w =
        (scatter + variance.array() + tuning::smallest_gain_variance).inverse().sqrt();
    return squares_left(w.cwiseProduct(gain), w.asDiagonal() * known) - free;
  };
  double low = 0,
         high = tuning::widest_scatter_ratio * (gain.array() - gain.mean()).square().mean() +
                tuning::smallest_scatter_end;
  if (excess(0) <= 0) return 0;
  for (int i = 0; i < tuning::scatter_halvings; ++i)
    (excess(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

ValidationShift shift_of(const TestGains& seen, const TestGains& unseen, double freedom) {
  ValidationShift apart;
  if (unseen.gain.size() < 3 || seen.gain.size() < 2) return apart;
  const auto tests = static_cast<double>(seen.gain.size()),
             n = static_cast<double>(unseen.gain.size());
  const double free = std::max(1.0, tests - freedom);
  const auto square = [](const VectorXd& x) { return (x.array() - x.mean()).square().sum(); };
  const double own = square(unseen.gain) / (n - 1);
  const double of_law = square(seen.gain) / free;
  // Contribution of the uncertainty of the fitted parameters, assumed the same as in training.
  const double open = of_law * std::max(1.0, freedom) / tests;
  const double se = std::sqrt(std::max(own, of_law) / n + open);
  const double shift = unseen.gain.mean() - seen.gain.mean();
  const double degrees = std::min(free, n - 1);
  apart.p_value =
      2 * gsl_cdf_tdist_Q(std::abs(shift) / std::max(se, tuning::smallest_divisor), degrees);
  apart.found = apart.p_value < tuning::validation_shift_p_value;
  const double t = gsl_cdf_tdist_Qinv(tuning::tail_of_interval, degrees);
  apart.share = std::expm1(shift);
  apart.interval = {std::expm1(shift - t * se), std::expm1(shift + t * se)};
  return apart;
}

ValidationShift validation_shift_of(const Search& search, const Rival& rival) {
  const TraceInput& in = search.input();
  const models::Model model = search.model_of(rival);
  const std::vector<double> predicted = calibrate::predict(model, in.validation);
  ValidationShift apart = shift_of(test_gains(in.training, calibrate::predict(model, in.training)),
                                   test_gains(in.validation, predicted), rival.freedom);
  double mean = 0;
  for (const double value : predicted)
    mean += value / static_cast<double>(predicted.size());
  apart.shift_MPa = mean * apart.share;
  apart.interval = {mean * apart.interval.low, mean * apart.interval.high};
  return apart;
}

void add_scatter(Trace& trace, const Search& search, const Rival& last) {
  add_floor(trace, search, last);
  const data::Dataset& training = search.input().training;
  const TestGains gains = test_gains(training, calibrate::predict(search.model_of(last), training));
  MatrixXd directions = last.jacobian;
  stats::append_columns(directions, search.campaign().nuisance);
  const VectorXd law =
      last.predicted.cwiseMax(tuning::smallest_share_of_tau * search.tau_scale_MPa());
  MatrixXd known = MatrixXd::Ones(gains.gain.size(), 1);
  stats::append_columns(
      known, search.blocks().experiment_means(law.cwiseInverse().asDiagonal() * directions));
  const MatrixXd q = stats::orthonormal(known);
  const VectorXd left = gains.gain - q * (q.transpose() * gains.gain);
  const double free = std::max(1.0, static_cast<double>(gains.gain.size() - q.cols()));
  const double degrees = std::max(1.0, free / (1 + 0.5 * excess_kurtosis(left)));
  const double share = std::sqrt(scatter_between(gains.gain, gains.variance, known));
  const auto bound = [&](double probability) {
    return share * std::sqrt(degrees / gsl_cdf_chisq_Pinv(probability, degrees));
  };
  trace.scatter_between = share;
  trace.scatter_interval = {bound(1 - tuning::tail_of_interval), bound(tuning::tail_of_interval)};
  trace.scatter_at_least = bound(tuning::confidence_of_bound);
  if (trace.repeatability) {
    trace.repeatability_from = "given";
    return;
  }
  const Repeats repeats = scatter_of_repeats(training, left);
  if (!(repeats.scatter > 0)) return;
  trace.repeatability = repeats.scatter;
  trace.repeatability_from = "repeats";
  // The repeatability is an estimate too, so the bound is that of a ratio of variances (F).
  trace.scatter_at_least =
      share / std::sqrt(gsl_cdf_fdist_Pinv(tuning::confidence_of_bound, degrees, repeats.degrees));
}

} // namespace frictab::trace
