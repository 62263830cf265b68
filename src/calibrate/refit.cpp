// Fits the laws again to all experiments.
#include "calibrate/refit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/beyond_ends.h"
#include "calibrate/cross_validation.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/fit_law.h"
#include "calibrate/folds.h"
#include "calibrate/metrics.h"
#include "calibrate/row_errors.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "data/append.h"

namespace frictab::calibrate {

using data::Dataset;

namespace {

// With so many experiments, ten folds: each leaves out a tenth, so that the network is trained ten
// times instead of a hundred.
constexpr std::size_t many_experiments = 30, usual_folds = 10;

ModelFit fitted_to(const Dataset& all, const models::Law& law,
                   const models::Conventions& conventions, const CalibrationOptions& options) {
  return fit_and_judge(
      law, conventions, all, options,
      [&](ModelFit& fit, const models::AssembledLaw& assembled, const Predicted& fitted) {
        fit.fitted_to_all = true;
        RowsBeyond beyond;
        beyond.add(*assembled.model.law, fitted.columns, all);
        beyond.add_remark(fit.remarks, *assembled.model.law, "training and validation");
        fit.training = metrics(all, fitted.tau_MPa, options.bootstrap, options.seed);
        fit.band = check_band(fit.model);
      });
}

void cross_validate_fits(std::vector<ModelFit>& fits, const CrossValidation& cross,
                         const CalibrationOptions& options) {
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i].validation = metrics_of(cross.errors[i], options);
    fits[i].band.inside = cross.bands[i].inside;
    fits[i].band.experiments = cross.bands[i].experiments;
  }
}

// Judges condensed data by a second reading of their rows.
void judge_on_rows(std::vector<ModelFit>& fits, const CrossValidation& cross,
                   std::span<const std::size_t> fold_of, const Dataset& all,
                   const CalibrationOptions& options) {
  if (!all.condensed) return;
  RowsToJudge fitted{&all, false}, left_out{&all, true};
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fitted.laws.push_back({models::AssembledLaw(fits[i].model)});
    const std::vector<models::AssembledLaw> folds(cross.without[i].begin(), cross.without[i].end());
    left_out.laws.emplace_back();
    for (const std::size_t fold : fold_of)
      left_out.laws.back().push_back(folds[fold]);
  }
  const std::vector<RowFindings> found = judge_rows(std::array{fitted, left_out});
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i].training = metrics_of(found[0].errors[i], options);
    fits[i].validation = metrics_of(found[1].errors[i], options);
  }
}

std::string folds_text(std::size_t folds, std::size_t experiments, std::size_t recordings) {
  if (folds == experiments) return "each experiment left out in turn";
  return fmt::format("cross-validated by {} in {} folds",
                     recordings > 0 ? "recording" : "experiment", folds);
}

std::string interval_words(const Interval& interval, int decimals) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return "";
  return fmt::format(" ({:.{}f} to {:.{}f})", interval.low, decimals, interval.high, decimals);
}

std::string experiments_words(std::size_t n) {
  return fmt::format("{} experiment{}", thousands(n), n == 1 ? "" : "s");
}

// Sentence for the case that the laws are fitted to all experiments with any `deliver`.
std::string nothing_left_to_add(const Calibration& c) {
  if (c.deliver == Deliver::training) return "";
  const std::string all = experiments_words(c.fits.front().training.n_experiments);
  if (c.judged_by == JudgedBy::fit)
    return "deliver = \"all\" changes nothing: the laws are fitted to the one experiment there is";
  return fmt::format("deliver = \"all\" changes nothing: the laws delivered are fitted to all {}, "
                     "and the errors of those left out in turn are what to expect on new tests",
                     all);
}

// Names laws with effects that are not refitted (trace/judge/refit_traced.h).
std::string traced_words(const Calibration& c) {
  std::vector<std::string> names;
  for (const ModelFit& fit : c.fits)
    if (!fit.on_all) names.push_back(fit.model.law->name);
  if (names.empty()) return "";
  return fmt::format("; {} {} delivered as traced, fitted to the training experiments alone",
                     join(names, ", "), names.size() == 1 ? "is" : "are");
}

} // namespace

std::vector<std::size_t> delivery_folds(const Dataset& all, std::uint64_t seed) {
  const data::Units units = data::units_of(all);
  return units.count >= many_experiments ? experiment_folds(units, usual_folds, seed, 0) : units.of;
}

void refit_on_all(Calibration& calibration, const models::Conventions& conventions,
                  const CalibrationInput& input) {
  std::optional<Dataset> made;
  const Dataset& all =
      input.all ? *input.all : made.emplace(data::together(input.training, input.validation));
  std::vector<const models::Law*> laws;
  for (const ModelFit& fit : calibration.fits)
    laws.push_back(input.models.laws.find(fit.model.law->name));
  std::vector<ModelFit> fits(laws.size());
  Progress progress("calibrating on all experiments", laws.size());
  parallel_for(laws.size(), [&](std::size_t i) {
    fits[i] = fitted_to(all, *laws[i], conventions, input.options);
    progress.tick();
  });
  const auto fold_of = delivery_folds(all, input.options.seed);
  const CrossValidation cross = cross_validate(laws, conventions, all, input.options, fold_of);
  cross_validate_fits(fits, cross, input.options);
  judge_on_rows(fits, cross, fold_of, all, input.options);
  calibration.delivery_folds = *std::ranges::max_element(fold_of) + 1;
  for (std::size_t i = 0; i < fits.size(); ++i)
    calibration.fits[i].on_all = std::make_shared<const ModelFit>(std::move(fits[i]));
}

std::string delivery_sentence(const Calibration& c, int decimals) {
  if (c.fits.empty()) return "";
  if (!on_other_experiments(c.judged_by)) return nothing_left_to_add(c);
  const std::string trained = experiments_words(c.fits.front().training.n_experiments);
  if (c.deliver == Deliver::training)
    return fmt::format("delivered: fitted to the {} of the training; calibration.deliver = \"all\" "
                       "fits again to all",
                       trained);
  const auto first =
      std::ranges::find_if(c.fits, [](const ModelFit& fit) { return fit.on_all != nullptr; });
  if (first == c.fits.end()) return "";
  const ModelFit& fit = *first->on_all;
  return fmt::format("delivered: fitted again to all {}; cross-validated over these {} errs by "
                     "{:.{}f} MPa{}, {}; the "
                     "errors above are of the fits to the {} of the training{}",
                     experiments_words(fit.training.n_experiments), fit.model.law->name,
                     fit.validation.mae_MPa, decimals,
                     interval_words(fit.validation.mae_interval, decimals),
                     folds_text(c.delivery_folds, fit.training.n_experiments, c.recordings),
                     trained, traced_words(c));
}

} // namespace frictab::calibrate
