// Stage: search, the law with its effects, their value, and a report.
#include "trace/trace.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/band.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/input_columns.h"
#include "calibrate/metrics.h"
#include "core/no_value.h"
#include "core/progress.h"
#include "core/text.h"
#include "data/append.h"
#include "trace/advise/design.h"
#include "trace/advise/effect_curve.h"
#include "trace/advise/leads.h"
#include "trace/columns/aliases.h"
#include "trace/judge/delivery.h"
#include "trace/judge/refit_traced.h"
#include "trace/judge/scatter.h"
#include "trace/judge/uncertainty.h"
#include "trace/judge/verdict.h"
#include "trace/search/order_search.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

class Reporter {
public:
  Reporter(const TraceInput& input, const Search& search) : in_(input), search_(search) {}

  Trace run() {
    Trace trace;
    trace.model = in_.fit.model.name();
    trace.alpha = in_.options.alpha;
    trace.least_p_value = std::pow(2.0, 1 - static_cast<double>(experiments()));
    trace.repeatability = in_.options.repeatability;
    trace.order = search_.order;
    trace.rejected = search_.rejected;
    trace.notes = search_.candidates.notes;
    add_tried(trace);
    delivery_ = deliver(search_, trace);
    trace.validation_searched = !in_.searched.empty();
    if (!trace.validation_searched)
      trace.validation_shift = validation_shift_of(search_, delivery_.rival);
    add_law(trace);
    add_effects(trace);
    const Progress progress("what would have been seen", 0);
    add_scatter(trace, search_, delivery_.rival);
    add_leads(trace, search_, delivery_);
    trace.cannot_tell = find_aliases(in_.training, in_.fit.model, in_.options);
    add_verdict(trace, search_, delivery_.contradicted());
    return trace;
  }

private:
  void add_tried(Trace& trace) const {
    if (!search_.candidates.constant.empty())
      trace.notes.push_back("never varied, so its influence is unknown: " +
                            join(search_.candidates.constant, ", "));
    if (search_.one_factor)
      trace.notes.push_back(
          "the tests change one state at a time: what several do together no test "
          "shows, nor what a law with effects is worth there");
    trace.n_columns = search_.candidates.columns.size();
    const Leftover& leftover = search_.leftover;
    trace.n_candidates = leftover.terms;
    trace.n_flips = leftover.flips;
    trace.smallest_seen = leftover.smallest_seen;
    for (const Seen& seen : leftover.seen) {
      const CandidateColumn& column = search_.candidates.columns[seen.cause.columns[0]];
      Detectable entry{
          column.name,      column.derived ? column.name : "", effects::ActsOn::mu, 0, 0,
          seen.identifiable};
      if (seen.identifiable) {
        entry.share = seen.size;
        entry.size_MPa = seen.size * search_.tau_scale_MPa;
      } else
        trace.not_identifiable.push_back(column.name);
      trace.detectable.push_back(std::move(entry));
    }
  }

  calibrate::Metrics errors(const data::Dataset& data, const std::vector<double>& predicted) const {
    return calibrate::metrics(data, predicted, in_.bootstrap, in_.seed);
  }

  // Judges on the validation tests like all other laws, however few; without any, on left-out
  // training tests.
  void judge(Trace& trace) const {
    calibrate::ModelFit& fit = trace.extended;
    if (!in_.searched.empty()) {
      std::vector<stats::ErrorSums> sums;
      for (std::size_t i = 0; i < in_.searched.size(); ++i) {
        sums.push_back(delivery_.unseen[in_.searched[i]]);
        fit.unseen.push_back(
            calibrate::error_of(in_.validation.experiments[i], true, sums.back(), no_value));
      }
      fit.validation = calibrate::metrics(sums, in_.bootstrap, in_.seed);
      fit.band = calibrate::check_band(fit.model, {}, in_.training.subset({}));
      return;
    }
    if (in_.validation.experiments.empty()) {
      fit.validation = trace.after.validation;
      fit.band = calibrate::check_band(fit.model, {}, in_.validation);
      if (delivery_.nested.folds == 0) fit.unseen = in_.fit.unseen;
      for (std::size_t e = 0; fit.unseen.size() < experiments(); ++e)
        fit.unseen.push_back(
            calibrate::error_of(in_.training.experiments[e], true, delivery_.unseen[e], no_value));
      return;
    }
    const std::vector<double> unseen = calibrate::predict(fit.model, in_.validation);
    fit.validation = errors(in_.validation, unseen);
    fit.band = calibrate::check_band(fit.model, unseen, in_.validation);
  }

