// Planting into sign-flipped residuals.
#include "trace/detectable.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "trace/projection.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Eigen::VectorXf;

constexpr std::size_t plants = 400;
constexpr double detection_probability = 0.8;
constexpr double least_column_left = 0.02; // of a column's variance, beside what the law explains
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
  return threshold * scatter -
         noise[static_cast<std::size_t>((1 - detection_probability) * plants)];
}

// Columns that are constant within tests: from the difference between two halves of the tests that
// would have been seen, by how much of the column the law's own parameters leave.
void add_between(Trace& trace, const Search& search) {
  Eigen::MatrixXd known = Eigen::MatrixXd::Ones(search.gains.gain.size(), 1);
  append_columns(known, search.known_between());
  const Eigen::MatrixXd q = orthonormal(known);
  for (const TestShape& shape : search.test_shapes) {
    if (shape.form != "line" && shape.form != "levels") continue;
    if (!constant_in_experiments(shape.cause, search.candidates)) continue;
    const VectorXd x = shape.columns.col(0).array() - shape.columns.col(0).mean();
    const double left = (x - q * (q.transpose() * x)).squaredNorm() / x.squaredNorm();
    Detectable entry{search.candidates.columns[shape.cause.columns[0]].name,
                     "",
                     effects::ActsOn::mu,
                     0,
                     0,
                     false};
    if (left > least_column_left && std::isfinite(trace.smallest_seen)) {
      entry.identifiable = true;
      entry.share = 0.5 * std::log1p(trace.smallest_seen) / std::sqrt(left);
      entry.size_MPa = entry.share * search.tau_scale_MPa;
    }
    trace.detectable.push_back(entry);
  }
}

} // namespace

void add_detectable(Trace& trace, const Search& search, std::uint64_t seed) {
  const ScreenResult& screened = search.last_screen;
  const double threshold = screened.threshold(search.input.options.alpha);
  for (std::size_t s = 0; s < search.causes.size(); ++s) {
    if (search.causes[s].is_joint() || search.shapes[s].empty()) continue;
    const CandidateColumn& column = search.candidates.columns[search.causes[s].columns[0]];
    Detectable entry{column.name, column.derived ? column.name : "", effects::ActsOn::mu, 0, 0,
                     false};
    for (std::size_t d = 0; d < screened.directions.size(); ++d) {
      const Direction& direction = screened.directions[d];
      if (direction.cause != s || direction.site != 0) continue;
      const GridShape& shape = search.shapes[s][direction.shape];
      if (effects::fitted_parameters(shape.effect).size() > 1 && !shape.effect.form->categorical)
        continue;
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
  add_between(trace, search);
}

} // namespace frictab::trace
