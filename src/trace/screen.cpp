// Whitens, projects, scores and flips; single precision, a tile of directions at a time.
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
#include "trace/sign_flips.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;
using Eigen::VectorXf;

constexpr double least_left = 0.002;     // of a direction, behind what fitted parameters imitate
constexpr Index least_experiments = 7;   // that carry a direction, ...
constexpr float share_of_most = 0.05f;   // ... each at least so much of what the first of them does
constexpr std::size_t most_groups = 400; // whose signs are flipped
constexpr std::uint64_t group_stream = 72;

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

// Sums of a tile over the blocks of a test.
FRICTAB_WIDE void sum_test(const float* tile, const float* residual, Index count, float* squares,
                           float* scores) {
  Lanes square[lane_parts] = {}, score[lane_parts] = {}, x[lane_parts];
  for (Index b = 0; b < count; ++b) {
    load_lanes(tile + b * tile_width, x);
    for (Index p = 0; p < lane_parts; ++p) {
      square[p] += x[p] * x[p];
      score[p] += x[p] * residual[b];
    }
  }
  store_lanes(square, squares);
  store_lanes(score, scores);
}

// What the tiles of a screening are made of, and what comes of each.
class Screening {
public:
  explicit Screening(const ScreenInput& input)
      : in_(input), whitener_(input.whitener), group_(groups_of(input.units, input.seed)),
        group_count_(static_cast<Index>(count_of(group_))),
        flips_(input.flips, units_of_groups(), input.seed) {
    MatrixXd fitted = in_.fitted;
    in_.whitener.apply(fitted);
    const MatrixXd q = orthonormal(fitted);
    MatrixXd residual = in_.residual;
    in_.whitener.apply(residual);
    VectorXd r = residual.col(0) - q * (q.transpose() * residual.col(0));
    undo_leverage(q, in_.first, r);
    q_ = q.transpose().cast<float>();
    residual_ = r.cast<float>();
    for (std::size_t p = 0; p < sites.size(); ++p)
      sensitivity_[p] = in_.sensitivities[p].cast<float>();
    list_directions();
  }

  Index groups() const { return group_count_; }
  std::size_t tiles() const { return (all_.size() + width - 1) / width; }

  struct Scored {
    std::vector<Direction> directions; // identifiable ones
    TileScores of;                     // of these, in front
  };

  // Of a tile; `maxima` as SignFlips has them.
  Scored score(std::size_t tile, std::span<float> maxima) const {
    const auto directions =
        std::span(all_).subspan(tile * width, std::min(width, all_.size() - tile * width));
    Tile x = columns(directions);
    whitener_.apply(x);
    const TileValues before = x.rowwise().squaredNorm();
    take_off(q_, along(q_, x), x);
    Tile squares(tile_width, experiments()), scores(tile_width, experiments());
    for (Index e = 0; e < experiments(); ++e) {
      const auto begin = static_cast<Index>(in_.first[static_cast<std::size_t>(e)]);
      const auto end = static_cast<Index>(in_.first[static_cast<std::size_t>(e) + 1]);
      sum_test(x.col(begin).data(), residual_.data() + begin, end - begin, squares.col(e).data(),
               scores.col(e).data());
    }
    Scored found = identifiable(directions, before, squares, scores);
    if (found.directions.empty()) return found;
    const TileValues statistics = flips_.statistics(found.of, in_.least_deviation, maxima);
    for (std::size_t d = 0; d < found.directions.size(); ++d)
      found.directions[d].statistic = statistics(static_cast<Index>(d));
    return found;
  }

private:
  static constexpr auto width = static_cast<std::size_t>(tile_width);

  Index experiments() const { return static_cast<Index>(in_.first.size()) - 1; }

  // Experiments that are groups of their own may still have to change sign together; groups of
  // several never split what does.
  std::vector<std::size_t> units_of_groups() const {
    if (in_.units.size() <= most_groups) return {in_.units.begin(), in_.units.end()};
    std::vector<std::size_t> own(static_cast<std::size_t>(group_count_));
    std::iota(own.begin(), own.end(), 0);
    return own;
  }

  void list_directions() {
    for (std::size_t cause = 0; cause < in_.shapes.size(); ++cause)
      for (std::size_t s = 0; s < in_.shapes[cause].size(); ++s)
        for (std::size_t p = 0; p < sites.size(); ++p) {
          const bool several = in_.shapes[cause][s].effect.inputs.size() > 1;
          if (sensitivity_[p].size() > 0 && (!several || p == on_mu || p == on_both))
            all_.push_back({cause, s, p});
        }
  }

