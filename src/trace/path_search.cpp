// Gram matrix of all shapes once; every permutation walks on it.
#include "trace/path_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_gamma.h>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "core/wide.h"
#include "trace/gram.h"
#include "trace/noise.h"
#include "trace/projection.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_shape_left = 0.02; // of a shape's variance, behind what is known
constexpr double least_effective = 4;     // tests that carry a shape of one degree of freedom
constexpr std::size_t least_free = 6;     // degrees of freedom
constexpr double least_after = 3;         // that a path leaves
constexpr std::size_t beam = 11;          // starts beside the best
constexpr std::uint64_t path_stream = 81;

// A shape behind what is known, its columns orthonormal.
struct Usable {
  std::size_t shape, name;
  Index first, count;
};

struct Ground {
  MatrixXd columns; // of all usable shapes
  MatrixXd gram;
  std::vector<Usable> usable;
  std::size_t free = 0;
};

// Its columns go to `columns`.
void add_shape(Ground& ground, const PathShape& shape, std::size_t index, const MatrixXd& known,
               std::vector<MatrixXd>& columns) {
  const MatrixXd centred = shape.columns.rowwise() - shape.columns.colwise().mean();
  const MatrixXd left = centred - known * (known.transpose() * centred);
  std::vector<Index> kept;
  for (Index c = 0; c < left.cols(); ++c)
    if (left.col(c).squaredNorm() > least_shape_left * centred.col(c).squaredNorm() &&
        left.col(c).norm() > 1e-12 * shape.columns.col(c).norm())
      kept.push_back(c);
  if (kept.empty()) return;
  const MatrixXd q = orthonormal(left(Eigen::all, kept));
  if (static_cast<double>(q.cols()) > std::max(1.0, static_cast<double>(ground.free) / 3)) return;
  if (q.cols() == 1 && 1 / q.array().pow(4).sum() < least_effective) return;
  const Usable* last = ground.usable.empty() ? nullptr : &ground.usable.back();
  ground.usable.push_back({index, shape.name, last ? last->first + last->count : 0, q.cols()});
  columns.push_back(q);
}

Ground ground_of(const PathInput& input, const MatrixXd& known) {
  Ground ground;
  ground.free = static_cast<std::size_t>(input.response.size() - known.cols());
  if (ground.free < least_free) return ground;
  std::vector<MatrixXd> columns;
  for (std::size_t s = 0; s < input.shapes.size(); ++s)
    add_shape(ground, input.shapes[s], s, known, columns);
  if (columns.empty()) return ground;
  const Usable& last = ground.usable.back();
  ground.columns.resize(input.response.size(), last.first + last.count);
  for (std::size_t u = 0; u < columns.size(); ++u)
    ground.columns.middleCols(ground.usable[u].first, ground.usable[u].count) = columns[u];
  ground.gram = gram(ground.columns);
  return ground;
}

FRICTAB_WIDE void subtract(double times, const double* __restrict from, Index count,
                           double* __restrict to) {
  for (Index i = 0; i < count; ++i)
    to[i] -= times * from[i];
}

FRICTAB_WIDE void take_column(double root, double along, Index count, double* __restrict u,
                              double* __restrict v, double* __restrict d) {
  for (Index i = 0; i < count; ++i) {
    u[i] /= root;
    v[i] -= along * u[i];
    d[i] -= u[i] * u[i];
  }
}

// One residual's walk over the shapes.
class Walk {
public:
  Walk(const Ground& ground, const VectorXd& along, double total)
      : g_(ground), total_(total), rest_(total), free_(static_cast<double>(ground.free)), v_(along),
        d_(ground.gram.diagonal()), open_(ground.usable.size(), 1) {}

  // The best next shape; npos where none is possible.
  std::size_t best() const {
    std::size_t found = npos;
    double most = 0;
    for (std::size_t s = 0; s < g_.usable.size(); ++s)
      if (const double r = may_explain(s, most) ? single(s) : 0; r > most) {
        most = r;
        found = s;
      }
    double least = found == npos ? 0 : log_p_of(most / rest_, 1, free_);
    for (std::size_t s = 0; s < g_.usable.size(); ++s) {
      const double q = static_cast<double>(g_.usable[s].count);
      if (q < 2 || !open_[s] || free_ - q < least_after || !group_may_explain(s, most)) continue;
      const double r = group(s);
      if (r <= most) continue; // more columns that explain less
      const double p = log_p_of(r / rest_, q, free_);
      if (p < least) {
        least = p;
        found = s;
      }
    }
    return found;
  }

