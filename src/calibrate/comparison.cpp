// Paired comparison of laws: studentised differences in shared resamples of experiments.
#include "calibrate/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "calibrate/choice.h"
#include "calibrate/experiment_errors.h"
#include "core/parallel.h"
#include "core/text.h"

namespace frictab::calibrate {

namespace {

constexpr std::size_t most_resamples = 10'000;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12; // of the sum of two errors

// One measure of error of all laws in one resample.
struct Estimates {
  std::vector<double> value;     // per law
  std::vector<double> influence; // law-major, one entry per experiment
};

struct Problem {
  std::vector<std::vector<double>> x; // per law, one entry per experiment
  std::vector<double> rows;
  Measure measure;

  std::size_t laws() const { return x.size(); }
  std::size_t experiments() const { return rows.size(); }

  Estimates at(std::span<const double> times) const {
    Estimates all{std::vector<double>(laws()), std::vector<double>(laws() * experiments())};
    for (std::size_t l = 0; l < laws(); ++l)
      all.value[l] = ratio_of(x[l], rows, times, measure,
                              {all.influence.data() + l * experiments(), experiments()});
    return all;
  }

  // Standard error of the difference between laws i and j.
  double error_of(const Estimates& all, std::size_t i, std::size_t j,
                  std::span<const double> times) const {
    std::vector<double> difference(experiments());
    for (std::size_t e = 0; e < experiments(); ++e)
      difference[e] = all.influence[j * experiments() + e] - all.influence[i * experiments() + e];
    return standard_error(difference, times);
  }
};

Problem problem_of(std::span<const LawErrors> laws, Measure measure) {
  Problem problem{{}, {}, measure};
  for (const ErrorSums& one : laws.front().sums)
    problem.rows.push_back(one.rows);
  for (const LawErrors& law : laws) {
    problem.x.emplace_back();
    for (const ErrorSums& one : law.sums)
      problem.x.back().push_back(measure == Measure::mean ? one.absolute : one.square);
  }
  return problem;
}

// A difference in standard errors; `scale` is the sum of the two errors. A difference without
// scatter is infinitely clear; one of not more than `least` of the scale is none.
double studentised(double difference, double error, double scale, double least) {
  if (std::abs(difference) <= least * scale) return 0;
  return error > rounding * scale ? difference / error : std::copysign(infinite, difference);
}

std::size_t pair_index(std::size_t i, std::size_t j, std::size_t laws) { // i < j
  return i * laws - i * (i + 1) / 2 + (j - i - 1);
}

// What the data say, and t of every pair (law j minus law i) in every resample, centred.
struct Studentised {
  std::vector<double> difference, error, t; // per pair
  std::vector<std::vector<double>> again;   // per pair, one entry per resample
};

void fill_pairs(const Problem& p, const Estimates& now, const Estimates& all,
                std::span<const double> times, Studentised& s, std::size_t b) {
  for (std::size_t i = 0, pair = 0; i < p.laws(); ++i)
    for (std::size_t j = i + 1; j < p.laws(); ++j, ++pair)
      s.again[pair][b] =
          studentised(all.value[j] - all.value[i] - s.difference[pair],
                      p.error_of(all, i, j, times), now.value[i] + now.value[j], rounding);
}

Studentised studentise(const Problem& p, std::size_t resamples, std::uint64_t seed) {
  const std::vector<double> once(p.experiments(), 1.0);
  const Estimates now = p.at(once);
  Studentised s;
  for (std::size_t i = 0; i < p.laws(); ++i)
    for (std::size_t j = i + 1; j < p.laws(); ++j) {
      s.difference.push_back(now.value[j] - now.value[i]);
      s.error.push_back(p.error_of(now, i, j, once));
      s.t.push_back(studentised(s.difference.back(), s.error.back(), now.value[i] + now.value[j],
                                same_error / 2));
    }
  s.again.assign(s.t.size(), std::vector<double>(resamples));
  parallel_for(resamples, [&](std::size_t b) {
    std::vector<double> times(p.experiments());
    resample(seed, b, times);
    fill_pairs(p, now, p.at(times), times, s, b);
  });
  return s;
}

double share_beyond(std::size_t beyond, std::size_t resamples) {
  return (static_cast<double>(beyond) + 1) / (static_cast<double>(resamples) + 1);
}

// The value that fewer than 5 % of all values, and the one tested, exceed: an interval made with it
// leaves 0 out exactly where p < 0.05.
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
  const auto beyond = std::count_if(size.begin(), size.end(), [&](double t) { return t >= now; });
  Difference d;
  d.value_MPa = s.difference[pair];
  d.p_value = share_beyond(static_cast<std::size_t>(beyond), size.size());
  double half = s.error[pair] == 0 ? 0 : critical_value(std::move(size)) * s.error[pair];
  if (s.t[pair] == 0) half = std::max(half, std::abs(d.value_MPa)); // the same
  d.interval = {d.value_MPa - half, d.value_MPa + half};
  return d;
}

// "No law is better than law i", by the largest studentised lead of another law over it, against
// the largest difference to another law either way: as in the interval of a pair. So it is never
// more certain than that pair alone.
double best_p_value(const Studentised& s, std::size_t i, std::size_t laws) {
  const std::size_t resamples = s.again.empty() ? 0 : s.again.front().size();
  double lead = 0;
  std::vector<double> most(resamples);
  for (std::size_t j = 0; j < laws; ++j) {
    if (j == i) continue;
    const std::size_t pair = pair_index(std::min(i, j), std::max(i, j), laws);
    if (s.t[pair] == 0) continue;                          // the same
    lead = std::max(lead, i < j ? -s.t[pair] : s.t[pair]); // t: later law minus earlier one
    for (std::size_t b = 0; b < resamples; ++b)
      most[b] = std::max(most[b], std::abs(s.again[pair][b]));
  }
  const auto beyond = std::count_if(most.begin(), most.end(), [&](double t) { return t >= lead; });
  return share_beyond(static_cast<std::size_t>(beyond), resamples);
}

std::string all_but(const Comparisons& c, const std::vector<std::string>& others,
                    const std::string& note) {
  if (others.size() + 1 == c.laws.size() && !others.empty())
    return fmt::format("{} is not distinguishable from any other law ({})", c.laws.front(), note);
  return fmt::format("{} is better than all {} ({})", c.laws.front(),
                     others.empty() ? "others" : "but " + join(others, ", "), note);
}

} // namespace

