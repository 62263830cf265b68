// Noise floors: oracle, replicates, scatter within experiments.
#include "calibrate/noise_floor.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "calibrate/metrics.h"
#include "calibrate/replicates.h"
#include "core/text.h"

namespace frictab::calibrate {

namespace {

using Rows = std::span<const double>;

NoiseFloor floor_of(const std::string& method, const std::vector<stats::ErrorSums>& sums,
                    std::size_t resamples, std::uint64_t seed) {
  return {metrics(sums, resamples, seed), method};
}

constexpr std::size_t no_row = static_cast<std::size_t>(-1);

// Row of experiment `other` that corresponds to `row` of experiment `own`: at the same position if
// its sliding distance agrees, else at the nearest distance. `s` may be empty; then only the
// position counts.
class Partner {
public:
  Partner(const data::Dataset& data)
      : first_(data.first_row), s_(data.has("s_mm") ? data.values("s_mm") : Rows{}) {
    if (s_.empty()) return;
    const auto [low, high] = std::ranges::minmax_element(s_);
    tolerance_ = replicate_tolerance * (*high - *low);
  }
  std::size_t row_of(std::size_t own, std::size_t row, std::size_t other) const {
    const std::size_t begin = first_[other], end = first_[other + 1];
    const std::size_t same = begin + row - first_[own];
    if (s_.empty()) return same < end ? same : no_row;
    if (same < end && std::abs(s_[same] - s_[row]) <= 1e-6 * tolerance_) return same;
    // Sliding distance does not decrease along an experiment.
    const auto at = std::lower_bound(s_.begin() + begin, s_.begin() + end, s_[row]);
    std::size_t best = std::min(static_cast<std::size_t>(at - s_.begin()), end - 1);
    if (best > begin && std::abs(s_[best - 1] - s_[row]) < std::abs(s_[best] - s_[row])) --best;
    return std::abs(s_[best] - s_[row]) <= tolerance_ ? best : no_row;
  }

private:
  const std::vector<std::size_t>& first_;
  Rows s_;
  double tolerance_ = 0;
};

// Adds the differences of one experiment from the others of its group, scaled to the scatter of a
// single one.
void add_differences(stats::ErrorSums& sums, const std::vector<std::size_t>& group, std::size_t own,
                     const data::Dataset& data, const Partner& partner) {
  const Rows tau = data.values("tau_R_MPa");
  for (std::size_t i = data.first_row[own]; i < data.first_row[own + 1]; ++i) {
    double sum = 0, others = 0;
    for (const std::size_t other : group) {
      const std::size_t j = other == own ? no_row : partner.row_of(own, i, other);
      if (j == no_row) continue;
      sum += tau[j];
      ++others;
    }
    if (others == 0) continue;
    // A block's scatter of rows about its mean counts as that of the other experiments' too.
    stats::add_row(sums, data, i, (tau[i] - sum / others) * std::sqrt(others / (others + 1)));
  }
}

// Least-squares line through a window that slides along an experiment. Sums are updated, so the
// cost does not depend on the window's length.
struct Window {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  void take(double at, double value, double sign) {
    n += sign;
    x += sign * at;
    y += sign * value;
    xx += sign * at * at;
    xy += sign * at * value;
  }
  // Residual of one of its rows over sqrt(1 - leverage); its mean square is the variance of the
  // scatter.
  double scatter(double at, double value) const {
    const double mean = x / n, sxx = xx - x * mean, sxy = xy - x * y / n;
    const double slope = sxx > 0 ? sxy / sxx : 0;
    const double leverage = 1 / n + (sxx > 0 ? (at - mean) * (at - mean) / sxx : 0);
    return (value - y / n - slope * (at - mean)) / std::sqrt(1 - leverage);
  }
};

constexpr std::size_t least_window = 9;

} // namespace

// The row number replaces the sliding distance, along which rows are spaced evenly enough.
stats::ErrorSums scatter_within(Rows tau) {
  stats::ErrorSums sums;
  const std::size_t n = tau.size();
  if (n < least_window) return sums;
  const std::size_t width = std::max(least_window, n / 20), half = width / 2;
  const double middle = static_cast<double>(n) / 2;
  const auto at = [&](std::size_t i) { return static_cast<double>(i) - middle; };
  Window window;
  std::size_t begin = 0, end = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t want = std::min(i > half ? i - half : 0, n - width);
    for (; end < want + width; ++end)
      window.take(at(end), tau[end], 1);
    for (; begin < want; ++begin)
      window.take(at(begin), tau[begin], -1);
    stats::add_block(sums, window.scatter(at(i), tau[i]), 1, 0);
  }
  return sums;
}

std::optional<NoiseFloor> oracle_floor(const data::Dataset& data, std::size_t resamples,
                                       std::uint64_t seed) {
  if (data.oracle_MPa.empty()) return {};
  return floor_of("oracle",
                  stats::error_sums(data.values("tau_R_MPa"), data.oracle_MPa, data.first_row),
                  resamples, seed);
}

std::optional<NoiseFloor> replicate_floor(const data::Dataset& data, std::size_t resamples,
                                          std::uint64_t seed) {
  const auto groups = replicate_groups(data);
  const Partner partner(data);
  std::vector<stats::ErrorSums> sums; // one per group: its differences belong together
  std::size_t experiments = 0;
  for (const auto& group : groups) {
    stats::ErrorSums one;
    for (const std::size_t own : group)
      add_differences(one, group, own, data, partner);
    if (one.rows == 0) continue;
    sums.push_back(one);
    experiments += group.size();
  }
  if (sums.empty()) return {};
  NoiseFloor floor = floor_of("replicates", sums, resamples, seed);
  floor.n_groups = sums.size();
  floor.n_experiments = experiments;
  return floor;
}

