// The trace stage: does the residual of a calibrated law have structure, which recorded quantity
// does it follow, how does the law look with that effect in it, and how much better does it
// predict?
//
// The folder, in the order in which a trace runs (docs/tracing.md says why):
//   trace.cpp          the stage: sorts the data by name, searches, delivers, reports
//   what a search works on
//     blocks           rows of an experiment as at most 40 block means
//     selection        200 tests that stand for all where there are many more
//     candidates       columns, histories and pairs that an effect may follow (a Cause)
//     shapes           forms of an effect of a cause, before it is fitted
//     law_on_blocks    a law on blocks: predictions, derivatives, weighted fits (gram: their sums)
//     noise, noise_fit the covariance of residuals, and its fit
//     rivals           a law with some effects, fitted together with the noise (a Rival)
//     directions       derivatives of tau_R: what is known, what an effect would change
//     projection       bases, to take what is known out of what is tested
//   the search
//     search           its state
//     search_effects   the recipe: one search, then what follows the order of tests
//     joint            response, law and terms of a campaign, and what was found in its words
//     modes, terms     tests as means and cosines; curves, factors and products as columns
//     joint_model      one penalised mixed model of all that
//     joint_search     which terms the residual follows more than any would by chance
//     joint_choice     which of them pay on tests left out
//     choose_effect    which of the causes near a finding, in which form, with smooth and
//                      plausibility
//     order_search     what the order of tests explains as well, with order_test
//   what comes of it
//     nested_errors    the law with what is found without some tests, on those
//     delivery         which findings are delivered with the law
//     leads, design    what is not, and the tests that would settle it, with candidate_tests;
//                      followers: what may follow from friction
//     refit_traced     the law with them, fitted again to all experiments
//     uncertainty      standard errors of its parameters
//     scatter          what stays unexplained
//     effect_curve     curves for plots
//     aliases          what the design ties to a state: neither found nor missing
//     verdict          one word and a few sentences
//   trace_file, trace_text   results as JSON and in words
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "effects/extended_law.h"
#include "trace/options.h"

