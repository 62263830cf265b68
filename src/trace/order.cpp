// Permutation test and nuisance functions along the order of tests.
#include "trace/order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/random.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::uint64_t order_stream = 72;
constexpr int slow_waves = 4;

std::vector<std::size_t> ranks(std::span<const double> order) {
  std::vector<std::size_t> by(order.size()), rank(order.size());
  std::iota(by.begin(), by.end(), 0);
  std::stable_sort(by.begin(), by.end(),
                   [&](std::size_t a, std::size_t b) { return order[a] < order[b]; });
  for (std::size_t i = 0; i < by.size(); ++i)
    rank[by[i]] = i;
  return rank;
}

double wave(std::size_t rank, int number, std::size_t count) {
  return std::cos(std::numbers::pi * number * (static_cast<double>(rank) + 0.5) /
                  static_cast<double>(count));
}

using Statistics = std::array<double, 3>;

Statistics structure(const VectorXd& z, const MatrixXd& waves) {
  Statistics s{};
  double sum = 0, most = 0;
  for (Index i = 0; i < z.size(); ++i) {
    if (i > 0) s[0] += z(i) * z(i - 1);
    sum += z(i);
    most = std::max(most, std::abs(sum));
  }
  s[1] = most;
  s[2] = (waves.transpose() * z).squaredNorm();
  return s;
}

} // namespace

VectorXd experiment_scores(const VectorXd& residual, const VectorXd& sensitivity,
                           const MatrixXd& fitted, const Whitener& whitener,
                           std::span<const std::size_t> first) {
  MatrixXd all(residual.size(), fitted.cols() + 2);
  all.col(0) = residual;
  all.col(1) = sensitivity;
  all.rightCols(fitted.cols()) = fitted;
  whitener.apply(all);
  const MatrixXd q = orthonormal(all.rightCols(fitted.cols()));
  const VectorXd r = all.col(0) - q * (q.transpose() * all.col(0));
  VectorXd scores(static_cast<Index>(first.size() - 1));
  for (Index e = 0; e < scores.size(); ++e) {
    const auto begin = static_cast<Index>(first[static_cast<std::size_t>(e)]);
    const auto count = static_cast<Index>(first[static_cast<std::size_t>(e) + 1]) - begin;
    const auto s = all.col(1).segment(begin, count);
    scores(e) = s.dot(r.segment(begin, count)) / std::max(s.norm(), 1e-300);
  }
  return scores;
}

double order_p_value(const VectorXd& scores, std::span<const double> order,
                     std::size_t permutations, std::uint64_t seed) {
  const auto rank = ranks(order);
  const std::size_t count = rank.size();
  if (count < 10) return 1; // too few for any structure to show
  VectorXd z(scores.size());
  for (std::size_t e = 0; e < count; ++e)
    z(static_cast<Index>(rank[e])) = scores(static_cast<Index>(e));
  z.array() -= z.mean();
  MatrixXd waves(z.size(), slow_waves);
  for (Index i = 0; i < z.size(); ++i)
    for (int w = 0; w < slow_waves; ++w)
      waves(i, w) = wave(static_cast<std::size_t>(i), w + 1, count);
  std::vector<Statistics> all{structure(z, waves)}; // the first is the true order
  Random random(seed, order_stream);
  for (std::size_t b = 0; b < permutations; ++b) {
    random.shuffle(std::span(z.data(), count));
    all.push_back(structure(z, waves));
  }
  // Rank of each among all, per statistic; then the rank of the smallest.
  std::vector<double> smallest(all.size(), 1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> sorted;
    for (const Statistics& s : all)
      sorted.push_back(s[k]);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t b = 0; b < all.size(); ++b) {
      const auto beyond = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), all[b][k]);
      smallest[b] =
          std::min(smallest[b], static_cast<double>(beyond) / static_cast<double>(all.size()));
    }
  }
  const auto at_least = std::count_if(smallest.begin(), smallest.end(),
                                      [&](double p) { return p <= smallest.front(); });
  return static_cast<double>(at_least) / static_cast<double>(all.size());
}

MatrixXd order_functions(std::span<const double> order, int count) {
  const auto rank = ranks(order);
  MatrixXd functions(static_cast<Index>(rank.size()), count);
  for (std::size_t e = 0; e < rank.size(); ++e)
    for (int w = 0; w < count; ++w)
      functions(static_cast<Index>(e), w) = wave(rank[e], w + 1, rank.size());
  return functions;
}

MatrixXd on_blocks(const MatrixXd& functions, const VectorXd& sensitivity,
                   std::span<const std::size_t> first) {
  MatrixXd columns(sensitivity.size(), functions.cols());
  for (std::size_t e = 0; e + 1 < first.size(); ++e)
    for (std::size_t b = first[e]; b < first[e + 1]; ++b)
      columns.row(static_cast<Index>(b)) =
          sensitivity(static_cast<Index>(b)) * functions.row(static_cast<Index>(e));
  return columns;
}

} // namespace frictab