  // Shapes times sensitivities; a few blocks at a time, so that rows turn into columns in the first
  // cache, and enough of them that the shapes come from memory in one stream each.
  Tile columns(std::span<const Direction> directions) const {
    constexpr Index part = 64;
    Tile x = Tile::Zero(tile_width, in_.residual.size());
    for (Index first = 0; first < x.cols(); first += part) {
      const Index last = std::min(first + part, x.cols());
      for (std::size_t d = 0; d < directions.size(); ++d) {
        const float* shape = in_.shapes[directions[d].cause][directions[d].shape].direction.data();
        const float* sensitivity = sensitivity_[directions[d].site].data();
        for (Index b = first; b < last; ++b)
          x(static_cast<Index>(d), b) = shape[b] * sensitivity[b];
      }
    }
    return x;
  }

  // Scores are divided by the direction's size (statistics in units of their standard deviation
  // under the noise model) and kept where enough is left of the direction.
  Scored identifiable(std::span<const Direction> directions, const TileValues& before,
                      const Tile& squares, const Tile& scores) const {
    const TileValues squared = squares.rowwise().sum(), size = squared.sqrt();
    // A direction carried by few experiments could never be significant, and its flips would be
    // among the largest in every draw: the threshold would rise for all others.
    const TileValues carries = share_of_most * squares.rowwise().maxCoeff().array();
    TileValues carriers = TileValues::Zero();
    for (Index e = 0; e < experiments(); ++e)
      carriers += (squares.col(e).array() > carries).cast<float>();
    const TileValues strongest = scores.cwiseAbs().rowwise().maxCoeff();
    // With fewer experiments nothing can be significant; leads are still listed.
    const auto least = static_cast<float>(std::min(least_experiments, experiments()));
    Scored found;
    std::vector<Index> kept;
    for (std::size_t d = 0; d < directions.size(); ++d) {
      const auto l = static_cast<Index>(d);
      const bool left = squared(l) > static_cast<float>(least_left) * before(l);
      if (!left || strongest(l) == 0 || carriers(l) < least) continue;
      found.directions.push_back(directions[d]);
      found.directions.back().size = size(l);
      kept.push_back(l);
    }
    found.of = {Tile::Zero(tile_width, group_count_), Tile::Zero(tile_width, group_count_)};
    for (Index e = 0; e < experiments(); ++e) {
      const auto group = static_cast<Index>(group_[static_cast<std::size_t>(e)]);
      for (std::size_t d = 0; d < kept.size(); ++d) {
        const auto to = static_cast<Index>(d), from = kept[d];
        found.of.scores(to, group) += scores(from, e) / size(from);
        found.of.shares(to, group) += squares(from, e) / squared(from);
      }
    }
    return found;
  }

  const ScreenInput& in_;
  TileWhitener whitener_;
  MatrixXf q_; // what is fitted, orthonormal: a column per block
  VectorXf residual_;
  std::array<VectorXf, sites.size()> sensitivity_;
  std::vector<std::size_t> group_; // per experiment
  Index group_count_;
  SignFlips flips_;
  std::vector<Direction> all_;
};

std::size_t best_of(const std::vector<Direction>& directions) {
  std::size_t best = 0;
  for (std::size_t d = 1; d < directions.size(); ++d)
    if (std::abs(directions[d].statistic) > std::abs(directions[best].statistic)) best = d;
  return best;
}

// Causes of which no direction can be told from what is fitted.
std::vector<std::size_t> absorbed(std::size_t causes, const std::vector<Direction>& identifiable) {
  std::vector<bool> seen(causes, false);
  for (const Direction& d : identifiable)
    seen[d.cause] = true;
  std::vector<std::size_t> none;
  for (std::size_t c = 0; c < causes; ++c)
    if (!seen[c]) none.push_back(c);
  return none;
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
  std::vector<Screening::Scored> tiles(screening.tiles());
  MatrixXf maxima = MatrixXf::Zero(static_cast<Index>(input.flips),
                                   static_cast<Index>(tiles.size())); // a column per tile
  const Progress progress("screening causes", tiles.size());
  parallel_for(tiles.size(), [&](std::size_t t) {
    tiles[t] = screening.score(
        t, {maxima.col(static_cast<Index>(t)).data(), static_cast<std::size_t>(input.flips)});
    if (!input.keep_scores) tiles[t].of = {};
    progress.tick();
  });
  ScreenResult result;
  for (const Screening::Scored& tile : tiles)
    result.directions.insert(result.directions.end(), tile.directions.begin(),
                             tile.directions.end());
  result.absorbed = absorbed(input.shapes.size(), result.directions);
  if (input.keep_scores) {
    result.scores.resize(screening.groups(), static_cast<Index>(result.directions.size()));
    Index next = 0;
    for (const Screening::Scored& tile : tiles) {
      const auto count = static_cast<Index>(tile.directions.size());
      if (count > 0)
        result.scores.middleCols(next, count) = tile.of.scores.topRows(count).transpose();
      next += count;
    }
  }
  result.best = best_of(result.directions);
  if (input.flips == 0) return result;
  const VectorXf largest = maxima.rowwise().maxCoeff();
  result.flipped_maxima.assign(largest.begin(), largest.end());
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
