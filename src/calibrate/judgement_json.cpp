// Converts results of validation to JSON and back.
#include "calibrate/judgement_json.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/no_value.h"
#include "io/json_fields.h"

namespace frictab::calibrate {

using io::Fields;

void describe(Fields& f, Metrics& m) {
  f("mae_MPa", m.mae_MPa);
  f("rmse_MPa", m.rmse_MPa);
  f("bias_MPa", m.bias_MPa);
  f("mae_95", m.mae_interval);
  f("rmse_95", m.rmse_interval);
  f("bias_95", m.bias_interval);
  f("n_rows", m.n_rows);
  f("n_experiments", m.n_experiments);
}

static const std::initializer_list<std::pair<const char*, JudgedBy>> judged_by_names = {
    {"leave_one_out", JudgedBy::leave_one_out},
    {"held_out", JudgedBy::held_out},
    {"fit", JudgedBy::fit},
    {"validation_files", JudgedBy::validation_files}};

const char* judged_by_name(JudgedBy judged_by) {
  return std::ranges::find(judged_by_names, judged_by, &std::pair<const char*, JudgedBy>::second)
      ->first;
}

bool on_other_experiments(JudgedBy judged_by) {
  return judged_by == JudgedBy::held_out || judged_by == JudgedBy::validation_files;
}

void describe_judged_by(Fields& f, const char* key, JudgedBy& judged_by) {
  f.one_of(key, judged_by, judged_by_names, {JudgedBy::validation_files});
}

void describe_unseen(Fields& f, std::vector<ExperimentError>& errors,
                     const std::vector<std::string>& experiments) {
  if (f.null(errors.empty())) return;
  if (f.reads())
    for (const std::string& experiment : experiments)
      errors.push_back({experiment, true});
  const auto column = [&](const char* key, auto ExperimentError::*number) {
    f.within(key, [&](Fields& list) {
      for (std::size_t e = 0; e < errors.size(); ++e)
        list.item(e, errors[e].*number);
    });
  };
  column("n_rows", &ExperimentError::n_rows);
  column("mae_MPa", &ExperimentError::mae_MPa);
  column("rmse_MPa", &ExperimentError::rmse_MPa);
  column("bias_MPa", &ExperimentError::bias_MPa);
  column("gain", &ExperimentError::gain);
}

static void describe(Fields& f, Determination::Pair& pair) {
  f.within("parameters", [&](Fields& both) {
    both.item(0, pair.one);
    both.item(1, pair.other);
  });
  f("correlation", pair.correlation);
}

static void describe(Fields& f, Determination::Open& open) {
  f("parameters", open.parameters);
  f("why", open.text);
}

void describe(Fields& f, Determination& d) {
  f.only_written("meaning",
                 "condition_number: of the curvature, its diagonal scaled to 1; null: "
                 "determined only in combination; worst_pairs: correlations by the design, "
                 "where all rows scatter alike");
  f("condition_number", d.condition);
  if (f.reads() && std::isnan(d.condition)) d.condition = std::numeric_limits<double>::infinity();
  f("worst_pairs", d.pairs);
  f("not_determined", d.not_determined);
}

static void describe(Fields& f, Influence::Moved& moved) {
  f("parameter", moved.parameter);
  f("value", moved.value);
  f("without", moved.without);
  f("std_error", moved.std_error);
}

void describe(Fields& f, Influence& i) {
  f("law", i.law);
  f("experiment", i.experiment);
  f("moved", i.moved);
  f.null_if_empty("first_without", i.first);
}

static void describe(Fields& f, Choice::Share& share) {
  f("name", share.law);
  f("share", share.share);
}

void describe(Fields& f, Choice& c) {
  if (f.null(c.draws == 0)) return;
  f.only_written("meaning",
                 "the best law's error is of the tests that chose it; expected_mae_MPa: the "
                 "best of resampled tests, on the tests that are not in the resample");
  f("law", c.law);
  f("mae_MPa", c.mae_MPa);
  f("expected_mae_MPa", c.expected_mae_MPa);
  f("draws", c.draws);
  f.one_of("drawn", c.splits, {{"splits", true}, {"resampled_tests", false}}, {false});
  f("best_in", c.best_in);
}

void describe(Fields& f, Recommended& r) {
  if (f.null(r.law.empty())) return;
  f.only_written("meaning",
                 "the law of fewest fitted numbers that is not worse than the best by more "
                 "than one standard error on unseen tests, paired by experiment");
  f("law", r.law);
  f("best", r.best);
  f("numbers", r.numbers);
  f("numbers_of_best", r.numbers_of_best);
  f("behind_MPa", r.behind_MPa);
  f("std_error_MPa", r.std_error_MPa);
  f.unless_default("tests_left_out_in_turn", r.tests);
  if (f.has("as_good", true)) f("as_good", r.as_good); // not in files of 0.2.0
  if (!f.has("expected_mae_MPa", true)) return;        // not in files of 0.1 and 0.2.0
  f("expected_mae_MPa", r.expected.mae_MPa);
  f("expected_mae_95", r.expected.interval);
}

static void describe(Fields& f, Difference& d) {
  f("difference_MPa", d.value_MPa);
  f("difference_95", d.interval);
  f("p_value", d.p_value);
}

static void describe(Fields& f, Comparison& pair) {
  f("law", pair.law);
  f("other", pair.other);
  f("mae", pair.mae);
  f("rmse", pair.rmse);
  f.only_written("verdict", pair.mae.distinguishable() ? "better" : "not distinguishable");
}

void describe(Fields& f, Comparisons& c) {
  f.only_written("meaning",
                 "differences: other minus law; intervals and p-values per pair, paired by "
                 "experiment; best_of_all: for all laws together, null: no candidate");
  f("n_experiments", c.n_experiments);
  f("resamples", c.resamples);
  if (f.reads()) {
    c.laws.resize(f.json().at("best_of_all").size());
    c.best_p_values.resize(c.laws.size());
  }
  f.each("best_of_all", c.laws.size(), [&](Fields& one, std::size_t i) {
    one("name", c.laws[i]);
    one("p_value", c.best_p_values[i]);
    one.only_written("may_be_best", c.best_p_values[i] >= 0.05);
  });
  f("pairs", c.pairs);
}

static void describe(Fields& f, NoiseFloor& floor) {
  f("method", floor.method);
  f("part", floor.part);
  f("mae_MPa", floor.mae_MPa);
  f("rmse_MPa", floor.rmse_MPa);
  f("mae_95", floor.mae_interval);
  f("rmse_95", floor.rmse_interval);
  f("n_rows", floor.n_rows);
  f("n_experiments", floor.n_experiments);
  f("n_groups", floor.n_groups);
  f("lower_bound", floor.lower_bound);
  double measured = floor.measured_MPa > 0 ? floor.measured_MPa : no_value;
  if (f.has("lowered_from_MPa", true)) f("lowered_from_MPa", measured);
  if (f.reads()) floor.measured_MPa = std::isnan(measured) ? 0 : measured;
  f.only_written("synthetic_only", floor.method == "oracle");
}

void describe_noise_floors(Fields& f, std::vector<NoiseFloor>& floors) {
  if (f.null(floors.empty())) return;
  if (f.reads()) floors.resize(1 + f.json().at("also").size());
  describe(f, floors.front());
  f.each("also", floors.size() - 1,
         [&](Fields& other, std::size_t i) { describe(other, floors[i + 1]); });
}

static void describe(Fields& f, ConditionalFit& fit) {
  f("name", fit.law);
  f("usual_gain_of_first_part", fit.usual_first);
  f("usual_gain_of_rest", fit.usual_rest);
  f("gain_between_experiments_sd", fit.between_sd);
  f("gain_error_sd", fit.error_sd);
  f("trust", fit.trust);
  f("unconditional", fit.unconditional);
  f("conditional", fit.conditional);
  f("gain", fit.gain);
}

void describe(Fields& f, Conditional& c) {
  if (f.null(c.laws.empty())) return;
  f.only_written("meaning",
                 "uses the first part of every test to predict its rest; not to be ranked "
                 "with unconditional laws; errors on rows beyond condition_on_mm only");
  f("condition_on_mm", c.condition_on_mm);
  f("usual_rows", c.usual_rows);
  f("n_experiments", c.n_experiments);
  f("n_without_start", c.n_without_start);
  f("n_without_rest", c.n_without_rest);
  f("models", c.laws);
}

} // namespace frictab::calibrate
