// One-standard-error rule, and its sentence.
#include "calibrate/recommended.h"

#include <algorithm>

#include <fmt/format.h>

#include "calibrate/choice.h"
#include "calibrate/experiment_errors.h"
#include "core/parallel.h"
#include "core/text.h"

namespace frictab::calibrate {

namespace {

struct Simplest {
  std::size_t law = 0;
  double behind_MPa = 0, std_error_MPa = 0;
};

// Applies the rule on experiments that count `times` each, of which `best` is the best.
Simplest simplest_near(const PairedErrors& errors, std::span<const double> times, std::size_t best,
                       std::span<const std::size_t> numbers) {
  const PairedErrors::Estimates mae = errors.at(times);
  Simplest out{best};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i == best) continue;
    const double behind = mae.value[i] - mae.value[best];
    const bool closer = numbers[i] == numbers[out.law] && behind < out.behind_MPa;
    if (numbers[i] >= numbers[out.law] && !closer) continue;
    const double error = errors.error_of_difference(mae, best, i, times);
    if (behind > std::max(error, same_error * mae.value[best])) continue;
    out = {i, behind, error};
  }
  return out;
}

// Names the laws that are not worse than one of them by two standard errors or more.
std::vector<std::string> as_good_as(std::size_t law, const PairedErrors& errors,
                                    std::span<const LawErrors> laws) {
  constexpr double std_errors = 2;
  const std::vector<double> once(errors.experiments(), 1.0);
  const PairedErrors::Estimates mae = errors.at(once);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < laws.size(); ++i)
    if (i != law && mae.value[i] - mae.value[law] <=
                        std::max(std_errors * errors.error_of_difference(mae, law, i, once),
                                 same_error * mae.value[law]))
      names.push_back(laws[i].law);
  return names;
}

std::string numbers_text(std::size_t numbers) {
  return thousands(numbers) + (numbers == 1 ? " number" : " numbers");
}

} // namespace

std::size_t numbers_of(const ModelFit& fit, std::span<const ModelFit> fits) {
  if (fit.network) return fit.network->weights * fit.network->members;
  if (fit.polynomial) return fit.polynomial->terms.size();
  const models::Law& law = *fit.model.law;
  if (law.calibrated == models::Calibrated::fixed) return 0;
  std::size_t numbers = law.parameters.size();
  for (const ModelFit& base : fits)
    if (fit.model.traced() && base.model.law->name == law.base && (base.network || base.polynomial))
      numbers += numbers_of(base, {});
  return numbers;
}

Recommended recommend(std::span<const LawErrors> laws, std::span<const std::size_t> numbers,
                      std::size_t resamples, std::uint64_t seed) {
  if (laws.empty()) return {};
  const std::size_t experiments = laws.front().sums.size();
  const PairedErrors errors(laws, stats::Measure::mean);
  const std::vector<double> once(experiments, 1.0);
  const std::size_t best = experiments < 2 ? 0 : best_of(laws, once);
  const Simplest simplest =
      experiments < 2 ? Simplest{} : simplest_near(errors, once, best, numbers);
  Recommended out;
  out.law = laws[simplest.law].law;
  out.best = laws[best].law;
  out.numbers = numbers[simplest.law];
  out.numbers_of_best = numbers[best];
  out.behind_MPa = simplest.behind_MPa;
  out.std_error_MPa = simplest.std_error_MPa;
  out.expected.mae_MPa = errors.at(once).value[simplest.law];
  if (experiments < 2) return out;
  out.as_good = as_good_as(simplest.law, errors, laws);
  if (resamples == 0) return out;
  const auto rule = [&](std::span<const double> times) {
    return simplest_near(errors, times, best_of(laws, times), numbers).law;
  };
  out.expected = repeat_choice(laws, rule, resamples, seed).expected;
  return out;
}