  // The best shapes of the best names of one degree of freedom, at most `count`, best first.
  std::vector<std::size_t> best_of_names(std::size_t count) const {
    std::vector<std::pair<double, std::size_t>> best; // per name
    std::vector<std::size_t> at;
    for (std::size_t s = 0; s < g_.usable.size(); ++s) {
      const double r = single(s);
      if (r <= 0) continue;
      const std::size_t name = g_.usable[s].name;
      if (at.size() <= name) at.resize(name + 1, npos);
      if (at[name] == npos) {
        at[name] = best.size();
        best.emplace_back(-r, s);
      } else if (-r < best[at[name]].first)
        best[at[name]] = {-r, s};
    }
    count = std::min(count, best.size());
    std::partial_sort(best.begin(), best.begin() + static_cast<long>(count), best.end());
    std::vector<std::size_t> shapes;
    for (std::size_t rank = 0; rank < count; ++rank)
      shapes.push_back(best[rank].second);
    return shapes;
  }

  void take(std::size_t s) {
    const Usable& shape = g_.usable[s];
    for (Index c = shape.first; c < shape.first + shape.count; ++c) {
      const double root = std::sqrt(std::max(d_(c), 1e-12)), along = v_(c) / root;
      VectorXd u = g_.gram.col(c);
      for (const VectorXd& w : taken_)
        subtract(w(c), w.data(), u.size(), u.data());
      take_column(root, along, u.size(), u.data(), v_.data(), d_.data());
      explained_ += along * along;
      taken_.push_back(std::move(u));
    }
    columns_ += static_cast<double>(shape.count);
    free_ -= static_cast<double>(shape.count);
    rest_ = std::max(total_ - explained_, 1e-300);
    for (std::size_t o = 0; o < open_.size(); ++o)
      if (g_.usable[o].name == shape.name) open_[o] = 0;
  }

  // Of all that was taken.
  double log_p() const {
    return columns_ == 0 ? 0
                         : log_p_of(explained_ / total_, columns_, static_cast<double>(g_.free));
  }

  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

private:
  static constexpr double slack = 1 - 1e-9; // far beyond rounding

  // Whether single(s) can be more than `most`: without a division.
  bool may_explain(std::size_t s, double most) const {
    const Index c = g_.usable[s].first;
    return v_(c) * v_(c) > slack * most * d_(c);
  }

  // The same of a group: without a factorisation. Its columns were orthonormal, so no eigenvalue of
  // its matrix is below 1 minus the squares that were taken from it.
  bool group_may_explain(std::size_t s, double most) const {
    const Usable& shape = g_.usable[s];
    double left = 1;
    for (const VectorXd& w : taken_)
      left -= w.segment(shape.first, shape.count).squaredNorm();
    return left < least_shape_left ||
           v_.segment(shape.first, shape.count).squaredNorm() > slack * most * left;
  }

  // What a shape of one degree of freedom explains beside what was taken.
  double single(std::size_t s) const {
    const Usable& shape = g_.usable[s];
    if (shape.count != 1 || !open_[s] || free_ <= least_after ||
        d_(shape.first) <= least_shape_left)
      return 0;
    return v_(shape.first) * v_(shape.first) / d_(shape.first);
  }

  double group(std::size_t s) const {
    const Usable& shape = g_.usable[s];
    if (d_.segment(shape.first, shape.count).minCoeff() <= least_shape_left) return 0;
    MatrixXd a = g_.gram.block(shape.first, shape.first, shape.count, shape.count);
    for (const VectorXd& w : taken_) {
      const VectorXd own = w.segment(shape.first, shape.count);
      a -= own * own.transpose();
    }
    a.diagonal().array() += 1e-9;
    const VectorXd v = v_.segment(shape.first, shape.count);
    return v.dot(a.llt().solve(v));
  }

  const Ground& g_;
  double total_, rest_, explained_ = 0, columns_ = 0, free_;
  VectorXd v_, d_;
  std::vector<VectorXd> taken_;
  std::vector<char> open_;
};

// Best log p and shapes for each length.
struct Paths {
  std::vector<double> log_p;
  std::vector<std::vector<std::size_t>> shapes;
};

