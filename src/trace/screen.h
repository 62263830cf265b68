// The test within tests: which of thousands of directions does the residual follow, more than any
// of them would by chance?
//
// A direction g is what tau_R would change, per block, with the amplitude of one shape at one site,
// whitened, with everything that is fitted already projected out. Experiment e gives the score
// U_e = g_e' r_e and the size I_e = g_e' g_e; b = sum U / sum I is the amplitude that fits. The
// statistic is the sum of scores over its standard deviation as the experiments themselves show it,
//   t = sum U / sqrt(n/(n-1) sum (U_e - b I_e)^2):
// what b explains of a score is no scatter, or a large effect would hide behind itself. If there is
// no effect, the signs of the experiments' residuals are arbitrary: all are flipped at random, some
// thousand times, and the largest |t| over all directions is kept each time. The p-value is the
// rank of the true largest |t| among those, so it holds for everything that was tried.
//
// Of more than 400 experiments, scores and sizes are summed over 400 groups of whole experiments,
// drawn at random, and a group's sign is flipped as one. If each experiment's sign is arbitrary, so
// are those of groups: the test stays as exact as it was, and the scatter of 400 sums says as much
// about a standard deviation as anybody needs (its own error is 1/sqrt(800), 3.5 %). What a flip
// costs no longer grows with the experiments.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "trace/noise.h"
#include "trace/shapes.h"

namespace frictab::trace {

// The sites of a law: the parts of it that an effect may change (PlacedEffect::acts_on), and whose
// index in this list stands for them below. mu and the limit together are a site only where a law
// has a limit of its own: what lubricates worse does so before and behind saturation.
inline constexpr std::array<effects::ActsOn, 4> sites = {
    effects::ActsOn::mu, effects::ActsOn::m, effects::ActsOn::tau, effects::ActsOn::mu_m};
inline constexpr std::size_t on_mu = 0, on_both = 3;

// What tau_R changes, per block, where an effect's factor changes by 1, at each site.
using Sensitivities =
    std::array<Eigen::VectorXd, sites.size()>; // of size 0 where the law has no such site

struct Direction {
  std::size_t cause = 0; // in the list of causes
  std::size_t shape = 0; // of that cause
  std::size_t site = 0;  // index in `sites`
  float statistic = 0;
  float size = 0; // norm, whitened and projected: statistic per amplitude
};

// Sign-flip max-T over effective scores, with the experiment as the unit (Hemerik, Goeman, Finos
// 2020; the leverage of fitted parameters is corrected as in CR2): no normality, no equal variances
// and no stationarity are assumed, and an effect that shows in G experiments can never get a
// p-value below 2^(1-G). Family-wise over everything that was tried.
struct ScreenResult {
  std::vector<Direction> directions; // identifiable ones
  std::vector<float> flipped_maxima; // ascending
  Eigen::MatrixXf scores; // experiments (or groups of them) x directions; only where asked for
  std::vector<std::size_t> absorbed; // causes that fitted parameters can imitate completely
  std::size_t best = 0;              // index of the largest statistic
  double p_value = 1;
  double threshold(double alpha) const;
};

struct ScreenInput {
  const std::vector<std::vector<GridShape>>& shapes; // per cause
  const Sensitivities& sensitivities;
  const Whitener& whitener;
  std::span<const std::size_t> first; // blocks of each experiment
  const Eigen::VectorXd& residual;    // per block, not whitened
  const Eigen::MatrixXd& fitted;      // directions of fitted parameters, not whitened
  // Per experiment, which of them change sign together (all 0, 1, 2, ...: each for itself).
  std::span<const std::size_t> units;
  std::size_t flips = 999; // 0: statistics alone
  std::uint64_t seed = 1;
  bool keep_scores = false;
  // The standard deviation of a sum of scores is taken for no smaller than this times what the
  // noise model says: 1 where the model was fitted with the leading direction in, 0 where not.
  float least_deviation = 0;
};

ScreenResult screen(const ScreenInput& input);

} // namespace frictab::trace