  // Adds the delivered law, unless no effect was added and no structure removed.
  void add_law(Trace& trace) {
    const Rival& rival = delivery_.rival;
    if (rival.effects.empty() && !search_.order.found) return;
    uncertainty_ = uncertainty_of(search_.campaign(), rival);
    calibrate::ModelFit& fit = trace.extended;
    fit.model = search_.model_of(rival);
    fit.std_error = uncertainty_.std_error;
    fit.model.covariance = calibrate::row_by_row(calibrate::known_covariance(uncertainty_));
    fit.remarks = uncertainty_.remarks;
    fit.std_error_method = "cluster sandwich by experiment";
    fit.termination = rival.weights.gain > 0
                          ? "generalised least squares under the noise model of the trace"
                          : "least squares, which predicts left-out experiments better here than "
                            "the noise model's weights";
    const models::AssembledLaw law(fit.model);
    const auto [columns, trained] = calibrate::predict_with_columns(law, law.inputs, in_.training);
    fit.data_range = columns.ranges();
    fit.training = errors(in_.training, trained);
    fit.model.experiment_gains = calibrate::gains_of_new_experiments(
        calibrate::experiment_gains(in_.training, trained), fit.model.parameters.size());
    judge(trace);
    trace.extended_model = fit.model.name();
    if (rival.effects.empty()) trace.after = {fit.training, fit.validation};
    if (in_.all) fit.on_all = refit_traced(search_, delivery_, *in_.all);
  }

  // --- effects ------------------------------------------------------------------------------

  void add_effects(Trace& trace) {
    std::size_t parameter = in_.fit.model.law->parameters.size();
    const Rival& rival = delivery_.rival;
    for (std::size_t i = 0; i < rival.effects.size(); ++i) {
      const Lead names = lead_of(search_, rival.causes[i]);
      TracedEffect effect;
      effect.placed = rival.effects[i];
      effect.columns = names.columns;
      effect.derived = names.derived;
      const Finding& finding = search_.findings[delivery_.findings[i]];
      effect.between = finding.between;
      effect.p_value = finding.p_value;
      const std::size_t count = effects::fitted_parameters(effect.placed).size();
      add_parameters(effect, trace.extended, parameter);
      add_alternatives(effect, finding);
      effect.gain_MPa = delivery_.gain_MPa[i];
      effect.curve = effect_curve(search_.campaign(), rival, search_.sensitivities(), i, parameter,
                                  uncertainty_.covariance);
      parameter += count;
      trace.effects.push_back(std::move(effect));
    }
  }

  void add_parameters(TracedEffect& effect, const calibrate::ModelFit& fit,
                      std::size_t first) const {
    const auto fitted = effects::fitted_parameters(effect.placed);
    for (std::size_t p = 0; p < fitted.size(); ++p)
      effect.parameters.push_back(
          {fitted[p].name, fit.model.parameters[first + p], fit.std_error[first + p],
           fit.model.law->parameters[first + p].unit, uncertainty_.why_none[first + p]});
    const std::vector<models::Parameter> all = effects::parameters_of(effect.placed);
    for (std::size_t p = 0; p < all.size(); ++p) {
      const models::Parameter& parameter = all[p];
      const bool known = std::any_of(fitted.begin(), fitted.end(), [&](const models::Parameter& f) {
        return f.name == parameter.name;
      });
      if (!known)
        effect.parameters.push_back({parameter.name, effect.placed.parameters[p], no_value,
                                     effects::unit_of(parameter, effect.placed), ""});
    }
  }

