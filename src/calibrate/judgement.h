// What validation says about calibrated laws, as plain values: errors with intervals, which law is
// better than which, the noise floor, and conditional use. Stresses in MPa. The experiment is the
// unit of every interval and every p-value.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/resampling.h"

namespace frictab::calibrate {

struct Interval {
  double low = 0;
  double high = 0;
};

// Errors of prediction: residual = tau_meas - tau_pred (the paper's sign). 95 % intervals by
// resampling whole experiments.
struct Metrics {
  double mae_MPa = 0;
  double rmse_MPa = 0;
  double bias_MPa = 0; // mean residual
  Interval mae_interval;
  Interval rmse_interval;
  Interval bias_interval;
  std::size_t n_rows = 0;
  std::size_t n_experiments = 0;
};

// What the errors of prediction were taken on. leave_one_out: every experiment, by the law fitted
// to all others; held_out: a share that was drawn; validation_files: files of their own; fit: the
// one experiment there is, to which the laws are fitted.
enum class JudgedBy { leave_one_out, held_out, validation_files, fit };
const char* judged_by_name(JudgedBy judged_by); // "leave_one_out"
// Whether the judged experiments are not those that the laws are fitted to.
bool on_other_experiments(JudgedBy judged_by);

// One law on one experiment.
struct ExperimentError {
  std::string experiment;
  bool held_out = false; // the law was fitted without it
  std::size_t n_rows = 0;
  double mae_MPa = 0;
  double rmse_MPa = 0;
  double bias_MPa = 0; // mean of measured minus predicted
  double gain = 0;     // factor of the law that fits this test best; NaN: it predicts no stress
  std::size_t recording = no_recording; // kept out of files
};

// How far two errors on the same experiments are apart.
struct Difference {
  double value_MPa = 0;
  Interval interval;  // 95 %, of this one difference
  double p_value = 1; // two-sided
  bool distinguishable() const { return p_value < 0.05; }
};

// `law` stands before `other` in the ranking; differences are other minus law: positive where `law`
// is better.
struct Comparison {
  std::string law;
  std::string other;
  Difference mae;
  Difference rmse;
};

struct Comparisons {
  std::vector<Comparison> pairs; // (1,2), (1,3), ..., (2,3), ... by rank; empty: not compared
  std::vector<std::string> laws; // by rank
  // Per law: of "no law has a smaller MAE", for all candidates together; NaN: no candidate.
  std::vector<double> best_p_values;
  std::size_t n_experiments = 0;
  std::size_t resamples = 0;
};

// The first law of a ranking is first also by luck: its error on the tests that ranked it is too
// small on average.
struct Choice {
  std::string law;
  double mae_MPa = 0;          // of the tests that chose it
  double expected_mae_MPa = 0; // of new tests, by a law that is chosen like this
  struct Share {
    std::string law;
    double share = 0; // of the draws in which it is the best
  };
  std::vector<Share> best_in; // by rank
  std::size_t draws = 0;      // 0: not known, with less than 2 laws, 2 tests or a resample
  bool splits = false;        // best_in: of splits of all tests, else of resampled tests
};

// The simplest law that is not worse than the best by more than one standard error.
struct Recommended {
  std::string law; // empty: nothing judges the laws
  std::string best;
  std::size_t numbers = 0; // that fitting it has found: parameters, weights, terms
  std::size_t numbers_of_best = 0;
  double behind_MPa = 0;    // MAE on unseen tests beyond that of the best law
  double std_error_MPa = 0; // of that difference, paired by experiment
};

// What the design of the tests leaves open of a law's parameters (determined.h).
struct Determination {
  double condition = 0; // Uncertainty::condition
  struct Pair {
    std::string one, other;
    double correlation = 0;
  };
  std::vector<Pair> pairs; // the two that are correlated most
  struct Open {
    std::vector<std::string> parameters;
    std::string text; // "a = -0.16 +- 0.43: these tests do not determine it; ..."
  };
  std::vector<Open> not_determined;
};

// What one test, left out, does to a law (influence.h).
struct Influence {
  std::string law;
  std::string experiment;
  struct Moved {
    std::string parameter;
    double value = 0, without = 0, std_error = 0;
  };
  std::vector<Moved> moved; // by more than their standard error, the furthest first
  std::string first;        // the law that leads the ranking without it; empty: the same
};

// How much error is left where a law of the state is exact.
struct NoiseFloor {
  std::string method; // oracle | replicates | within_experiments
  std::string part;   // validation | training | all
  double mae_MPa = 0;
  double rmse_MPa = 0;
  Interval mae_interval;
  Interval rmse_interval;
  std::size_t n_rows = 0;
  std::size_t n_experiments = 0;
  std::size_t n_groups = 0; // replicates: groups of experiments with the same set levels
  bool lower_bound = false; // the scatter between experiments is not in it
  double measured_MPa = 0;  // MAE where it is more than the best law errs, to which it is lowered
};

// A law with one gain per experiment, predicted from that experiment's own first millimetres.
struct ConditionalFit {
  std::string law;
  double usual_first = 1; // mean gain of the first parts of the training experiments
  double usual_rest = 1;  // and of their rests
  double between_sd = 0;  // of the gain, between training experiments
  double error_sd = 0;    // of a gain from the first part alone, for the usual number of rows
  double trust = 0;       // used share of a first part's deviation from the usual, for those rows
  Metrics unconditional;  // the same rows without the gain
  Metrics conditional;
  Difference gain; // MAE unconditional minus conditional
};

struct Conditional {
  double condition_on_mm = 0; // 0: not asked for
  std::size_t usual_rows = 0; // median number of rows in the first part, training
  std::size_t n_experiments = 0;
  std::size_t n_without_start = 0;  // validation experiments without a row in the first part
  std::size_t n_without_rest = 0;   // without a row beyond it: not judged
  std::vector<ConditionalFit> laws; // by conditional MAE
};

} // namespace frictab::calibrate
