// Stage: search, the law with its effects, their value, and a report.
#include "trace/trace.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/band.h"
#include "calibrate/comparison.h"
#include "calibrate/experiment_errors.h"
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
#include "trace/judge/gains.h"
#include "trace/judge/refit_traced.h"
#include "trace/judge/rows_alike.h"
#include "trace/judge/verdict.h"
#include "trace/search/order_search.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

constexpr std::size_t alternatives_shown = 8;
constexpr std::size_t pairs_named = 3; // pairs of texts that were not searched

// Notes pairs of texts of which too few tests have some pairs of levels.
void note_pairs_not_searched(const Search& search, std::vector<std::string>& notes) {
  const Candidates& candidates = search.candidates();
  std::vector<std::size_t> texts;
  for (std::size_t c = 0; c < candidates.columns.size(); ++c)
    if (!candidates.columns[c].levels.empty() && candidates.columns[c].between) texts.push_back(c);
  std::vector<std::string> pairs;
  for (std::size_t a = 0; a < texts.size(); ++a)
    for (std::size_t b = a + 1; b < texts.size(); ++b)
      if (const Cause pair{{texts[a], texts[b]}}; !are_crossed(candidates, pair, search.first()))
        pairs.push_back(cause_name(pair, candidates));
  if (pairs.empty()) return;
  const std::size_t more = pairs.size() - std::min(pairs.size(), pairs_named);
  pairs.resize(pairs.size() - more);
  notes.push_back(fmt::format("{}{}, as not every pair of levels has {} tests{}", join(pairs, ", "),
                              and_more(more, "pair"), tuning::fewest_tests_of_pair, not_searched));
}

// Lists what was tried, and what would have been seen.
Trace what_was_tried(const Found& found) {
  const Search& search = found.search;
  const TraceInput& in = search.input();
  Trace trace;
  trace.model = in.fit.model.name();
  trace.alpha = in.options.alpha;
  trace.least_p_value = std::pow(2.0, 1 - static_cast<double>(in.training.experiments.size()));
  trace.repeatability = in.options.repeatability;
  trace.order = found.order;
  trace.rejected = found.rejected;
  trace.notes = search.candidates().notes;
  if (!search.candidates().constant.empty())
    trace.notes.push_back("never varied, so its influence is unknown: " +
                          join(search.candidates().constant, ", "));
  note_pairs_not_searched(search, trace.notes);
  if (search.one_factor())
    trace.notes.push_back("the tests change one state at a time: what several do together no test "
                          "shows, nor what a law with effects is worth there");
  trace.n_columns = search.candidates().columns.size();
  trace.n_candidates = found.leftover.terms;
  trace.n_flips = found.leftover.flips;
  trace.smallest_seen = found.leftover.smallest_seen;
  for (const Seen& seen : found.leftover.seen) {
    const CandidateColumn& column = search.candidates().first_of(seen.cause);
    const double size = seen.identifiable ? seen.size : 0;
    if (!seen.identifiable) trace.not_identifiable.push_back(column.name);
    trace.detectable.push_back({column.name, column.derived ? column.name : "", effects::ActsOn::mu,
                                size * search.tau_scale_MPa(), size, seen.identifiable});
  }
  return trace;
}

// Judges on the validation tests like all other laws, however few; without any, on left-out
// training tests.
void judge(calibrate::ModelFit& fit, const TraceInput& in, const Delivery& delivery) {
  if (!in.searched.empty()) {
    std::vector<stats::ErrorSums> sums;
    for (std::size_t i = 0; i < in.searched.size(); ++i) {
      sums.push_back(delivery.unseen_sums[in.searched[i]]);
      fit.unseen.push_back(
          calibrate::error_of(in.validation.experiments[i], true, sums.back(), no_value));
    }
    fit.validation = calibrate::metrics(sums, in.bootstrap, in.seed);
    for (std::size_t e = 0; e < in.training.experiments.size(); ++e)
      fit.over_all.push_back(
          calibrate::error_of(in.training.experiments[e], true, delivery.unseen_sums[e], no_value));
    fit.band = calibrate::check_band(fit.model, {}, in.training.subset({}));
  } else if (in.validation.experiments.empty()) {
    fit.validation = delivery.after.validation;
    fit.band = calibrate::check_band(fit.model, {}, in.validation);
    if (delivery.left_out.folds == 0) fit.unseen = in.fit.unseen;
    for (std::size_t e = 0; fit.unseen.size() < in.training.experiments.size(); ++e)
      fit.unseen.push_back(
          calibrate::error_of(in.training.experiments[e], true, delivery.unseen_sums[e], no_value));
  } else {
    const std::vector<double> unseen = calibrate::predict(fit.model, in.validation);
    fit.validation = calibrate::metrics(in.validation, unseen, in.bootstrap, in.seed);
    fit.band = calibrate::check_band(fit.model, unseen, in.validation);
  }
}

