// Whitens, projects, scores and flips; single precision, a cause at a time.
#include "trace/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "trace/projection.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;
using Eigen::VectorXf;

constexpr double least_left = 0.002; // of a direction, behind what fitted parameters imitate
constexpr std::uint64_t flip_stream = 71;
constexpr float least_variance_share = 1e-3f; // of the sum of squared scores, as a variance
constexpr Index least_experiments = 7;        // that carry a direction, ...
constexpr float share_of_most = 0.05f;   // ... each at least so much of what the first of them does
constexpr std::size_t most_groups = 400; // whose signs are flipped
constexpr std::uint64_t group_stream = 72;
constexpr Index slab_values = 1 << 23; // of directions that are whitened together: 32 MiB

constexpr double most_leverage = 0.98; // that is undone

// (I - H)^-1/2 r, H = Q Q'.
VectorXd without_leverage(const MatrixXd& q, const VectorXd& r) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(q * q.transpose());
  const Eigen::ArrayXd l = solver.eigenvalues().array().max(0.0).min(most_leverage);
  const VectorXd along = solver.eigenvectors().transpose() * r;
  return solver.eigenvectors() * ((1 - l).sqrt().inverse() * along.array()).matrix();
}

// A fit follows each experiment a little, which makes the residuals of experiments with leverage
// too small. (I - H_ee)^-1/2 r, H_ee = Q_e Q_e', undoes that (CR2: Bell and McCaffrey 2002).
void undo_leverage(const MatrixXd& q, std::span<const std::size_t> first, VectorXd& residual) {
  if (q.cols() == 0) return; // no parameter moves any row
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    const auto begin = static_cast<Index>(first[e]);
    const auto count = static_cast<Index>(first[e + 1]) - begin;
    const MatrixXd own = q.middleRows(begin, count);
    if (count < own.cols()) { // of few rows H_ee itself is the smaller matrix
      residual.segment(begin, count) = without_leverage(own, residual.segment(begin, count));
      continue;
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(own.transpose() * own);
    VectorXd factor = solver.eigenvalues();
    for (Index i = 0; i < factor.size(); ++i) {
      const double l = std::clamp(factor(i), 0.0, most_leverage);
      factor(i) = l < 1e-9 ? 0.5 : (1 / std::sqrt(1 - l) - 1) / l;
    }
    const VectorXd along =
        solver.eigenvectors().transpose() * (own.transpose() * residual.segment(begin, count));
    residual.segment(begin, count) += own * (solver.eigenvectors() * factor.cwiseProduct(along));
  }
}

std::size_t count_of(std::span<const std::size_t> units) {
  return *std::max_element(units.begin(), units.end()) + 1;
}

// Per experiment the group whose sums are flipped as one: itself, or one of 400.
std::vector<std::size_t> groups_of(std::span<const std::size_t> units, std::uint64_t seed) {
  std::vector<std::size_t> group(units.size());
  std::iota(group.begin(), group.end(), 0);
  if (units.size() <= most_groups) return group;
  std::vector<std::size_t> of_unit(count_of(units));
  for (std::size_t u = 0; u < of_unit.size(); ++u)
    of_unit[u] = u % most_groups;
  Random(seed, group_stream).shuffle(std::span(of_unit));
  for (std::size_t e = 0; e < units.size(); ++e)
    group[e] = of_unit[units[e]];
  return group;
}

MatrixXf signs(std::size_t flips, std::span<const std::size_t> units, std::uint64_t seed) {
  MatrixXf s(static_cast<Index>(flips), static_cast<Index>(units.size()));
  std::vector<float> sign(count_of(units));
  for (Index b = 0; b < s.rows(); ++b) {
    Random random(seed, flip_stream + 1000 * static_cast<std::uint64_t>(b));
    for (float& of_unit : sign)
      of_unit = random.uniform() < 0.5 ? -1.0f : 1.0f;
    for (std::size_t e = 0; e < units.size(); ++e)
      s(b, static_cast<Index>(e)) = sign[units[e]];
  }
  return s;
}

struct CauseScores {
  std::vector<Direction> directions;
  MatrixXf scores; // groups x directions
  MatrixXf shares; // of each group in a direction's squared size
  VectorXf maxima; // per flip
  bool absorbed = false;
};

class Screening {
public:
  explicit Screening(const ScreenInput& input) : in_(input) {
    MatrixXd fitted = in_.fitted;
    in_.whitener.apply(fitted);
    const MatrixXd q = orthonormal(fitted);
    MatrixXd residual = in_.residual;
    in_.whitener.apply(residual);
    VectorXd r = residual.col(0) - q * (q.transpose() * residual.col(0));
    undo_leverage(q, in_.first, r);
    q_ = q.cast<float>();
    residual_ = r.cast<float>();
    group_ = groups_of(in_.units, in_.seed);
    group_count_ = static_cast<Index>(count_of(group_));
    signs_ = signs(in_.flips, units_of_groups(), in_.seed);
    for (std::size_t p = 0; p < sites.size(); ++p)
      sensitivity_[p] = in_.sensitivities[p].cast<float>();
  }