Comparisons compare(std::span<const LawErrors> laws, std::size_t resamples, std::uint64_t seed) {
  Comparisons result;
  if (laws.empty() || laws.front().sums.size() < 2 || resamples == 0) return result;
  result.n_experiments = laws.front().sums.size();
  result.resamples = std::min(resamples, most_resamples);
  const auto mae = studentise(problem_of(laws, Measure::mean), result.resamples, seed);
  const auto rmse = studentise(problem_of(laws, Measure::root_mean), result.resamples, seed);
  for (std::size_t i = 0, pair = 0; i < laws.size(); ++i) {
    result.laws.push_back(laws[i].law);
    result.best_p_values.push_back(best_p_value(mae, i, laws.size()));
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
  std::vector<std::string> names;
  for (const Comparison& pair : comparisons.pairs)
    if (pair.law == comparisons.laws.front() && !pair.mae.distinguishable())
      names.push_back(pair.other);
  return names;
}

std::string pairwise_sentence(const Comparisons& comparisons) {
  if (comparisons.laws.size() < 2) return "";
  return all_but(comparisons, as_good_as_first(comparisons), "95 % per pair, paired by experiment");
}

std::string family_sentence(const Comparisons& comparisons) {
  if (comparisons.laws.size() < 2) return "";
  const std::vector<std::string> names = possibly_best(comparisons);
  const std::string note = fmt::format("95 % for all {} laws together", comparisons.laws.size());
  if (names.size() == 1) return fmt::format("{} is the best of them ({})", names.front(), note);
  if (names.size() == comparisons.laws.size()) return "any of them may be the best (" + note + ")";
  return fmt::format("the best of them is one of {} ({})", join(names, ", "), note);
}

void add_comparisons(Calibration& calibration, const CalibrationInput& input) {
  std::vector<LawErrors> laws(calibration.fits.size());
  parallel_for(laws.size(), [&](std::size_t i) {
    const ModelFit& fit = calibration.fits[i];
    laws[i] = {fit.model.law->name, unseen_sums(fit, input.validation)};
  });
  calibration.comparisons = compare(laws, input.options.bootstrap, input.options.seed);
  const Choice before = std::move(calibration.choice);
  calibration.choice = choose_again(laws, input.options.bootstrap, input.options.seed);
  if (!before.splits) return;
  calibration.choice.best_in = before.best_in; // traced laws are not fitted to other splits
  calibration.choice.splits = true;
}

} // namespace frictab::calibrate
