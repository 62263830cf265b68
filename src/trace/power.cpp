// Planting into sign-flipped residuals.
#include "trace/power.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace frictab {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Eigen::VectorXf;

constexpr std::size_t plants = 400;
constexpr double wanted = 0.8;
constexpr std::uint64_t power_stream = 73;

// Sum of scores that lifts the statistic above the threshold in 80 % of residuals that are as
// likely as these; where the experiments scatter more than the noise model says, it takes more.
double sum_to_detect(const VectorXf& scores, double threshold, std::uint64_t seed) {
  std::vector<double> noise(plants);
  for (std::size_t b = 0; b < plants; ++b) {
    Random random(seed, power_stream + 1000 * b);
    double sum = 0;
    for (Index e = 0; e < scores.size(); ++e)
      sum += random.uniform() < 0.5 ? -scores(e) : scores(e);
    noise[b] = sum;
  }
  std::sort(noise.begin(), noise.end());
  const double scatter = std::sqrt(std::max(1.0f, scores.squaredNorm()));
  return threshold * scatter - noise[static_cast<std::size_t>((1 - wanted) * plants)];
}

} // namespace

void add_power(Trace& trace, const Search& search, std::uint64_t seed) {
  const ScreenResult& screened = search.last_screen;
  const double threshold = screened.threshold(trace.alpha);
  for (std::size_t s = 0; s < search.causes.size(); ++s) {
    if (search.causes[s].pair() || search.shapes[s].empty()) continue;
    const CandidateColumn& column = search.candidates.columns[search.causes[s].column];
    Detectable entry{column.name, column.derived ? column.name : "", "mu", 0, 0, false};
    for (std::size_t d = 0; d < screened.directions.size(); ++d) {
      const Direction& direction = screened.directions[d];
      if (direction.cause != s || direction.place != 0) continue;
      const GridShape& shape = search.shapes[s][direction.shape];
      if (fitted_parameters(shape.effect).size() > 1 && !shape.effect.form->categorical) continue;
      const double sum = sum_to_detect(screened.scores.col(static_cast<Index>(d)), threshold, seed);
      VectorXd change = shape.direction.cast<double>();
      change.array() -= change.mean();
      change = change.cwiseProduct(search.sensitivities()[0]);
      const double size =
          sum / direction.size * change.norm() / std::sqrt(static_cast<double>(change.size()));
      if (entry.identifiable && size >= entry.size_MPa) continue;
      entry.identifiable = true;
      entry.size_MPa = size;
      entry.share = size / search.tau_scale_MPa;
    }
    trace.detectable.push_back(entry);
  }
}

} // namespace frictab
