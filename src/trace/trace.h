// Trace stage: finds out whether the residual of a calibrated law has structure, which recorded
// quantity it follows, in which form, and how much better the law predicts with that effect.
//
// Rooms, each of which knows only those before it (docs/tracing.md explains the method):
//   columns   what an effect may follow (a Cause) and the shapes that it may have; columns that the
//             design confounds with a state of the law
//   search    what the residual of the law follows more than by chance. search_effects is the
//   recipe:
//             all terms at once (joint_model: one mixed model; joint_search: terms that enter;
//             joint_choice: those that predict left-out tests; joint: of a campaign), the cause and
//             form of each (choose_effect, by rivals), structure along the order (order_search)
//   judge     what a finding is worth on tests that the search has not seen (nested_errors), which
//             of them are delivered (delivery), what scatter is left, the verdict
//   advise    other effects that may exist (leads), the tests that would settle them (design),
//   curves
// trace.cpp sorts the data by name, searches, judges, delivers, reports. trace_file converts
// results to JSON; tuning.h has the constants of all these steps, with the reasons for their
// values.
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
  double std_error = 0; // by experiment; NaN: not known
  std::string unit;
  std::string why_none; // "at its bound"; empty: it has an error, or is a constant that was set
};

// Another explanation of the same structure in the residual.
struct Alternative {
  std::string name; // "dwell_s x friction_work"
  std::vector<std::string> columns;
  std::string derived; // empty: a recorded column
  std::string form;
  effects::ActsOn acts_on = effects::ActsOn::mu;
  bool in_set = false; // these data cannot distinguish it from the effect
  std::string why_not;
};

// Curve of an effect for plots: its factor over the column, with a band of +-1.96 standard errors,
// and partial residuals of single experiments.
struct EffectCurve {
  std::vector<double> x, factor, low, high;
  std::vector<double> point_x, point_factor; // partial residuals of blocks, binned per experiment
};

// Design::like of tests that only have to be like each other.
inline constexpr const char* like_each_other = "each other, run in this order";

// Tests to run next, which would settle an open question.
struct Design {
  std::vector<std::string> columns;            // columns that the tests vary
  std::vector<std::vector<std::string>> tests; // one value per column; empty: no test settles it
  std::string like;                            // name of the test that gives all other settings
  std::vector<std::string> settles; // causes to distinguish; with one: whether its effect exists
  double probability = 0;           // of settling it, if the effect is as large as fitted
  double tests_needed = 0;          // number of such tests for a probability of 80 %
};

struct TracedEffect {
  effects::PlacedEffect placed;
  std::vector<std::string> columns; // recorded ones
  std::string derived;              // the quantity computed from them
  std::vector<TracedParameter> parameters;
  bool between = false;          // found on one value per test, not on changes within tests
  double p_value = 1;            // family-wise, over all candidates of its family
  double gain_MPa = 0;           // MAE on unseen tests without it (rest refitted) minus with it
  bool order_confounded = false; // a drift over the order of tests would look the same
  Design design; // tests that would decide between it and the alternatives in the set
  std::vector<Alternative> alternatives;
  EffectCurve curve;
};

// nothing_missing: the remaining scatter agrees with a known repeatability | nothing_found: no
// effect passed, and it is not known whether the scatter between tests exceeds repeatability.
enum class Verdict { effect_added, nothing_missing, nothing_found, unexplained_structure };
const char* verdict_name(Verdict verdict);

// Structure along the order of tests that no recorded column explains.
struct OrderStructure {
  bool found = false;
  std::string column;  // column that gives the order; empty: none declared
  double p_value = 1;  // of the null hypothesis "no structure"
  double size_MPa = 0; // root mean square over the training rows
  double share = 0;    // the same, relative to tau_R
  // Relative change of friction from the first test to the last, or at a step; 0: it has no
  // direction.
  double change = 0;
  std::string step;      // "D13 and D14": tests between which friction steps; empty: it does not
  std::string reference; // in the delivered law, the place that documents it
};

// "friction falls by 15 % between tests D13 and D14 (run_order)"; needs structure.
std::string order_text(const OrderStructure& order);

// Smallest effect of a column that would have been detected.
struct Detectable {
  std::string column;
  std::string derived; // empty: recorded
  effects::ActsOn acts_on = effects::ActsOn::mu;
  double size_MPa = 0;      // root mean square over the training rows, found with 80 % probability
  double share = 0;         // relative to tau_R
  bool identifiable = true; // false: recalibration absorbs it, or the column does not vary
};

// An effect that may exist but is not in the law, with the reason.
struct Lead {
  std::string name;                 // "dwell_s x friction_work"
  std::vector<std::string> columns; // recorded ones
  std::string derived;              // the quantity computed from them; empty: none
  std::string form;
  bool between = false;
  double p_value = 1;
  double share = 0;         // change of tau_R over the column's range, relative; 0: not known
  std::string why;          // "no gain on left-out tests (-0.2 +- 0.3 %)"
  Design design;            // for the strongest lead, where tests can settle it
  bool significant = false; // the search found it; a later check rejected it
  // For findings of the search: MAE on the searched tests without and with it. 0: not known.
  double without_MPa = 0, with_MPa = 0;
};

