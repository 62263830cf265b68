// Paired comparison of laws: studentised differences in shared resamples of experiments.
#include "calibrate/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "calibrate/choice.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/noise_floor.h"
#include "core/no_value.h"
#include "core/parallel.h"
#include "core/text.h"

namespace frictab::calibrate {

namespace {

constexpr std::size_t most_resamples = 10'000;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12; // of the sum of two errors
// Minimum ratio of a resample's standard error to that of the data: a resample with hardly any of
// the few experiments in which two laws differ would otherwise claim an arbitrarily precise
// difference.
constexpr double least_error_ratio = 0.1;

// A difference in standard errors; `scale` is the sum of the two errors. A difference without
// scatter is infinite; one of at most `least` of the scale is 0.
double studentised(double difference, double error, double scale, double least) {
  if (std::abs(difference) <= least * scale) return 0;
  return error > rounding * scale ? difference / error : std::copysign(infinite, difference);
}

std::size_t pair_index(std::size_t i, std::size_t j, std::size_t laws) { // i < j
  return i * laws - i * (i + 1) / 2 + (j - i - 1);
}

// Errors of the laws, and the centred t statistic of every pair (law j minus law i) in every
// resample.
struct Studentised {
  std::vector<double> value;                // per law
  std::vector<double> difference, error, t; // per pair
  std::vector<std::vector<double>> again;   // per pair, one entry per resample
};

void fill_pairs(const PairedErrors& p, const PairedErrors::Estimates& now,
                const PairedErrors::Estimates& all, std::span<const double> times, Studentised& s,
                std::size_t b) {
  for (std::size_t i = 0, pair = 0; i < p.laws(); ++i)
    for (std::size_t j = i + 1; j < p.laws(); ++j, ++pair)
      s.again[pair][b] = studentised(
          all.value[j] - all.value[i] - s.difference[pair],
          std::max(p.error_of_difference(all, i, j, times), least_error_ratio * s.error[pair]),
          now.value[i] + now.value[j], rounding);
}

Studentised studentise(const PairedErrors& p, std::size_t resamples, std::uint64_t seed) {
  const std::vector<double> once(p.experiments(), 1.0);
  const PairedErrors::Estimates now = p.at(once);
  Studentised s;
  s.value = now.value;
  for (std::size_t i = 0; i < p.laws(); ++i)
    for (std::size_t j = i + 1; j < p.laws(); ++j) {
      s.difference.push_back(now.value[j] - now.value[i]);
      s.error.push_back(p.error_of_difference(now, i, j, once));
      s.t.push_back(studentised(s.difference.back(), s.error.back(), now.value[i] + now.value[j],
                                same_error / 2));
    }
  s.again.assign(s.t.size(), std::vector<double>(resamples));
  parallel_for(resamples, [&](std::size_t b) {
    std::vector<double> times(p.experiments());
    stats::resample(seed, b, times);
    fill_pairs(p, now, p.at(times), times, s, b);
  });
  return s;
}

double share_beyond(std::size_t beyond, std::size_t resamples) {
  return (static_cast<double>(beyond) + 1) / (static_cast<double>(resamples) + 1);
}

// Critical value, exceeded by less than 5 % of all values with the tested one among them: an
// interval made with it excludes 0 exactly if p < 0.05.
double critical_value(std::vector<double> size) {
  const double rank = std::ceil(0.95 * (static_cast<double>(size.size()) + 1));
  if (rank > static_cast<double>(size.size())) return infinite;
  const auto at = size.begin() + static_cast<long>(rank) - 1;
  std::nth_element(size.begin(), at, size.end());
  return *at;
}

Difference difference_of(const Studentised& s, std::size_t pair) {
  std::vector<double> size;
  for (const double t : s.again[pair])
    size.push_back(std::abs(t));
  const double now = std::abs(s.t[pair]);
  const auto beyond = std::ranges::count_if(size, [&](double t) { return t >= now; });
  Difference d;
  d.value_MPa = s.difference[pair];
  d.p_value = share_beyond(static_cast<std::size_t>(beyond), size.size());
  double half = s.error[pair] == 0 ? 0 : critical_value(std::move(size)) * s.error[pair];
  if (s.t[pair] == 0) half = std::max(half, std::abs(d.value_MPa)); // equal laws
  d.interval = {d.value_MPa - half, d.value_MPa + half};
  return d;
}

// p-value of a pair, and those of its resamples: their ranks, with the data's own difference as one
// of them.
struct PairRanks {
  double p_value = 1;
  std::vector<double> again;
};

PairRanks ranks_of(const Studentised& s, std::size_t pair) {
  std::vector<double> size{std::abs(s.t[pair])};
  for (const double t : s.again[pair])
    size.push_back(std::abs(t));
  std::vector<double> sorted = size;
  std::ranges::sort(sorted);
  for (double& one : size) {
    const auto below = std::ranges::lower_bound(sorted, one) - sorted.begin();
    one = static_cast<double>(sorted.size() - static_cast<std::size_t>(below)) /
          static_cast<double>(sorted.size());
  }
  return {size.front(), {size.begin() + 1, size.end()}};
}

// p-value of "no candidate is better than law i"; at least the p-value of any pair that i loses.
double best_p_value(const Studentised& s, const std::vector<PairRanks>& ranks,
                    std::span<const LawErrors> laws, std::size_t i) {
  const std::size_t resamples = s.again.empty() ? 0 : s.again.front().size();
  double now = 1;
  std::vector<double> least(resamples, 1.0);
  for (std::size_t j = 0; j < laws.size(); ++j) {
    if (j == i || !laws[j].candidate) continue;
    const std::size_t pair = pair_index(std::min(i, j), std::max(i, j), laws.size());
    if (s.t[pair] == 0) continue; // equal laws
    if (s.value[j] < s.value[i]) now = std::min(now, ranks[pair].p_value);
    for (std::size_t b = 0; b < resamples; ++b)
      least[b] = std::min(least[b], ranks[pair].again[b]);
  }
  const auto beyond = std::ranges::count_if(least, [&](double p) { return p <= now; });
  return share_beyond(static_cast<std::size_t>(beyond), resamples);
}

// Whether a candidate beats law i in a pair of their own.
bool loses_for_certain(const Studentised& s, const std::vector<PairRanks>& ranks,
                       std::span<const LawErrors> laws, std::size_t i) {
  for (std::size_t j = 0; j < laws.size(); ++j)
    if (j != i && laws[j].candidate && s.value[j] < s.value[i] &&
        ranks[pair_index(std::min(i, j), std::max(i, j), laws.size())].p_value < 0.05)
      return true;
  return false;
}

// Values of all laws; NaN for those that are not candidates.
std::vector<double> best_p_values_of(const Studentised& s, std::span<const LawErrors> laws) {
  std::vector<PairRanks> ranks(s.t.size());
  parallel_for(ranks.size(), [&](std::size_t pair) { ranks[pair] = ranks_of(s, pair); });
  std::vector<double> p(laws.size(), no_value);
  std::vector<std::size_t> worst_first;
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (laws[i].candidate) worst_first.push_back(i);
  std::ranges::stable_sort(worst_first,
                           [&](std::size_t a, std::size_t b) { return s.value[a] > s.value[b]; });
  double at_least = 0;
  for (const std::size_t i : worst_first) {
    p[i] = std::max(at_least, best_p_value(s, ranks, laws, i));
    if (loses_for_certain(s, ranks, laws, i)) at_least = std::max(at_least, p[i]);
  }
  return p;
}

// Names of the candidates, by rank.
std::vector<std::string> candidates_of(const Comparisons& c) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < c.laws.size(); ++i)
    if (!std::isnan(c.best_p_values[i])) names.push_back(c.laws[i]);
  return names;
}

} // namespace