  Index groups() const { return group_count_; }

  // In parts of shapes, so that a cause of many shapes does not fill the memory.
  CauseScores run(std::size_t cause) const {
    const auto shapes = static_cast<Index>(in_.shapes[cause].size());
    const auto sites_each = static_cast<Index>(sites.size());
    const Index each =
        std::max<Index>(1, slab_values / std::max<Index>(1, in_.residual.size() * sites_each));
    CauseScores found = run(cause, 0, std::min(each, shapes));
    for (Index begin = each; begin < shapes; begin += each)
      append(run(cause, begin, std::min(begin + each, shapes)), found);
    return found;
  }

private:
  CauseScores run(std::size_t cause, Index begin, Index end) const {
    CauseScores found;
    MatrixXf x = columns(cause, begin, end, found.directions);
    found.absorbed = x.cols() == 0;
    if (x.cols() == 0) return found;
    in_.whitener.apply(x);
    const VectorXf before = x.colwise().norm();
    x -= q_ * (q_.transpose() * x).eval();
    const MatrixXf squares = sums(x.cwiseAbs2());
    x.array().colwise() *= residual_.array();
    keep_identifiable(before, squares, sums(x), found);
    if (found.directions.empty()) {
      found.absorbed = true;
      return found;
    }
    studentise(found);
    return found;
  }

  static void append(const CauseScores& more, CauseScores& to) {
    if (more.absorbed) return;
    if (to.absorbed) {
      to = more;
      return;
    }
    to.directions.insert(to.directions.end(), more.directions.begin(), more.directions.end());
    const Index before = to.scores.cols();
    to.scores.conservativeResize(Eigen::NoChange, before + more.scores.cols());
    to.scores.rightCols(more.scores.cols()) = more.scores;
    to.maxima = to.maxima.cwiseMax(more.maxima);
  }

  // Experiments that are groups of their own may still have to change sign together; groups of
  // several never split what does.
  std::vector<std::size_t> units_of_groups() const {
    if (in_.units.size() <= most_groups) return {in_.units.begin(), in_.units.end()};
    std::vector<std::size_t> own(static_cast<std::size_t>(group_count_));
    std::iota(own.begin(), own.end(), 0);
    return own;
  }

  MatrixXf columns(std::size_t cause, Index begin, Index end,
                   std::vector<Direction>& directions) const {
    const auto& shapes = in_.shapes[cause];
    MatrixXf x(in_.residual.size(), (end - begin) * static_cast<Index>(sites.size()));
    Index next = 0;
    for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end); ++s)
      for (std::size_t p = 0; p < sites.size(); ++p) {
        const bool several = shapes[s].effect.inputs.size() > 1;
        if (sensitivity_[p].size() == 0 || (several && p != on_mu && p != on_both)) continue;
        x.col(next++) = shapes[s].direction.cwiseProduct(sensitivity_[p]);
        directions.push_back({cause, s, p});
      }
    x.conservativeResize(Eigen::NoChange, next);
    return x;
  }

  // Per experiment.
  MatrixXf sums(const MatrixXf& x) const {
    MatrixXf s(static_cast<Index>(in_.first.size() - 1), x.cols());
    for (Index e = 0; e < s.rows(); ++e) {
      const auto begin = static_cast<Index>(in_.first[static_cast<std::size_t>(e)]);
      const auto end = static_cast<Index>(in_.first[static_cast<std::size_t>(e) + 1]);
      s.row(e) = x.middleRows(begin, end - begin).colwise().sum();
    }
    return s;
  }

  // Of experiments, into `to`: per group.
  template <class Column, class To> void sum_groups(const Column& from, To to) const {
    to.setZero();
    for (Index e = 0; e < from.size(); ++e)
      to(static_cast<Index>(group_[static_cast<std::size_t>(e)])) += from(e);
  }

  // Scores are divided by the direction's size (statistics in units of their standard deviation
  // under the noise model) and kept where enough is left of the direction.
  void keep_identifiable(const VectorXf& before, const MatrixXf& squares, const MatrixXf& scores,
                         CauseScores& found) const {
    std::vector<Direction> kept;
    const VectorXf size = squares.colwise().sum().cwiseSqrt();
    found.scores.resize(group_count_, scores.cols());
    found.shares.resize(group_count_, scores.cols());
    for (Index c = 0; c < scores.cols(); ++c) {
      if (!(size(c) * size(c) > least_left * before(c) * before(c)) || scores.col(c).isZero(0))
        continue;
      // A direction carried by few experiments could never be significant, and its flips would be
      // among the largest in every draw: the threshold would rise for all others.
      const float carries = share_of_most * squares.col(c).maxCoeff();
      // With fewer experiments nothing can be significant; leads are still listed.
      const Index least = std::min(least_experiments, squares.rows());
      if ((squares.col(c).array() > carries).count() < least) continue;
      Direction direction = found.directions[static_cast<std::size_t>(c)];
      direction.size = size(c);
      const auto next = static_cast<Index>(kept.size());
      sum_groups(scores.col(c) / size(c), found.scores.col(next));
      sum_groups(squares.col(c) / (size(c) * size(c)), found.shares.col(next));
      kept.push_back(direction);
    }
    found.scores.conservativeResize(Eigen::NoChange, static_cast<Index>(kept.size()));
    found.shares.conservativeResize(Eigen::NoChange, static_cast<Index>(kept.size()));
    found.directions = std::move(kept);
  }

  void studentise(CauseScores& found) const;

  const ScreenInput& in_;
  MatrixXf q_, signs_;
  std::vector<std::size_t> group_; // per experiment
  Index group_count_ = 0;
  VectorXf residual_;
  std::array<VectorXf, sites.size()> sensitivity_;
};