// A column whose effect the tests cannot distinguish from that of a state of the law (aliases.h).
struct Alias {
  std::string column;
  std::string state;
  double share = 0; // share of the state's variance between tests that the column explains
  // sentence with levels and states of the tests, and the test that would separate them
  std::string text;
};

// Whether the validation tests as a whole lie higher or lower than the training tests.
struct ValidationShift {
  bool found = false;
  double shift_MPa = 0;         // validation minus training, mean over tests
  calibrate::Interval interval; // 95 %
  double share = 0;             // relative to tau_R
  double p_value = 1;
};

// Check of the whole search: repeated without some of the tests and judged on those.
struct NestedCheck {
  std::size_t folds = 0; // 0: not run, because nothing was found
  double gain = 0;       // reduction of the mean relative error on left-out tests
  double std_error = 0;  // over tests
  double score = 0;      // gain of the log predictive density, mean over tests
  double score_se = 0;
  std::size_t offered = 0; // effects found by the search on all tests
  // of those, accepted by this check alone; validation tests may add others
  std::size_t paying = 0;
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

// Errors without and with the effects.
struct BeforeAndAfter {
  // Origin of `validation` in the errors below: validation | nested_cross_validation: training
  // tests left out by the nested search, where there are few validation tests | leave_one_out:
  // nothing was found | nothing: one test, so errors of the fit.
  std::string unseen = "validation";
  TraceErrors before; // the same law, fitted with the same weights as `after`
  TraceErrors after;
  calibrate::Difference improvement; // MAE on unseen tests before minus after, paired by experiment
  // The same compared with the calibrated law, which effects must also beat: where a law lacks
  // something, the weights of the trace may cost more than the effects gain. On validation tests
  // only.
  std::optional<calibrate::Difference> over_calibrated;
  NestedCheck nested;
};

struct Trace : BeforeAndAfter {
  std::string model;          // the law that was traced
  std::string extended_model; // name of the law with effects; empty: none was added
  // The law that ranked first and was traced as well, and its errors on the same unseen tests, with
  // effects of its own and before: this law predicts them better, or is simpler and no worse by
  // more than one standard error. Empty: this one ranked first.
  std::string chosen_over;
  double chosen_over_MPa = 0, chosen_over_before_MPa = 0;
  Verdict verdict = Verdict::nothing_found;
  std::vector<TracedEffect> effects;
  TraceErrors as_calibrated; // by the calibration stage; `validation` is always on those tests
  // few validation tests: searched together with the training tests
  bool validation_searched = false;
  ValidationShift validation_shift;
  std::vector<Lead> leads;              // strongest first
  std::vector<Alias> cannot_tell;       // by column
  calibrate::NoiseFloor noise_floor;    // scatter by the noise model, if nothing else is missing
  double scatter_between = 0;           // relative scatter between experiments, standard deviation
  calibrate::Interval scatter_interval; // 95 %
  double scatter_at_least = 0;          // with 95 % confidence; compared with the repeatability
  std::optional<double> repeatability;  // given by the user, or estimated from repeated tests
  std::string repeatability_from;       // given | repeats; empty: not known
  // Relative difference between two halves of the tests, along a column that is constant within
  // tests, that would have been detected with 80 % probability; infinite: none.
  double smallest_seen = 0;
  OrderStructure order;
  Remaining remaining;
  std::vector<Detectable> detectable; // by column
  std::size_t n_candidates = 0, n_columns = 0, n_flips = 0;
  std::vector<std::string> not_identifiable; // candidates that recalibration absorbs
  std::vector<std::string> rejected; // looked significant; with the reason why it was not added
  std::vector<std::string> notes;
  double alpha = TraceOptions{}.alpha;
  double least_p_value = 0;     // the least that so many experiments can give
  calibrate::ModelFit extended; // judged like any other fit; model.law is null where none was added
};

struct TraceInput {
  const data::Dataset& training;   // searched tests
  const data::Dataset& validation; // without rows: errors of left-out tests are in fit.unseen
  const calibrate::ModelFit& fit;
  const TraceOptions& options;
  std::size_t bootstrap = 1000;
  std::uint64_t seed = 1;
  // For deliver = all: training and validation together, to which a law with effects is refitted.
  const data::Dataset* all = nullptr;
  // If validation tests are searched as well: their positions in `training`, in the order of
  // `validation`.
  std::vector<std::size_t> searched = {};
};

// Number of experiments needed to add an effect: one that shows in all of E experiments has a
// p-value of at least 2^(1-E), so 7 at alpha = 0.02. Fewer experiments give only leads.
double tests_for(double alpha);

// Traces the law; deterministic by seed for any number of threads. Throws InputError where options
// name columns that do not exist.
Trace trace(const TraceInput& input);

} // namespace frictab::trace