PairedErrors::PairedErrors(std::span<const LawErrors> laws, stats::Measure measure)
    : measure_(measure) {
  for (const stats::ErrorSums& one : laws.front().sums)
    rows_.push_back(one.rows);
  for (const LawErrors& law : laws) {
    x_.emplace_back();
    for (const stats::ErrorSums& one : law.sums)
      x_.back().push_back(measure == stats::Measure::mean ? one.absolute : one.square);
  }
}

PairedErrors::Estimates PairedErrors::at(std::span<const double> times) const {
  Estimates all{std::vector<double>(laws()), std::vector<double>(laws() * experiments())};
  for (std::size_t l = 0; l < laws(); ++l)
    all.value[l] =
        stats::ratio_of(x_[l], rows_, times, measure_,
                        std::span(all.influence).subspan(l * experiments(), experiments()));
  return all;
}

double PairedErrors::error_of_difference(const Estimates& all, std::size_t i, std::size_t j,
                                         std::span<const double> times) const {
  std::vector<double> difference(experiments());
  for (std::size_t e = 0; e < experiments(); ++e)
    difference[e] = all.influence[j * experiments() + e] - all.influence[i * experiments() + e];
  return stats::standard_error(difference, times);
}

Comparisons compare(std::span<const LawErrors> laws, std::size_t resamples, std::uint64_t seed) {
  Comparisons result;
  if (laws.empty() || laws.front().sums.size() < 2 || resamples == 0) return result;
  result.n_experiments = laws.front().sums.size();
  result.resamples = std::min(resamples, most_resamples);
  const auto mae = studentise({laws, stats::Measure::mean}, result.resamples, seed);
  const auto rmse = studentise({laws, stats::Measure::root_mean}, result.resamples, seed);
  result.best_p_values = best_p_values_of(mae, laws);
  for (std::size_t i = 0, pair = 0; i < laws.size(); ++i) {
    result.laws.push_back(laws[i].law);
    for (std::size_t j = i + 1; j < laws.size(); ++j, ++pair)
      result.pairs.push_back(
          {laws[i].law, laws[j].law, difference_of(mae, pair), difference_of(rmse, pair)});
  }
  return result;
}

