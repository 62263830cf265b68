// Permutation test and slow functions along the order of tests.
#include "trace/columns/order_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/random.h"
#include "stats/projection.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

constexpr std::uint64_t order_stream = 72;

double wave(std::size_t rank, int number, std::size_t count) {
  return std::cos(std::numbers::pi * number * (static_cast<double>(rank) + 0.5) /
                  static_cast<double>(count));
}

// Statistics of one column of scores, in a given order.
std::array<double, 3> structure(const VectorXd& z, const MatrixXd& waves) {
  std::array<double, 3> s{};
  double sum = 0, most = 0;
  for (Index i = 0; i < z.size(); ++i) {
    for (Index lag = 1; lag <= std::min(i, tuning::largest_batch_distance); ++lag)
      s[0] += z(i) * z(i - lag) * static_cast<double>(tuning::largest_batch_distance + 1 - lag);
    sum += z(i);
    most = std::max(most, std::abs(sum));
  }
  s[1] = most;
  s[2] = (waves.transpose() * z).squaredNorm();
  return s;
}

// Statistics of all columns.
VectorXd structures(const MatrixXd& z, std::span<const std::size_t> order, const MatrixXd& waves) {
  VectorXd all(3 * z.cols());
  VectorXd ordered(z.rows());
  for (Index c = 0; c < z.cols(); ++c) {
    for (std::size_t i = 0; i < order.size(); ++i)
      ordered(i) = z(order[i], c);
    const auto s = structure(ordered, waves);
    all.segment<3>(3 * c) << s[0], s[1], s[2];
  }
  return all;
}

} // namespace

std::vector<std::size_t> ranks(std::span<const double> order) {
  std::vector<std::size_t> by(order.size()), rank(order.size());
  std::iota(by.begin(), by.end(), 0);
  std::ranges::stable_sort(by, [&](std::size_t a, std::size_t b) { return order[a] < order[b]; });
  for (std::size_t i = 0; i < by.size(); ++i)
    rank[by[i]] = i;
  return rank;
}

VectorXd experiment_scores(const VectorXd& residual, const VectorXd& sensitivity,
                           const MatrixXd& fitted, const stats::Whitener& whitener,
                           std::span<const std::size_t> first) {
  MatrixXd all(residual.size(), fitted.cols() + 2);
  all.col(0) = residual;
  all.col(1) = sensitivity;
  all.rightCols(fitted.cols()) = fitted;
  whitener.apply(all);
  const MatrixXd q = stats::orthonormal(all.rightCols(fitted.cols()));
  const VectorXd r = all.col(0) - q * (q.transpose() * all.col(0));
  VectorXd scores(first.size() - 1);
  for (Index e = 0; e < scores.size(); ++e) {
    const auto begin = static_cast<Index>(first[e]);
    const auto count = static_cast<Index>(first[e + 1]) - begin;
    const auto s = all.col(1).segment(begin, count);
    scores(e) = s.dot(r.segment(begin, count)) / std::max(s.norm(), tuning::smallest_divisor);
  }
  return scores;
}

OrderTest test_order(const MatrixXd& scores, std::span<const double> order,
                     std::size_t permutations, std::uint64_t seed) {
  const auto rank = ranks(order);
  const std::size_t count = rank.size();
  if (count < tuning::fewest_tests_for_order) return {}; // too few to show any structure
  MatrixXd z = scores.rowwise() - scores.colwise().mean();
  MatrixXd waves(z.rows(), tuning::order_test_waves);
  for (Index i = 0; i < z.rows(); ++i)
    for (int w = 0; w < tuning::order_test_waves; ++w)
      waves(i, w) = wave(i, w + 1, count);
  std::vector<std::size_t> at(count); // experiment at each rank
  for (std::size_t e = 0; e < count; ++e)
    at[rank[e]] = e;
  const auto all_count = static_cast<Index>(permutations + 1);
  MatrixXd all(all_count, 3 * z.cols());
  all.row(0) = structures(z, at, waves); // the true order
  Random random(seed, order_stream);
  for (Index b = 1; b < all_count; ++b) {
    random.shuffle(std::span(at));
    all.row(b) = structures(z, at, waves);
  }
  // p-value of each among all, per statistic; then the rank of the smallest.
  VectorXd smallest = VectorXd::Ones(all_count);
  for (Index k = 0; k < all.cols(); ++k) {
    std::vector<double> sorted(all.col(k).data(), all.col(k).data() + all_count);
    std::ranges::sort(sorted);
    for (Index b = 0; b < all_count; ++b) {
      const auto beyond = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), all(b, k));
      smallest(b) =
          std::min(smallest(b), static_cast<double>(beyond) / static_cast<double>(all_count));
    }
  }
  OrderTest test;
  test.p_value = static_cast<double>((smallest.array() <= smallest(0)).count()) /
                 static_cast<double>(all_count);
  double most = -1;
  for (Index c = 0; c < z.cols(); ++c)
    if (const double part = all(0, 3 * c + 2) / z.col(c).squaredNorm(); part > most) {
      most = part;
      test.column = c;
    }
  return test;
}

MatrixXd order_functions(std::span<const double> order, int count) {
  const auto rank = ranks(order);
  MatrixXd functions(rank.size(), count);
  for (std::size_t e = 0; e < rank.size(); ++e)
    for (int w = 0; w < count; ++w)
      functions(e, w) = wave(rank[e], w + 1, rank.size());
  return functions;
}

MatrixXd functions_on_blocks(const MatrixXd& functions, const VectorXd& sensitivity,
                             std::span<const std::size_t> first) {
  MatrixXd columns(sensitivity.size(), functions.cols());
  for (std::size_t e = 0; e + 1 < first.size(); ++e)
    for (std::size_t b = first[e]; b < first[e + 1]; ++b)
      columns.row(b) = sensitivity(b) * functions.row(e);
  return columns;
}

} // namespace frictab::trace