  void add_alternatives(TracedEffect& effect, const Finding& finding) const {
    const std::string name = cause_name(finding.rival.causes.back(), search_.candidates);
    for (std::size_t i = 0; i < finding.others.size() && i < 8; ++i) {
      const Rival& other = finding.others[i];
      const Lead names = lead_of(search_, other.causes.back());
      const double behind = finding.rival.total - other.total;
      effect.alternatives.push_back(
          {names.name, names.columns, names.derived, other.effects.back().form->name,
           other.effects.back().acts_on, finding.in_set[i],
           finding.in_set[i]
               ? fmt::format("cannot be distinguished from {} by these experiments", name)
               : fmt::format("explains less than {} (log likelihood {:.1f} lower)", name, behind)});
    }
    effect.design = design_for(search_, finding);
    const Cause& cause = finding.rival.causes.back();
    effect.order_confounded = may_stand_for_time(search_, cause);
    if (effect.order_confounded && effect.design.tests.empty())
      effect.design = design_in_turn(search_, cause);
  }

  std::size_t experiments() const { return in_.training.experiments.size(); }

  const TraceInput& in_;
  const Search& search_;
  Delivery delivery_;
  calibrate::Uncertainty uncertainty_; // of the delivered law
};

// Sorts tests and columns by name, so that results do not depend on their order in files.
data::Dataset in_order_of_names(const data::Dataset& data) {
  std::vector<std::size_t> order(data.experiments.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return data.experiments[a] < data.experiments[b];
  });
  data::Dataset sorted = data.subset(order);
  std::stable_sort(sorted.columns.begin(), sorted.columns.end(),
                   [](const data::Column& a, const data::Column& b) { return a.name < b.name; });
  return sorted;
}

bool of_another_world(const TraceInput& in) {
  const models::Model& model = in.fit.model;
  return shift_of(test_gains(in.training, calibrate::predict(model, in.training)),
                  test_gains(in.validation, calibrate::predict(model, in.validation)),
                  static_cast<double>(model.parameters.size()))
      .found;
}

} // namespace

double tests_for(double alpha) {
  return std::ceil(1 - std::log2(alpha));
}

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
  case Verdict::effect_added:
    return "effect_added";
  case Verdict::nothing_missing:
    return "nothing_missing";
  case Verdict::nothing_found:
    return "nothing_found";
  case Verdict::unexplained_structure:
    break;
  }
  return "unexplained_structure";
}

Trace trace(const TraceInput& input) {
  const data::Dataset all = input.all ? in_order_of_names(*input.all) : data::Dataset{};
  const auto run = [&](const data::Dataset& training, std::vector<std::size_t> searched) {
    const TraceInput sorted{
        training,   input.validation,           input.fit,          input.options, input.bootstrap,
        input.seed, input.all ? &all : nullptr, std::move(searched)};
    const std::unique_ptr<Search> search = search_effects(sorted);
    return Reporter(sorted, *search).run();
  };
  const std::size_t few = input.validation.experiments.size();
  if (few == 0 || few >= tuning::fewest_judging_validation_tests || of_another_world(input))
    return run(in_order_of_names(input.training), {});
  const data::Dataset both = data::together(input.training, input.validation);
  const data::Dataset sorted = in_order_of_names(both);
  std::vector<std::size_t> places;
  for (std::size_t e = both.experiments.size() - few; e < both.experiments.size(); ++e)
    places.push_back(static_cast<std::size_t>(
        std::find(sorted.experiments.begin(), sorted.experiments.end(), both.experiments[e]) -
        sorted.experiments.begin()));
  return run(sorted, std::move(places));
}

} // namespace frictab::trace