// The statistic t of screen.h for every direction of a cause, and its largest absolute value in
// every flip. Scores are scaled to sizes I of sum 1, so that the amplitude b is the sum of scores,
// and sum (U - b I)^2 = sum U^2 - 2 b sum U I + b^2 sum I^2 takes matrix products only.
void Screening::studentise(CauseScores& found) const {
  const MatrixXf shared = found.scores.cwiseProduct(found.shares);
  const MatrixXf sums = signs_ * found.scores, shared_sums = signs_ * shared;
  const auto count = static_cast<float>(found.scores.rows());
  const float wider = count / std::max(count - 1, 1.0f);
  found.maxima = VectorXf::Zero(signs_.rows());
  for (Index c = 0; c < sums.cols(); ++c) {
    const float total = found.scores.col(c).squaredNorm(),
                shares = found.shares.col(c).squaredNorm();
    // Sum over experiments of (score - sum * share)^2.
    const auto variance = [&](const auto& sum, const auto& with_shares) {
      return total - 2 * sum * with_shares + sum * sum * shares;
    };
    const float floor = in_.least_deviation * in_.least_deviation;
    const float least = std::max(least_variance_share * total, floor / wider);
    const float sum = found.scores.col(c).sum();
    found.directions[static_cast<std::size_t>(c)].statistic =
        sum / std::sqrt(wider * std::max(variance(sum, shared.col(c).sum()), least));
    const auto flipped = sums.col(c).array();
    found.maxima = found.maxima.cwiseMax(
        (flipped.square() / (wider * variance(flipped, shared_sums.col(c).array()).max(least)))
            .matrix());
  }
  found.maxima = found.maxima.cwiseSqrt();
}

std::size_t best_of(const std::vector<Direction>& directions) {
  std::size_t best = 0;
  for (std::size_t d = 1; d < directions.size(); ++d)
    if (std::abs(directions[d].statistic) > std::abs(directions[best].statistic)) best = d;
  return best;
}

} // namespace

double ScreenResult::threshold(double alpha) const {
  if (flipped_maxima.empty()) return std::numeric_limits<double>::infinity(); // nothing was tried
  const double at = (1 - alpha) * static_cast<double>(flipped_maxima.size() + 1);
  const auto index = static_cast<std::size_t>(std::ceil(at)) - 1;
  return flipped_maxima[std::min(index, flipped_maxima.size() - 1)];
}

ScreenResult screen(const ScreenInput& input) {
  const Screening screening(input);
  std::vector<CauseScores> parts(input.shapes.size());
  const Progress progress("screening causes", parts.size());
  parallel_for(parts.size(), [&](std::size_t s) {
    parts[s] = screening.run(s);
    progress.tick();
    if (!input.keep_scores) parts[s].scores.resize(0, 0);
  });
  ScreenResult result;
  VectorXf maxima = VectorXf::Zero(static_cast<Index>(input.flips));
  Index columns = 0;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    if (parts[s].absorbed) {
      result.absorbed.push_back(s);
      continue;
    }
    maxima = maxima.cwiseMax(parts[s].maxima);
    columns += parts[s].scores.cols();
    result.directions.insert(result.directions.end(), parts[s].directions.begin(),
                             parts[s].directions.end());
  }
  if (input.keep_scores) {
    result.scores.resize(screening.groups(), columns);
    Index next = 0;
    for (const CauseScores& part : parts) {
      if (part.absorbed) continue;
      result.scores.middleCols(next, part.scores.cols()) = part.scores;
      next += part.scores.cols();
    }
  }
  result.best = best_of(result.directions);
  if (input.flips == 0) return result;
  result.flipped_maxima.assign(maxima.data(), maxima.data() + maxima.size());
  std::sort(result.flipped_maxima.begin(), result.flipped_maxima.end());
  const float most =
      result.directions.empty() ? 0 : std::abs(result.directions[result.best].statistic);
  const auto beyond =
      result.flipped_maxima.end() -
      std::lower_bound(result.flipped_maxima.begin(), result.flipped_maxima.end(), most);
  // No p-value is below 2^(1-n) for n units: of all 2^n patterns of signs the true one and its
  // mirror image give the same statistic.
  const double least = std::pow(2.0, 1.0 - static_cast<double>(count_of(input.units)));
  result.p_value =
      std::max(least, static_cast<double>(beyond + 1) / static_cast<double>(input.flips + 1));
  return result;
}

} // namespace frictab::trace