void add_recommended(Calibration& calibration, const CalibrationInput& input,
                     const std::vector<std::string>& overruled) {
  calibration.recommended = {};
  if (calibration.judged_by == JudgedBy::fit) return;
  std::vector<const ModelFit*> fits;
  std::vector<std::size_t> numbers;
  for (const ModelFit& fit : calibration.fits) {
    const auto is_out = std::ranges::find(overruled, fit.model.law->name);
    if (fit.reference || is_out != overruled.end()) continue;
    fits.push_back(&fit);
    numbers.push_back(numbers_of(fit, calibration.fits));
  }
  const std::size_t tests = calibration.all_experiments.size();
  const bool over_all =
      input.undivided && tests > 0 &&
      std::ranges::all_of(fits, [&](const auto* fit) { return fit->over_all.size() == tests; });
  std::vector<LawErrors> laws(fits.size());
  parallel_for(laws.size(), [&](std::size_t i) {
    laws[i] = {fits[i]->model.law->name,
               stats::by_recording(over_all ? sums_of(fits[i]->over_all, *input.undivided)
                                            : unseen_sums(*fits[i], input.validation))};
  });
  calibration.recommended = recommend(laws, numbers, input.options.bootstrap, input.options.seed);
  if (over_all) calibration.recommended.tests = tests;
}

std::size_t best_place(const Calibration& calibration) {
  for (std::size_t i = 0; i < calibration.fits.size(); ++i)
    if (!calibration.fits[i].reference) return i;
  return 0;
}

const ModelFit& best_fit(const Calibration& calibration) {
  return calibration.fits[best_place(calibration)];
}

const ModelFit& recommended_fit(const Calibration& calibration) {
  const ModelFit* const fit = find_fit(calibration, calibration.recommended.law);
  return fit ? *fit : best_fit(calibration);
}

Expected expected_error(const Calibration& calibration) {
  const ModelFit& fit = recommended_fit(calibration);
  const Recommended& r = calibration.recommended;
  const Metrics& judged = fit.on_all ? fit.on_all->validation : fit.validation;
  if (!fit.on_all && r.expected.mae_MPa > 0) return r.expected;
  return {judged.mae_MPa, judged.mae_interval};
}

std::string expectation_sentence(const Calibration& calibration, int decimals) {
  const ModelFit& fit = recommended_fit(calibration);
  const auto text = [&](double MPa) { return fmt::format("{:.{}f} MPa", MPa, decimals); };
  const double own = fit.validation.mae_MPa, new_tests = expected_error(calibration).mae_MPa;
  const std::string expected = text(new_tests);
  if (calibration.recommended.law.empty() || expected == text(own)) return "";
  const std::string law = fit.model.law->name;
  if (fit.on_all)
    return fmt::format("on new tests {} is expected to err by {}, cross-validated over all tests",
                       law, expected);
  if (const std::size_t tests = calibration.recommended.tests; tests > 0)
    return fmt::format(
        "on new tests {} is expected to err by {}, by all {} tests left out in turn; "
        "the {} above are of the {} held out, which are few",
        law, expected, tests, text(own), fit.validation.n_experiments);
  return fmt::format("on new tests {} is expected to err by {}: {}", law, expected,
                     new_tests > own
                         ? text(own) + " is optimistic, because the same tests chose the law"
                         : "the choice was repeated on resampled tests");
}

std::string recommended_sentence(const Calibration& calibration, int decimals) {
  const Recommended& r = calibration.recommended;
  if (r.law.empty()) return "";
  if (r.law == r.best)
    return fmt::format(
        "recommended: {}, which is the best{}; no simpler law is within one standard "
        "error of it",
        r.law, r.tests > 0 ? fmt::format(" over all {} tests", r.tests) : "");
  return fmt::format("recommended: {}, the simplest law that is not worse than {} by more than one "
                     "standard error ({:+.{}f} +- {:.{}f} MPa{}; {} against {})",
                     r.law, r.best, r.behind_MPa, decimals, r.std_error_MPa, decimals,
                     r.tests > 0 ? fmt::format(" over all {} tests", r.tests) : "",
                     numbers_text(r.numbers), thousands(r.numbers_of_best));
}

} // namespace frictab::calibrate
