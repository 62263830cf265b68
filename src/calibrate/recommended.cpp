// One-standard-error rule, and its sentence.
#include "calibrate/recommended.h"

#include <algorithm>

#include <fmt/format.h>

#include "calibrate/experiment_errors.h"
#include "core/parallel.h"
#include "core/text.h"

namespace frictab::calibrate {

namespace {

// MAE of a law, and the influence of each experiment on it.
struct JudgedLaw {
  double mae_MPa = 0;
  std::vector<double> influence;
};

JudgedLaw judged_law(const LawErrors& law) {
  std::vector<double> absolute, rows;
  for (const stats::ErrorSums& one : law.sums) {
    absolute.push_back(one.absolute);
    rows.push_back(one.rows);
  }
  JudgedLaw out{0, std::vector<double>(rows.size())};
  const std::vector<double> once(rows.size(), 1.0);
  out.mae_MPa = stats::ratio_of(absolute, rows, once, stats::Measure::mean, out.influence);
  return out;
}

double paired_error(const JudgedLaw& a, const JudgedLaw& b) {
  std::vector<double> difference(a.influence.size());
  for (std::size_t e = 0; e < difference.size(); ++e)
    difference[e] = a.influence[e] - b.influence[e];
  return stats::standard_error(difference, std::vector<double>(difference.size(), 1.0));
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

Recommended recommend(std::span<const LawErrors> laws, std::span<const std::size_t> numbers) {
  Recommended out;
  if (laws.empty()) return out;
  const JudgedLaw best = judged_law(laws.front());
  out = {laws.front().law, laws.front().law, numbers.front(), numbers.front()};
  for (std::size_t i = 1; i < laws.size() && laws.front().sums.size() >= 2; ++i) {
    const JudgedLaw one = judged_law(laws[i]);
    const double behind = one.mae_MPa - best.mae_MPa, error = paired_error(one, best);
    if (behind > std::max(error, same_error * best.mae_MPa)) continue;
    const bool closer = numbers[i] == out.numbers && behind < out.behind_MPa;
    if (numbers[i] >= out.numbers && !closer) continue;
    out = {laws[i].law, out.best, numbers[i], out.numbers_of_best, behind, error};
  }
  return out;
}

void add_recommended(Calibration& calibration, const CalibrationInput& input,
                     const std::vector<std::string>& overruled) {
  calibration.recommended = {};
  if (calibration.judged_by == JudgedBy::fit) return;
  std::vector<const ModelFit*> fits;
  std::vector<std::size_t> numbers;
  for (const ModelFit& fit : calibration.fits) {
    const auto is_out = std::find(overruled.begin(), overruled.end(), fit.model.law->name);
    if (fit.reference || is_out != overruled.end()) continue;
    fits.push_back(&fit);
    numbers.push_back(numbers_of(fit, calibration.fits));
  }
  std::vector<LawErrors> laws(fits.size());
  parallel_for(laws.size(), [&](std::size_t i) {
    laws[i] = {fits[i]->model.law->name,
               stats::by_recording(unseen_sums(*fits[i], input.validation))};
  });
  calibration.recommended = recommend(laws, numbers);
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
  for (const ModelFit& fit : calibration.fits)
    if (fit.model.law->name == calibration.recommended.law) return fit;
  return best_fit(calibration);
}

std::string recommended_sentence(const Calibration& calibration, int decimals) {
  const Recommended& r = calibration.recommended;
  if (r.law.empty()) return "";
  if (r.law == r.best)
    return fmt::format("recommended: {}, which is the best; no simpler law is within one standard "
                       "error of it",
                       r.law);
  const double mae = recommended_fit(calibration).validation.mae_MPa;
  return fmt::format("recommended: {} ({:.{}f} MPa), the simplest law that is not worse than {} by "
                     "more than one standard error ({:+.{}f} +- {:.{}f} MPa; {} against {})",
                     r.law, mae, decimals, r.best, r.behind_MPa, decimals, r.std_error_MPa,
                     decimals, numbers_text(r.numbers), thousands(r.numbers_of_best));
}

} // namespace frictab::calibrate