namespace frictab::trace {

struct TracedParameter {
  std::string name;
  double value = 0;
  double std_error = 0; // by experiment; NaN: there is none
  std::string unit;
  std::string why_none; // "at its bound"; empty: there is an error, or it is a reference, set once
};

// Another way to explain what an effect explains.
struct Alternative {
  std::string name; // "dwell_s x friction_work"
  std::vector<std::string> columns;
  std::string derived; // empty: a recorded column
  std::string form;
  effects::ActsOn acts_on = effects::ActsOn::mu;
  bool in_set = false; // cannot be told apart from the effect by these data
  std::string why_not;
};

// Of an effect's curve, for plots: factor over the column, with a band of +-1.96 standard errors,
// and what single experiments say.
struct EffectCurve {
  std::vector<double> x, factor, low, high;
  std::vector<double> point_x, point_factor; // partial residuals of blocks, binned per experiment
};

// Tests to run next: what would settle what these leave open.
struct Design {
  std::vector<std::string> columns;            // what they vary
  std::vector<std::vector<std::string>> tests; // per test a value of each; none: nothing settles it
  std::string like;                            // the test that all else is taken from
  std::vector<std::string> settles; // causes that they tell apart; one: whether it is there
  double probability = 0;           // that they do, if the effect is as large as fitted
  double tests_needed = 0;          // like these, for a probability of 80 %
};

struct TracedEffect {
  effects::PlacedEffect placed;
  std::vector<std::string> columns; // recorded ones
  std::string derived;              // what was computed from them
  std::vector<TracedParameter> parameters;
  bool between = false;          // found on one value per test, not on what changes within tests
  double p_value = 1;            // family-wise, over all candidates of its family
  double gain_MPa = 0;           // MAE on unseen tests without it, all refitted, minus with it
  bool order_confounded = false; // cannot be told from a drift over the order of tests
  Design design;                 // what would decide within the set
  std::vector<Alternative> alternatives;
  EffectCurve curve;
};

// nothing_missing: what is left agrees with a known repeatability | nothing_found: nothing passed,
// and whether the scatter between tests is more than repeatability is not known.
enum class Verdict { effect_added, nothing_missing, nothing_found, unexplained_structure };
const char* verdict_name(Verdict verdict);

// Structure along the order of tests that no recorded column explains.
struct OrderStructure {
  bool found = false;
  std::string column;    // the column that gives the order; empty: nobody declared one
  double p_value = 1;    // of no structure
  double size_MPa = 0;   // root mean square over the training rows
  double share = 0;      // the same, relative to tau_R
  std::string reference; // where the shipped law holds it
};

// The smallest effect that would have been detected.
struct Detectable {
  std::string column;
  std::string derived; // empty: recorded
  effects::ActsOn acts_on = effects::ActsOn::mu;
  double size_MPa = 0;      // root mean square over the training rows, found with 80 % probability
  double share = 0;         // relative to tau_R
  bool identifiable = true; // false: recalibration absorbs it, or the column does not vary
};

// What may be there, but is not in the law, and why not.
struct Lead {
  std::string name;                 // "dwell_s x friction_work"
  std::vector<std::string> columns; // recorded ones
  std::string derived;              // what was computed from them; empty: nothing
  std::string form;
  bool between = false;
  double p_value = 1;
  double share = 0;         // change of tau_R over the column's range, relative; 0: not known
  std::string why;          // "no gain on left-out tests (-0.2 +- 0.3 %)"
  Design design;            // of the strongest, where there is a point in it
  bool significant = false; // by the search, which found it; what came after speaks against it
  // Of what was found: MAE on the tests that were searched, without it and with it. 0: not known.
  double without_MPa = 0, with_MPa = 0;
};

// What the tests cannot tell from a state of the law (aliases.h).
struct Alias {
  std::string column;
  std::string state;
  double share = 0; // of the state's variance between tests that the column explains
  std::string text; // "batch cannot be told from sigma_n_MPa: A only at 800, B only at 1500; ..."
};

// Whether the validation tests as a whole lie higher or lower than the training tests.
struct ValidationShift {
  bool found = false;
  double shift_MPa = 0;         // validation minus training, mean over tests
  calibrate::Interval interval; // 95 %
  double share = 0;             // relative to tau_R
  double p_value = 1;
};

// The search repeated without some of the tests, all of it, judged on those.
struct NestedCheck {
  std::size_t folds = 0; // 0: not run, because nothing was found
  double gain = 0;       // of the mean relative error on left-out tests
  double std_error = 0;  // over tests
  double score = 0;      // gain of the log predictive density, mean over tests
  double score_se = 0;
  std::size_t offered = 0; // effects that the search found on all tests
  std::size_t paying = 0;  // of them, effects that pay by this alone; the validation tests may add
};

struct Remaining {
  bool structure = false;
  double p_value = 1;
  std::string note;
};

struct TraceErrors {
  calibrate::Metrics training;
  calibrate::Metrics validation;
};

struct Trace {
  std::string model;          // the law that was traced
  std::string extended_model; // name of the law with effects; empty: none was added
  Verdict verdict = Verdict::nothing_found;
  std::vector<TracedEffect> effects;
  // Errors on unseen tests are `validation` here: those of the validation tests, or of left-out
  // training tests by the nested search where the former are few.
  TraceErrors as_calibrated; // by the calibration stage; validation tests, whatever `unseen` says
  TraceErrors before;        // the same law, fitted with the same weights as `after`
  TraceErrors after;
  // | nested_cross_validation | leave_one_out: nothing was found | nothing: one test, the fit
  std::string unseen = "validation";
  bool validation_searched = false;  // they are few, and were searched as the training tests
  calibrate::Difference improvement; // MAE on unseen tests before minus after, paired by experiment
  // The same against the law as it was calibrated, which effects must also beat: the weights of the
  // trace may cost a law that lacks something more than the effects gain. On validation tests only.
  std::optional<calibrate::Difference> over_calibrated;
  NestedCheck nested;
  ValidationShift validation_shift;
  std::vector<Lead> leads;              // strongest first
  std::vector<Alias> cannot_tell;       // by column
  calibrate::NoiseFloor noise_floor;    // scatter by the noise model: if nothing else is missing
  double scatter_between = 0;           // relative scatter between experiments, standard deviation
  calibrate::Interval scatter_interval; // 95 %
  double scatter_at_least = 0;          // with 95 % confidence; what repeatability is judged by
  std::optional<double> repeatability;  // what the user gave, or what repeated tests say
  std::string repeatability_from;       // given | repeats; empty: not known
  // Relative difference between two halves of the tests, along a column that is constant within
  // tests, that would have been seen with 80 % probability; infinite: none.
  double smallest_seen = 0;
  OrderStructure order;
  Remaining remaining;
  std::vector<Detectable> detectable; // by column
  std::size_t n_candidates = 0, n_columns = 0, n_flips = 0;
  std::vector<std::string> not_identifiable; // candidates that recalibration absorbs
  std::vector<std::string> rejected;         // looked significant, and why it was not added
  std::vector<std::string> notes;
  double alpha = 0.02;
  double least_p_value = 0;     // that so many experiments can give
  calibrate::ModelFit extended; // judged like any other; model.law is null where none was added
};

struct TraceInput {
  const data::Dataset& training;   // those that are searched
  const data::Dataset& validation; // without rows: fit.unseen has the errors of tests left out
  const calibrate::ModelFit& fit;
  const TraceOptions& options;
  std::size_t bootstrap = 1000;
  std::uint64_t seed = 1;
  // deliver = all: training and validation together, to which a law with effects is fitted again.
  const data::Dataset* all = nullptr;
  // Where validation tests are searched as well: their places in `training`, as `validation` has
  // them.
  std::vector<std::size_t> searched = {};
};

// An effect that shows in all of E experiments has a p-value of 2^(1-E) at best: how many of them
// it takes to add one, 7 at 0.02. With fewer there are only leads.
double tests_for(double alpha);

// Deterministic by seed for any number of threads. Throws InputError where options name columns
// they do not have.
Trace trace(const TraceInput& input);

} // namespace frictab::trace