// The delivered law as a fit; without a law unless an effect was added or a structure removed.
calibrate::ModelFit fit_of(const Found& found, const Delivery& delivery,
                           const calibrate::Uncertainty& uncertainty) {
  const TraceInput& in = found.search.input();
  const Rival& rival = delivery.rival;
  calibrate::ModelFit fit;
  if (rival.effects.empty() && !found.order.found) return fit;
  fit.model = found.search.model_of(rival);
  fit.termination = rival.weights.gain > 0
                        ? "generalised least squares under the noise model of the trace"
                        : "least squares, which predicts left-out experiments better here than "
                          "the noise model's weights";
  add_fitted_tests(fit, uncertainty, in.training, in);
  judge(fit, in, delivery);
  if (in.all) fit.on_all = refit_traced(found, delivery, *in.all);
  return fit;
}

// --- effects --------------------------------------------------------------------------------

// `first`: index of the effect's first parameter in the fit.
std::vector<TracedParameter> parameters_of(const effects::PlacedEffect& placed,
                                           const calibrate::ModelFit& fit,
                                           const calibrate::Uncertainty& uncertainty,
                                           std::size_t first) {
  std::vector<TracedParameter> traced;
  const auto fitted = effects::fitted_parameters(placed);
  for (std::size_t p = 0; p < fitted.size(); ++p)
    traced.push_back({fitted[p].name, fit.model.parameters[first + p], fit.std_error[first + p],
                      fit.model.law->parameters[first + p].unit, uncertainty.why_none[first + p]});
  const std::vector<models::Parameter> all = effects::parameters_of(placed);
  for (std::size_t p = 0; p < all.size(); ++p)
    if (!contains(fitted, all[p].name, &models::Parameter::name))
      traced.push_back(
          {all[p].name, placed.parameters[p], no_value, effects::unit_of(all[p], placed), ""});
  return traced;
}

std::vector<Alternative> alternatives_of(const Finding& finding, const Candidates& candidates) {
  const std::string name = cause_name(finding.cause(), candidates);
  std::vector<Alternative> alternatives;
  for (std::size_t i = 0; i < std::min(finding.others.size(), alternatives_shown); ++i) {
    const Rival& other = finding.others[i];
    const Lead names = lead_of(other.causes.back(), candidates);
    alternatives.push_back(
        {names.name, names.columns, names.derived, other.effects.back().form->name,
         other.effects.back().acts_on, finding.in_set[i],
         finding.in_set[i]
             ? fmt::format("cannot be distinguished from {} by these experiments", name)
             : fmt::format("explains less than {} (log likelihood {:.1f} lower)", name,
                           finding.rival.total - other.total)});
  }
  return alternatives;
}

std::vector<TracedEffect> effects_of(const Found& found, const Delivery& delivery,
                                     const calibrate::ModelFit& fit,
                                     const calibrate::Uncertainty& uncertainty) {
  const Search& search = found.search;
  const Rival& rival = delivery.rival;
  std::vector<TracedEffect> traced;
  for (std::size_t i = 0; i < rival.effects.size(); ++i) {
    const Finding& finding = found.findings[delivery.findings[i]];
    const Cause& cause = finding.cause();
    TracedEffect& effect = traced.emplace_back();
    effect.placed = rival.effects[i];
    const Lead names = lead_of(rival.causes[i], search.candidates());
    effect.columns = names.columns;
    effect.derived = names.derived;
    effect.between = finding.between;
    effect.p_value = finding.p_value;
    effect.parameters = parameters_of(effect.placed, fit, uncertainty, first_parameter(rival, i));
    effect.alternatives = alternatives_of(finding, search.candidates());
    effect.design = design_for(search, finding);
    effect.order_confounded = may_stand_for_time(found, cause);
    if (effect.order_confounded && effect.design.tests.empty())
      effect.design = design_in_turn(search, cause, order_name(search));
    effect.gain_MPa = delivery.gain_MPa[i];
    effect.curve =
        effect_curve(search.campaign(), rival, search.sensitivities(), i, uncertainty.covariance);
  }
  return traced;
}

