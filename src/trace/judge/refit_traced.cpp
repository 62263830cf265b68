// One campaign per fold, and one of all experiments; no search.
#include "trace/judge/refit_traced.h"

#include <algorithm>
#include <optional>

#include "calibrate/band.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/input_columns.h"
#include "calibrate/metrics.h"
#include "calibrate/refit.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "trace/judge/rows_alike.h"

namespace frictab::trace {

using data::Dataset;

namespace {

class Refitter {
public:
  Refitter(const Search& search, const Rival& rival) : s_(search), rival_(rival) {}

  // Fits the law to some experiments; returns nothing if these lack a column.
  std::optional<models::Model> fitted_to(const Dataset& data,
                                         calibrate::Uncertainty* uncertain = nullptr) const {
    TraceOptions options = s_.input().options;
    options.order = s_.candidates().order_column; // tests of a part are not numbered 1 to n
    const Dataset none = data.subset({});
    const TraceInput input{data,           none, s_.input().fit, options, s_.input().bootstrap,
                           s_.input().seed};
    const Search part(input, &rival_.noise);
    std::vector<Cause> causes;
    for (const Cause& cause : rival_.causes) {
      const auto here = cause_in(part.candidates(), cause, s_.candidates());
      if (!here) return std::nullopt;
      causes.push_back(*here);
    }
    Rival fit = fit_rival(part.campaign(), rival_.effects, causes, rival_.parameters, rival_.noise,
                          NoiseSearch::again);
    if (!(rival_.weights.gain > 0)) fit = with_weights(part.campaign(), fit, rows_alike(fit.noise));
    if (uncertain) *uncertain = uncertainty_of(part.campaign(), fit);
    return part.model_of(fit);
  }

private:
  const Search& s_;
  const Rival& rival_;
};

// Errors of every experiment by the law fitted without its fold; empty if a fold lacks a column.
std::vector<stats::ErrorSums> cross_validated(const Refitter& refitter, const Dataset& all,
                                              std::span<const std::size_t> fold_of) {
  const std::size_t folds = *std::ranges::max_element(fold_of) + 1;
  std::vector<stats::ErrorSums> errors(fold_of.size());
  std::vector<char> done(folds, 0);
  const Progress progress("fitting the traced law to all experiments", folds);
  parallel_for(folds, [&](std::size_t fold) {
    std::vector<std::size_t> in, out;
    for (std::size_t e = 0; e < fold_of.size(); ++e)
      (fold_of[e] == fold ? out : in).push_back(e);
    const auto model = refitter.fitted_to(all.subset(in));
    progress.tick();
    if (!model) return;
    const Dataset left_out = all.subset(out);
    const auto sums = stats::error_sums(left_out, calibrate::predict(*model, left_out));
    for (std::size_t i = 0; i < out.size(); ++i)
      errors[out[i]] = sums[i];
    done[fold] = 1;
  });
  if (std::ranges::count(done, 0) > 0) return {};
  return errors;
}

} // namespace

void add_fitted_tests(calibrate::ModelFit& fit, const calibrate::Uncertainty& uncertainty,
                      const Dataset& tests, const TraceInput& in) {
  fit.std_error = uncertainty.std_error;
  fit.std_error_method = "cluster sandwich by experiment";
  fit.remarks = uncertainty.remarks;
  fit.model.covariance = calibrate::row_by_row(calibrate::known_covariance(uncertainty));
  const models::AssembledLaw law(fit.model);
  const auto [columns, tau] = calibrate::predict_with_columns(law, law.inputs, tests);
  fit.data_range = columns.ranges();
  fit.training = calibrate::metrics(tests, tau, in.bootstrap, in.seed);
  fit.model.experiment_gains = calibrate::gains_of_new_experiments(
      calibrate::experiment_gains(tests, tau), fit.model.parameters.size());
}

std::shared_ptr<const calibrate::ModelFit>
refit_traced(const Found& found, const Delivery& delivery, const Dataset& all) {
  const TraceInput& in = found.search.input();
  if (delivery.rival.effects.empty() || found.order.found ||
      models::is_trained(in.fit.model.law->calibrated))
    return nullptr;
  const Refitter refitter(found.search, delivery.rival);
  calibrate::Uncertainty uncertainty;
  const auto model = refitter.fitted_to(all, &uncertainty);
  if (!model) return nullptr;
  const auto fold_of = calibrate::delivery_folds(all, in.seed);
  const auto errors = cross_validated(refitter, all, fold_of);
  if (errors.empty()) return nullptr;
  calibrate::ModelFit fit;
  fit.model = *model;
  add_fitted_tests(fit, uncertainty, all, in);
  fit.fitted_to_all = true;
  fit.termination = "the effects of the trace, fitted again to all experiments";
  fit.remarks.push_back("its effects were chosen by tests that are left out in turn here: the "
                        "error on new tests is a little larger");
  fit.validation = calibrate::metrics(errors, in.bootstrap, in.seed);
  fit.band = calibrate::check_band(fit.model, {}, all.subset({}));
  return std::make_shared<const calibrate::ModelFit>(std::move(fit));
}

} // namespace frictab::trace
