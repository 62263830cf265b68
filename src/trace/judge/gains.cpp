// Means of logarithms over parts of a test.
#include "trace/judge/gains.h"

#include <algorithm>
#include <cmath>

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
    const auto at = static_cast<Index>(e);
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

} // namespace frictab::trace