struct Delivered {
  Found found;
  Delivery delivery;
};

// A finding that is not delivered may have hidden another: the search is repeated without it, and
// the law that predicts left-out tests better is taken.
Delivered search_and_deliver(const TraceInput& in) {
  Found found = search_effects(in);
  Delivery delivery = deliver(found);
  if (delivery.against.empty()) return {std::move(found), std::move(delivery)};
  std::vector<Cause> barred;
  std::vector<std::string> rejected;
  for (const auto& [index, against] : delivery.against) {
    barred.push_back(found.findings[index].cause());
    rejected.push_back(rejection(found.search.candidates(), barred.back(),
                                 found.findings[index].p_value, against.why));
  }
  Found again = search_effects(in, barred);
  if (again.findings.empty()) return {std::move(found), std::move(delivery)};
  Delivery other = deliver(again);
  if (other.findings.empty() ||
      !(other.left_out_MPa < (1 - calibrate::same_error) * delivery.left_out_MPa))
    return {std::move(found), std::move(delivery)};
  again.rejected.insert(again.rejected.begin(), rejected.begin(), rejected.end());
  return {std::move(again), std::move(other)};
}

Trace trace_in_order(const TraceInput& in) {
  const auto [found, delivery] = search_and_deliver(in);
  const calibrate::Uncertainty uncertainty =
      uncertainty_of(found.search.campaign(), delivery.rival);
  Trace trace = what_was_tried(found);
  trace.extended = fit_of(found, delivery, uncertainty);
  trace.extended_model = trace.extended.model.law ? trace.extended.model.name() : "";
  trace.effects = effects_of(found, delivery, trace.extended, uncertainty);
  static_cast<BeforeAndAfter&>(trace) = delivery;
  trace.as_calibrated = {in.fit.training, in.fit.validation};
  if (found.order.found && trace.effects.empty() && in.searched.empty())
    trace.after = {trace.extended.training, trace.extended.validation};
  trace.validation_searched = !in.searched.empty();
  if (!trace.validation_searched)
    trace.validation_shift = validation_shift_of(found.search, delivery.rival);
  const Progress progress("what would have been seen", 0);
  add_scatter(trace, found.search, delivery.rival);
  add_leads(trace, found, delivery);
  trace.cannot_tell = find_aliases(in.training, in.fit.model, in.options);
  add_verdict(trace, found, delivery.contradicted());
  return trace;
}

// Sorts tests and columns by name, so that results do not depend on their order in files.
data::Dataset in_order_of_names(const data::Dataset& data) {
  std::vector<std::size_t> order(data.experiments.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(
      order, {}, [&](std::size_t e) -> const std::string& { return data.experiments[e]; });
  data::Dataset sorted = data.subset(order);
  std::ranges::stable_sort(sorted.columns, {}, &data::Column::name);
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
  constexpr const char* names[] = {"effect_added", "nothing_missing", "nothing_found",
                                   "unexplained_structure"};
  return names[static_cast<std::size_t>(verdict)];
}

Trace trace(const TraceInput& input) {
  const data::Dataset all = input.all ? in_order_of_names(*input.all) : data::Dataset{};
  const auto run = [&](const data::Dataset& training, std::vector<std::size_t> searched) {
    const TraceInput sorted{
        training,   input.validation,           input.fit,          input.options, input.bootstrap,
        input.seed, input.all ? &all : nullptr, std::move(searched)};
    return trace_in_order(sorted);
  };
  const std::size_t few = input.validation.experiments.size();
  if (few == 0 || few >= tuning::fewest_judging_validation_tests || of_another_world(input))
    return run(in_order_of_names(input.training), {});
  const data::Dataset both = data::together(input.training, input.validation);
  const data::Dataset sorted = in_order_of_names(both);
  std::vector<std::size_t> places;
  for (std::size_t e = both.experiments.size() - few; e < both.experiments.size(); ++e)
    places.push_back(std::ranges::find(sorted.experiments, both.experiments[e]) -
                     sorted.experiments.begin());
  return run(sorted, std::move(places));
}

} // namespace frictab::trace