std::vector<stats::ErrorSums> scatter_in_tests(const data::Dataset& data) {
  const Rows tau = data.values("tau_R_MPa");
  std::vector<stats::ErrorSums> sums;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    sums.push_back(scatter_within(data.of_test(tau, e)));
  return sums;
}

std::optional<NoiseFloor> within_floor(std::vector<stats::ErrorSums> sums, std::size_t resamples,
                                       std::uint64_t seed) {
  std::erase_if(sums, [](const stats::ErrorSums& one) { return one.rows == 0; });
  if (sums.empty()) return {};
  NoiseFloor floor = floor_of("within_experiments", sums, resamples, seed);
  floor.lower_bound = true;
  return floor;
}

void add_noise_floors(Calibration& calibration, const CalibrationInput& input,
                      const ScatterWithin& known) {
  std::vector<std::pair<const data::Dataset*, const char*>> parts = {
      {&input.validation, "validation"}, {&input.training, "training"}};
  if (!on_other_experiments(input.judged_by)) parts = {{&input.training, "all"}};
  const auto within = [&](const data::Dataset& data, std::size_t resamples, std::uint64_t seed) {
    const bool training = &data == &input.training;
    return within_floor(!data.condensed ? scatter_in_tests(data)
                        : training      ? known.training
                                        : known.validation,
                        resamples, seed);
  };
  using Method =
      std::function<std::optional<NoiseFloor>(const data::Dataset&, std::size_t, std::uint64_t)>;
  for (const Method& method : {Method(oracle_floor), Method(replicate_floor), Method(within)}) {
    std::vector<NoiseFloor> both;
    for (const auto& part_and_name : parts)
      if (auto floor = method(*part_and_name.first, input.options.bootstrap, input.options.seed)) {
        floor->part = part_and_name.second;
        both.push_back(*floor);
      }
    std::ranges::stable_sort(both, [](const NoiseFloor& a, const NoiseFloor& b) {
      return a.n_groups > b.n_groups; // 0 except for replicates
    });
    calibration.noise_floors.insert(calibration.noise_floors.end(), both.begin(), both.end());
  }
  lower_noise_floors(calibration);
}

void lower_noise_floors(Calibration& calibration) {
  if (calibration.judged_by == JudgedBy::fit) return; // no law was judged on an unseen test
  const auto lower = [](Interval& interval, double most) {
    interval = {std::min(interval.low, most), std::min(interval.high, most)};
  };
  for (const ModelFit& fit : calibration.fits)
    for (NoiseFloor& floor : calibration.noise_floors) {
      if (floor.method == "oracle" || !(fit.validation.mae_MPa < floor.mae_MPa)) continue;
      if (floor.measured_MPa == 0) floor.measured_MPa = floor.mae_MPa;
      floor.mae_MPa = fit.validation.mae_MPa;
      floor.rmse_MPa = std::min(floor.rmse_MPa, fit.validation.rmse_MPa);
      lower(floor.mae_interval, floor.mae_MPa);
      lower(floor.rmse_interval, floor.rmse_MPa);
    }
}

const char* noise_floor_sign(const NoiseFloor& floor) {
  if (floor.measured_MPa > 0) return "< ";
  return floor.lower_bound ? "> " : "";
}

std::string noise_floor_name(const NoiseFloor& floor) {
  if (floor.method == "oracle") return "the twin's own truth, synthetic data only";
  const std::string lowered =
      floor.measured_MPa > 0
          ? fmt::format(" ({:.3g} MPa, more than the best law errs)", floor.measured_MPa)
          : "";
  if (floor.method == "replicates")
    return fmt::format("{} repeated tests in {} group{}{}", floor.n_experiments, floor.n_groups,
                       floor.n_groups == 1 ? "" : "s", lowered);
  return "scatter within experiments only" + lowered;
}

std::string noise_floor_limits(const NoiseFloor& floor) {
  if (floor.measured_MPa > 0) return ""; // replicates overestimate it, rows underestimate it
  if (floor.lower_bound) return ", scatter between experiments not included";
  return floor.part == "training" ? ", of the training data" : "";
}

std::string noise_floor_sentence(const Calibration& calibration, int decimals) {
  if (calibration.noise_floors.empty())
    return "noise floor unknown: no repeated tests, and experiments too short to see their scatter";
  const NoiseFloor& floor = calibration.noise_floors.front();
  return fmt::format("noise floor {}{:.{}f} MPa: {}{}",
                     floor.measured_MPa > 0 ? "below "
                     : floor.lower_bound    ? "above "
                                            : "",
                     floor.mae_MPa, decimals, noise_floor_name(floor), noise_floor_limits(floor));
}

std::string noise_floor_advice(const Calibration& calibration) {
  const auto& floors = calibration.noise_floors;
  // The lower end of the interval was lowered too, so the difference exceeds chance.
  if (!floors.empty() && floors.front().measured_MPa > 0 && !floors.front().lower_bound &&
      floors.front().mae_interval.low == floors.front().mae_MPa)
    return "the repeated tests differ in something that no column records";
  const bool known = !floors.empty() && !floors.front().lower_bound;
  return known ? "" : "repeat any one test twice, unchanged";
}

} // namespace frictab::calibrate