std::vector<std::string> possibly_best(const Comparisons& comparisons) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < comparisons.laws.size(); ++i)
    if (comparisons.best_p_values[i] >= 0.05) names.push_back(comparisons.laws[i]);
  return names;
}

std::vector<std::string> as_good_as_first(const Comparisons& comparisons) {
  const std::vector<std::string> laws = candidates_of(comparisons);
  std::vector<std::string> names;
  for (const Comparison& pair : comparisons.pairs)
    if (pair.law == laws.front() && !pair.mae.distinguishable() &&
        std::ranges::find(laws, pair.other) != laws.end())
      names.push_back(pair.other);
  return names;
}

std::string pairwise_sentence(const Comparisons& comparisons) {
  const std::vector<std::string> laws = candidates_of(comparisons);
  if (laws.size() < 2) return "";
  const std::vector<std::string> tied = as_good_as_first(comparisons);
  const std::size_t others = laws.size() - 1;
  constexpr const char* note = "95 % per pair, paired by experiment";
  if (tied.size() == others)
    return fmt::format("{} is not distinguishable from any other law ({})", laws.front(), note);
  return fmt::format("{} is significantly better than {} of {} other law{} ({}){}", laws.front(),
                     others - tied.size(), others, others == 1 ? "" : "s", note,
                     tied.empty() ? "" : "; tied with: " + join(tied, ", "));
}

std::string family_sentence(const Comparisons& comparisons, bool named) {
  const std::size_t laws = candidates_of(comparisons).size();
  if (laws < 2) return "";
  const std::vector<std::string> possible = possibly_best(comparisons);
  return fmt::format("not ruled out as best (95 %, {} laws compared together): {} of {}{}", laws,
                     possible.size(), laws,
                     named || possible.size() == 1 ? " (" + join(possible, ", ") + ")" : "");
}

void add_comparisons(Calibration& calibration, const CalibrationInput& input) {
  std::vector<LawErrors> laws(calibration.fits.size());
  parallel_for(laws.size(), [&](std::size_t i) {
    const ModelFit& fit = calibration.fits[i];
    laws[i] = {fit.model.law->name, stats::by_recording(unseen_sums(fit, input.validation)),
               !fit.reference};
  });
  lower_noise_floors(calibration); // traced laws may have smaller errors
  calibration.comparisons = compare(laws, input.options.bootstrap, input.options.seed);
  const Choice before = std::move(calibration.choice);
  std::erase_if(laws, [](const LawErrors& law) { return !law.candidate; });
  calibration.choice = choose_again(laws, input.options.bootstrap, input.options.seed);
  if (!before.splits) return;
  calibration.choice.best_in = before.best_in; // traced laws are not fitted to other splits
  calibration.choice.splits = true;
}

} // namespace frictab::calibrate
