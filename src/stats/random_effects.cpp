// REML by Fisher scoring, and the summaries based on it.
#include "stats/random_effects.h"

#include <algorithm>
#include <cmath>

#include <gsl/gsl_cdf.h>

#include "core/no_value.h"

namespace frictab::stats {

namespace {

using Estimates = std::span<const Estimate>;

// Sums of w, w^2, w^3 and w y of one group, w = 1/(std_error^2 + tau^2).
struct Sums {
  double w = 0, w2 = 0, w3 = 0, wy = 0;
  std::size_t count = 0;
  double mean() const { return wy / w; }
};

double weight(const Estimate& one, double variance) {
  return 1 / (one.std_error * one.std_error + variance);
}

std::vector<Sums> sums_of(Estimates all, double variance) {
  std::vector<Sums> groups;
  for (const Estimate& one : all) {
    if (groups.size() <= one.group) groups.resize(one.group + 1);
    Sums& s = groups[one.group];
    const double w = weight(one, variance);
    s.w += w;
    s.w2 += w * w;
    s.w3 += w * w * w;
    s.wy += w * one.value;
    ++s.count;
  }
  return groups;
}

// The scoring step: derivative of the restricted log-likelihood by tau^2 over the expected
// information, (y'PPy - tr P) / tr PP, with P = W - W X (X' W X)^-1 X' W.
double scoring_step(Estimates all, double variance) {
  const std::vector<Sums> groups = sums_of(all, variance);
  double score = 0, information = 0;
  for (const Sums& s : groups)
    if (s.count > 0) {
      score -= s.w - s.w2 / s.w;
      information += s.w2 - 2 * s.w3 / s.w + s.w2 * s.w2 / (s.w * s.w);
    }
  for (const Estimate& one : all) {
    const double from_mean = weight(one, variance) * (one.value - groups[one.group].mean());
    score += from_mean * from_mean;
  }
  return score / information;
}

bool has_pairs(Estimates all) {
  const std::vector<Sums> groups = sums_of(all, 1);
  return std::ranges::any_of(groups, [](const Sums& s) { return s.count > 1; });
}

// Plain variance about the group means, from which the scoring starts.
double plain_variance(Estimates all) {
  double sum = 0, free = 0;
  std::vector<double> total;
  std::vector<std::size_t> count;
  for (const Estimate& one : all) {
    if (total.size() <= one.group) {
      total.resize(one.group + 1);
      count.resize(one.group + 1);
    }
    total[one.group] += one.value;
    ++count[one.group];
  }
  for (const Estimate& one : all) {
    const double from_mean = one.value - total[one.group] / static_cast<double>(count[one.group]);
    sum += from_mean * from_mean;
  }
  for (const std::size_t n : count)
    free += n > 0 ? static_cast<double>(n) - 1 : 0;
  return sum / free;
}

constexpr Interval no_interval = {no_value, no_value};

Interval around(double middle, double half_width) {
  return {middle - half_width, middle + half_width};
}

double t_975(double degrees) {
  return gsl_cdf_tdist_Pinv(0.975, degrees);
}

std::vector<Estimate> in_one_group(Estimates estimates) {
  std::vector<Estimate> all(estimates.begin(), estimates.end());
  for (Estimate& one : all)
    one.group = 0;
  return all;
}

constexpr std::size_t most_candidates = 100;

std::vector<std::size_t> furthest(Estimates all) {
  const RandomEffects summary = random_effects(all);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double variance =
        all[i].std_error * all[i].std_error + summary.between_sd * summary.between_sd;
    order.emplace_back(-std::abs(all[i].value - summary.mean) / std::sqrt(variance), i);
  }
  const std::size_t n = std::min(order.size(), most_candidates);
  std::partial_sort(order.begin(), order.begin() + n, order.end());
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < n; ++i)
    indices.push_back(order[i].second);
  return indices;
}

Outlier against_others(Estimates all, std::size_t i) {
  std::vector<Estimate> rest(all.begin(), all.end());
  rest.erase(rest.begin() + i);
  Outlier one{all[i], random_effects(rest), 1};
  const RandomEffects& others = one.others;
  const double degrees = static_cast<double>(rest.size()) - 1;
  const double mean_error = (others.interval.high - others.mean) / t_975(degrees);
  const double variance = all[i].std_error * all[i].std_error +
                          others.between_sd * others.between_sd + mean_error * mean_error;
  const double t = std::abs(all[i].value - others.mean) / std::sqrt(variance);
  one.p_value = std::min(1.0, 2 * gsl_cdf_tdist_Q(t, degrees) * static_cast<double>(all.size()));
  return one;
}

} // namespace

double between_variance(Estimates estimates) {
  if (!has_pairs(estimates)) return no_value;
  double variance = plain_variance(estimates);
  if (!(variance > 0)) return 0;
  const double scale = variance;
  for (int i = 0; i < 200; ++i) {
    const double step = scoring_step(estimates, variance);
    const double next = std::max(0.0, variance + step);
    const bool done = std::abs(next - variance) <= 1e-10 * scale;
    variance = next;
    if (done) break;
  }
  return variance;
}

RandomEffects random_effects(Estimates estimates) {
  const std::vector<Estimate> all = in_one_group(estimates);
  RandomEffects out;
  out.campaigns = all.size();
  out.mean = out.between_sd = no_value;
  out.interval = out.predicted = no_interval;
  if (all.empty()) return out;
  const double found = between_variance(all);
  const double variance = std::isnan(found) ? 0 : found;
  const Sums s = sums_of(all, variance).front();
  out.mean = s.mean();
  out.between_sd = std::sqrt(found);
  if (all.size() < 2) return out;
  const double degrees = static_cast<double>(all.size()) - 1;
  double q = 0;
  for (const Estimate& one : all)
    q += weight(one, variance) * (one.value - out.mean) * (one.value - out.mean);
  const double mean_variance = std::max(1.0, q / degrees) / s.w;
  out.interval = around(out.mean, t_975(degrees) * std::sqrt(mean_variance));
  if (all.size() < 3) return out;
  out.predicted = around(out.mean, t_975(degrees - 1) * std::sqrt(variance + mean_variance));
  return out;
}

std::vector<Outlier> outliers(Estimates estimates) {
  std::vector<Outlier> found;
  if (estimates.size() < 4) return found;
  for (const std::size_t i : furthest(estimates))
    if (Outlier one = against_others(estimates, i); one.p_value < 0.05) found.push_back(one);
  return found;
}

Interval share_interval(std::size_t count, std::size_t of) {
  if (of == 0) return no_interval;
  const double n = static_cast<double>(of), p = static_cast<double>(count) / n;
  const double z = gsl_cdf_ugaussian_Pinv(0.975), z2 = z * z / n;
  const double half = z * std::sqrt(p * (1 - p) / n + z2 / (4 * n));
  return {(p + z2 / 2 - half) / (1 + z2), (p + z2 / 2 + half) / (1 + z2)};
}

} // namespace frictab::stats
