// Results of validation as plain values: errors with intervals, comparisons of laws, the noise
// floor, and conditional use. Stresses in MPa. The experiment is the unit of every interval and
// every p-value.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stats/interval.h"
#include "stats/resampling.h"

namespace frictab::calibrate {

using stats::Interval;

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

// Experiments on which errors of prediction are computed. leave_one_out: every experiment, by the
// law fitted to all others; held_out: a random share; validation_files: separate files; fit: the
// only experiment, to which the laws are fitted.
enum class JudgedBy { leave_one_out, held_out, validation_files, fit };
const char* judged_by_name(JudgedBy judged_by); // "leave_one_out"
// Whether laws are judged on experiments other than those they are fitted to.
bool on_other_experiments(JudgedBy judged_by);

// Errors of one law on one experiment.
struct ExperimentError {
  std::string experiment;
  bool held_out = false; // the law was fitted without it
  std::size_t n_rows = 0;
  double mae_MPa = 0;
  double rmse_MPa = 0;
  double bias_MPa = 0; // mean of measured minus predicted
  double gain = 0; // factor of the law that fits this test best; NaN: the law predicts no stress
  std::size_t recording = stats::no_recording; // kept out of files
};

// Difference between two errors on the same experiments.
struct Difference {
  double value_MPa = 0;
  Interval interval;  // 95 %, of this one difference
  double p_value = 1; // two-sided
  bool distinguishable() const { return p_value < 0.05; }
};

// Comparison of two laws, where `law` precedes `other` in the ranking. Differences are other minus
// law: positive if `law` is better.
struct Comparison {
  std::string law;
  std::string other;
  Difference mae;
  Difference rmse;
};

struct Comparisons {
  std::vector<Comparison> pairs; // (1,2), (1,3), ..., (2,3), ... by rank; empty: not compared
  std::vector<std::string> laws; // by rank
  // Per law, of "no candidate has a smaller MAE", jointly for all candidates; NaN: not a candidate.
  std::vector<double> best_p_values;
  std::size_t n_experiments = 0;
  std::size_t resamples = 0;
};

// Optimism of the selected law: the first law of a ranking is first also by chance, so its error on
// the tests that ranked it is too small on average.
struct Choice {
  std::string law;
  double mae_MPa = 0;          // on the tests that selected it
  double expected_mae_MPa = 0; // on new tests, for a law selected in this way
  struct Share {
    std::string law;
    double share = 0; // share of the draws in which it is the best
  };
  std::vector<Share> best_in; // by rank
  std::size_t draws = 0;      // 0: not known (fewer than 2 laws or 2 tests, or no resamples)
  bool splits = false;        // best_in: over splits of all tests, else over resampled tests
};

// Error of a law on new tests.
struct Expected {
  double mae_MPa = 0;
  Interval interval; // 95 %, over tests
};

// The simplest law whose error exceeds that of the best by at most one standard error.
struct Recommended {
  std::string law; // empty: no tests judge the laws
  std::string best;
  std::size_t numbers = 0; // number of fitted quantities: parameters, weights, terms
  std::size_t numbers_of_best = 0;
  double behind_MPa = 0;    // MAE on unseen tests minus that of the best law
  double std_error_MPa = 0; // of that difference, paired by experiment
  // Number of tests, left out in turn, over which this was decided; 0: those that judge the laws.
  std::size_t tests = 0;
  Expected expected; // for a law chosen by this rule
  // Candidates that the same tests cannot distinguish from it: worse by less than two standard
  // errors.
  std::vector<std::string> as_good = {};
};

// Parameters that the design of the tests leaves open (determined.h).
struct Determination {
  double condition = 0; // Uncertainty::condition
  struct Pair {
    std::string one, other;
    double correlation = 0;
  };
  std::vector<Pair> pairs; // those correlated most
  struct Open {
    std::vector<std::string> parameters;
    std::string text; // "a = -0.16 +- 0.43: these tests do not determine it; ..."
  };
  std::vector<Open> not_determined;
};

// Effect of leaving out one test on a law (influence.h).
struct Influence {
  std::string law;
  std::string experiment;
  struct Moved {
    std::string parameter;
    double value = 0, without = 0, std_error = 0;
  };
  std::vector<Moved> moved; // by more than their standard error, largest shift first
  std::string first;        // law that leads the ranking without it; empty: unchanged
};

// Remaining error of a law that is exact in the state.
struct NoiseFloor : Metrics {
  std::string method = {};  // oracle | replicates | within_experiments
  std::string part = {};    // validation | training | all
  std::size_t n_groups = 0; // replicates: groups of experiments with the same set levels
  bool lower_bound = false; // the scatter between experiments is not included
  // original MAE if it exceeded the best law's error, to which the floor was lowered
  double measured_MPa = 0;
};

// A law with one gain per experiment, predicted from that experiment's own first millimetres.
struct ConditionalFit {
  std::string law;
  double usual_first = 1; // mean gain of the first parts of the training experiments
  double usual_rest = 1;  // mean gain of their rests
  double between_sd = 0;  // of the gain, between training experiments
  double error_sd = 0;    // of a gain from the first part alone, for the median number of rows
  double trust = 0;       // weight of a first part's deviation from the mean, for those rows
  Metrics unconditional;  // on the same rows without the gain
  Metrics conditional;
  Difference gain; // MAE unconditional minus conditional
};

struct Conditional {
  double condition_on_mm = 0; // 0: not requested
  std::size_t usual_rows = 0; // median number of rows in the first part, training
  std::size_t n_experiments = 0;
  std::size_t n_without_start = 0;  // validation experiments without a row in the first part
  std::size_t n_without_rest = 0;   // without a row beyond it: not judged
  std::vector<ConditionalFit> laws; // by conditional MAE
};

} // namespace frictab::calibrate