Paths walk_all(const Ground& ground, const VectorXd& along, double total, std::size_t longest) {
  Paths paths{std::vector<double>(longest, 0.0), std::vector<std::vector<std::size_t>>(longest)};
  const Walk from(ground, along, total);
  std::vector<std::size_t> first{from.best()};
  if (longest > 1) { // the best name is that of the first start
    const std::vector<std::size_t> names = from.best_of_names(beam + 1);
    if (!names.empty()) first.insert(first.end(), names.begin() + 1, names.end());
  }
  for (std::size_t start = 0; start < first.size(); ++start) {
    Walk walk = from;
    std::vector<std::size_t> taken;
    for (std::size_t k = 0; k < longest; ++k) {
      const std::size_t next = k == 0 ? first[start] : walk.best();
      if (next == Walk::npos) break;
      walk.take(next);
      taken.push_back(ground.usable[next].shape);
      const double p = walk.log_p();
      if (start == 0 || (k > 0 && p < paths.log_p[k] - 1e-12)) {
        paths.log_p[k] = p;
        paths.shapes[k] = taken;
      }
    }
  }
  return paths;
}

// Rank of each value among all, from 1 for the smallest, ties as the last of them; as a share.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> share;
  for (const double v : values)
    share.push_back(static_cast<double>(std::upper_bound(sorted.begin(), sorted.end(), v + 1e-9) -
                                        sorted.begin()) /
                    static_cast<double>(values.size()));
  return share;
}

double quantile_below(std::vector<double> values, double share) {
  const auto rank = static_cast<std::size_t>(
      std::max(std::floor(share * static_cast<double>(values.size() + 1)) - 1, 0.0));
  std::sort(values.begin(), values.end());
  return values[std::min(rank, values.size() - 1)];
}

// What search_path decides by: per length the log p of the data (index 0) and of permutations.
void decide(const std::vector<Paths>& all, double alpha, PathResult& result) {
  const std::size_t lengths = all.front().log_p.size();
  std::vector<double> least(all.size(), 1), own;
  std::vector<double> singles;
  for (std::size_t k = 0; k < lengths; ++k) {
    std::vector<double> values;
    for (const Paths& paths : all)
      values.push_back(paths.log_p[k]);
    const std::vector<double> share = ranks_of(values);
    for (std::size_t b = 0; b < all.size(); ++b)
      least[b] = std::min(least[b], share[b]);
    own.push_back(share.front());
    if (k == 0) singles.assign(values.begin() + 1, values.end());
  }
  result.p_value =
      static_cast<double>(std::count_if(least.begin(), least.end(),
                                        [&](double p) { return p <= least[0] + 1e-12; })) /
      static_cast<double>(least.size());
  std::vector<double> sorted = least;
  std::sort(sorted.begin(), sorted.end());
  const auto rank = static_cast<std::size_t>(
      std::max(std::floor(alpha * static_cast<double>(least.size())) - 1, 0.0));
  const double critical = sorted[rank];
  result.critical_log_p = quantile_below(singles, critical);
  const double enough = std::max(critical, *std::min_element(own.begin(), own.end())) + 1e-12;
  for (std::size_t k = 0; k < lengths && result.chosen.empty(); ++k)
    if (own[k] <= enough) result.chosen = all.front().shapes[k];
}

} // namespace

double log_p_of(double r_squared, double q, double free) {
  const double x = std::clamp(1 - r_squared, 1e-300, 1.0), a = 0.5 * (free - q), b = 0.5 * q;
  if (!(a > 0)) return 0;
  if (a * std::log(x) > -600) return std::log(gsl_cdf_beta_P(x, a, b));
  // The series' first term, where the tail is below what a double can hold.
  return a * std::log(x) - std::log(a) - gsl_sf_lnbeta(a, b);
}

PathResult search_path(const PathInput& input) {
  const auto tests = static_cast<std::size_t>(input.response.size());
  const MatrixXd known = orthonormal(input.known);
  PathResult result;
  const Ground ground = ground_of(input, known);
  if (ground.usable.empty()) return result;
  result.possible = true;
  const VectorXd left = input.response - known * (known.transpose() * input.response);
  const VectorXd leverage = known.rowwise().squaredNorm();
  const VectorXd exchangeable =
      left.array() / (1 - leverage.array()).max(0.05).sqrt(); // of equal variance
  const std::size_t longest = std::clamp<std::size_t>((ground.free - 2) / 3, 1, input.longest);
  std::vector<Paths> all(input.permutations + 1);
  const Progress progress("searching between tests", all.size());
  parallel_for(all.size(), [&](std::size_t b) {
    VectorXd e = left;
    if (b > 0) {
      std::vector<Index> order(tests);
      std::iota(order.begin(), order.end(), 0);
      Random(input.seed, path_stream + 1000 * b).shuffle(std::span(order));
      const VectorXd drawn = exchangeable(order);
      e = drawn - known * (known.transpose() * drawn);
    }
    all[b] = walk_all(ground, ground.columns.transpose() * e, e.squaredNorm() + 1e-300, longest);
    progress.tick();
  });
  decide(all, input.alpha, result);
  return result;
}

} // namespace frictab::trace
