// What validation says, to JSON and back.
#include "calibrate/judgement_json.h"

#include <limits>

#include <nlohmann/json.hpp>

#include "core/no_value.h"
#include "io/json.h"

namespace frictab::calibrate {

namespace {

using Json = nlohmann::ordered_json;

Json interval_json(const Interval& interval) {
  return Json::array({interval.low, interval.high});
}

Interval parse_interval(const Json& j) {
  return {number_or_nan(j.at(0)), number_or_nan(j.at(1))};
}

Json difference_json(const Difference& d) {
  return {{"difference_MPa", d.value_MPa},
          {"difference_95", interval_json(d.interval)},
          {"p_value", d.p_value}};
}

Difference parse_difference(const Json& j) {
  return {number_or_nan(j.at("difference_MPa")), parse_interval(j.at("difference_95")),
          number_or_nan(j.at("p_value"))};
}

Json floor_json(const NoiseFloor& f) {
  return {{"method", f.method},
          {"part", f.part},
          {"mae_MPa", f.mae_MPa},
          {"rmse_MPa", f.rmse_MPa},
          {"mae_95", interval_json(f.mae_interval)},
          {"rmse_95", interval_json(f.rmse_interval)},
          {"n_rows", f.n_rows},
          {"n_experiments", f.n_experiments},
          {"n_groups", f.n_groups},
          {"lower_bound", f.lower_bound},
          {"lowered_from_MPa", f.measured_MPa > 0 ? Json(f.measured_MPa) : Json()},
          {"synthetic_only", f.method == "oracle"}};
}

NoiseFloor parse_floor(const Json& j) {
  return {j.at("method"),
          j.at("part"),
          number_or_nan(j.at("mae_MPa")),
          number_or_nan(j.at("rmse_MPa")),
          parse_interval(j.at("mae_95")),
          parse_interval(j.at("rmse_95")),
          io::count_of(j.at("n_rows")),
          io::count_of(j.at("n_experiments")),
          io::count_of(j.at("n_groups")),
          j.at("lower_bound"),
          j.contains("lowered_from_MPa") && !j.at("lowered_from_MPa").is_null()
              ? j.at("lowered_from_MPa").get<double>()
              : 0};
}

Json conditional_fit_json(const ConditionalFit& fit) {
  return {{"name", fit.law},
          {"usual_gain_of_first_part", fit.usual_first},
          {"usual_gain_of_rest", fit.usual_rest},
          {"gain_between_experiments_sd", fit.between_sd},
          {"gain_error_sd", fit.error_sd},
          {"trust", fit.trust},
          {"unconditional", metrics_json(fit.unconditional)},
          {"conditional", metrics_json(fit.conditional)},
          {"gain", difference_json(fit.gain)}};
}

ConditionalFit parse_conditional_fit(const Json& j) {
  return {j.at("name"),
          number_or_nan(j.at("usual_gain_of_first_part")),
          number_or_nan(j.at("usual_gain_of_rest")),
          number_or_nan(j.at("gain_between_experiments_sd")),
          number_or_nan(j.at("gain_error_sd")),
          number_or_nan(j.at("trust")),
          parse_metrics(j.at("unconditional")),
          parse_metrics(j.at("conditional")),
          parse_difference(j.at("gain"))};
}

} // namespace

double number_or_nan(const Json& value) {
  return value.is_null() ? no_value : value.get<double>();
}

Json metrics_json(const Metrics& m) {
  return {{"mae_MPa", m.mae_MPa},
          {"rmse_MPa", m.rmse_MPa},
          {"bias_MPa", m.bias_MPa},
          {"mae_95", interval_json(m.mae_interval)},
          {"rmse_95", interval_json(m.rmse_interval)},
          {"bias_95", interval_json(m.bias_interval)},
          {"n_rows", m.n_rows},
          {"n_experiments", m.n_experiments}};
}

Metrics parse_metrics(const Json& j) {
  return {number_or_nan(j.at("mae_MPa")),  number_or_nan(j.at("rmse_MPa")),
          number_or_nan(j.at("bias_MPa")), parse_interval(j.at("mae_95")),
          parse_interval(j.at("rmse_95")), parse_interval(j.at("bias_95")),
          io::count_of(j.at("n_rows")),    io::count_of(j.at("n_experiments"))};
}

const char* judged_by_name(JudgedBy judged_by) {
  switch (judged_by) {
  case JudgedBy::leave_one_out:
    return "leave_one_out";
  case JudgedBy::held_out:
    return "held_out";
  case JudgedBy::fit:
    return "fit";
  case JudgedBy::validation_files:
    break;
  }
  return "validation_files";
}

bool on_other_experiments(JudgedBy judged_by) {
  return judged_by == JudgedBy::held_out || judged_by == JudgedBy::validation_files;
}

JudgedBy parse_judged_by(const std::string& name) {
  for (const JudgedBy one : {JudgedBy::leave_one_out, JudgedBy::held_out, JudgedBy::fit})
    if (name == judged_by_name(one)) return one;
  return JudgedBy::validation_files;
}

Json unseen_json(const std::vector<ExperimentError>& errors) {
  if (errors.empty()) return nullptr;
  Json j = {{"n_rows", {}}, {"mae_MPa", {}}, {"rmse_MPa", {}}, {"bias_MPa", {}}, {"gain", {}}};
  for (const ExperimentError& one : errors) {
    j["n_rows"].push_back(one.n_rows);
    j["mae_MPa"].push_back(one.mae_MPa);
    j["rmse_MPa"].push_back(one.rmse_MPa);
    j["bias_MPa"].push_back(one.bias_MPa);
    j["gain"].push_back(one.gain);
  }
  return j;
}

std::vector<ExperimentError> parse_unseen(const Json& j,
                                          const std::vector<std::string>& experiments) {
  std::vector<ExperimentError> errors;
  for (std::size_t e = 0; !j.is_null() && e < experiments.size(); ++e)
    errors.push_back({experiments[e], true, io::count_of(j.at("n_rows").at(e)),
                      number_or_nan(j.at("mae_MPa").at(e)), number_or_nan(j.at("rmse_MPa").at(e)),
                      number_or_nan(j.at("bias_MPa").at(e)), number_or_nan(j.at("gain").at(e))});
  return errors;
}

Json determination_json(const Determination& d) {
  Json pairs = Json::array(), open = Json::array();
  for (const Determination::Pair& pair : d.pairs)
    pairs.push_back({{"parameters", {pair.one, pair.other}}, {"correlation", pair.correlation}});
  for (const Determination::Open& one : d.not_determined)
    open.push_back({{"parameters", one.parameters}, {"why", one.text}});
  return {{"meaning", "condition_number: of the curvature, its diagonal scaled to 1; null: "
                      "determined only in combination; worst_pairs: correlations by the design, "
                      "where all rows scatter alike"},
          {"condition_number", d.condition},
          {"worst_pairs", pairs},
          {"not_determined", open}};
}

Determination parse_determination(const Json& j) {
  Determination d;
  const Json& condition = j.at("condition_number");
  d.condition =
      condition.is_null() ? std::numeric_limits<double>::infinity() : condition.get<double>();
  for (const Json& pair : j.at("worst_pairs"))
    d.pairs.push_back({pair.at("parameters").at(0), pair.at("parameters").at(1),
                       number_or_nan(pair.at("correlation"))});
  for (const Json& one : j.at("not_determined"))
    d.not_determined.push_back(
        {one.at("parameters").get<std::vector<std::string>>(), one.at("why")});
  return d;
}

Json influence_json(const std::vector<Influence>& influence) {
  Json list = Json::array();
  for (const Influence& one : influence) {
    Json moved = Json::array();
    for (const Influence::Moved& m : one.moved)
      moved.push_back({{"parameter", m.parameter},
                       {"value", m.value},
                       {"without", m.without},
                       {"std_error", m.std_error}});
    list.push_back({{"law", one.law},
                    {"experiment", one.experiment},
                    {"moved", moved},
                    {"first_without", one.first.empty() ? Json() : Json(one.first)}});
  }
  return list;
}

std::vector<Influence> parse_influence(const Json& j) {
  std::vector<Influence> influence;
  for (const Json& one : j) {
    Influence& i = influence.emplace_back();
    i.law = one.at("law");
    i.experiment = one.at("experiment");
    for (const Json& m : one.at("moved"))
      i.moved.push_back({m.at("parameter"), number_or_nan(m.at("value")),
                         number_or_nan(m.at("without")), number_or_nan(m.at("std_error"))});
    if (!one.at("first_without").is_null()) i.first = one.at("first_without");
  }
  return influence;
}

Json choice_json(const Choice& c) {
  if (c.draws == 0) return nullptr;
  Json shares = Json::array();
  for (const Choice::Share& one : c.best_in)
    shares.push_back({{"name", one.law}, {"share", one.share}});
  return {{"meaning", "the best law's error is of the tests that chose it; expected_mae_MPa: the "
                      "best of resampled tests, on the tests that are not in the resample"},
          {"law", c.law},
          {"mae_MPa", c.mae_MPa},
          {"expected_mae_MPa", c.expected_mae_MPa},
          {"draws", c.draws},
          {"drawn", c.splits ? "splits" : "resampled_tests"},
          {"best_in", shares}};
}

Choice parse_choice(const Json& j) {
  Choice c;
  if (j.is_null()) return c;
  c.law = j.at("law");
  c.mae_MPa = number_or_nan(j.at("mae_MPa"));
  c.expected_mae_MPa = number_or_nan(j.at("expected_mae_MPa"));
  c.draws = io::count_of(j.at("draws"));
  c.splits = j.at("drawn") == "splits";
  for (const Json& one : j.at("best_in"))
    c.best_in.push_back({one.at("name"), number_or_nan(one.at("share"))});
  return c;
}

Json recommended_json(const Recommended& r) {
  if (r.law.empty()) return nullptr;
  return {{"meaning", "the law of fewest fitted numbers that is not worse than the best by more "
                      "than one standard error on unseen tests, paired by experiment"},
          {"law", r.law},
          {"best", r.best},
          {"numbers", r.numbers},
          {"numbers_of_best", r.numbers_of_best},
          {"behind_MPa", r.behind_MPa},
          {"std_error_MPa", r.std_error_MPa}};
}

Recommended parse_recommended(const Json& j) {
  if (j.is_null()) return {};
  return {j.at("law"),
          j.at("best"),
          io::count_of(j.at("numbers")),
          io::count_of(j.at("numbers_of_best")),
          number_or_nan(j.at("behind_MPa")),
          number_or_nan(j.at("std_error_MPa"))};
}

Json comparisons_json(const Comparisons& c) {
  Json pairs = Json::array(), laws = Json::array();
  for (const Comparison& pair : c.pairs)
    pairs.push_back({{"law", pair.law},
                     {"other", pair.other},
                     {"mae", difference_json(pair.mae)},
                     {"rmse", difference_json(pair.rmse)},
                     {"verdict", pair.mae.distinguishable() ? "better" : "not distinguishable"}});
  for (std::size_t i = 0; i < c.laws.size(); ++i)
    laws.push_back({{"name", c.laws[i]},
                    {"p_value", c.best_p_values[i]},
                    {"may_be_best", c.best_p_values[i] >= 0.05}});
  return {{"meaning", "differences: other minus law; intervals and p-values per pair, paired by "
                      "experiment; best_of_all: for all laws together, null: no candidate"},
          {"n_experiments", c.n_experiments},
          {"resamples", c.resamples},
          {"best_of_all", laws},
          {"pairs", pairs}};
}

Comparisons parse_comparisons(const Json& j) {
  Comparisons c;
  c.n_experiments = io::count_of(j.at("n_experiments"));
  c.resamples = io::count_of(j.at("resamples"));
  for (const Json& law : j.at("best_of_all")) {
    c.laws.push_back(law.at("name"));
    c.best_p_values.push_back(number_or_nan(law.at("p_value")));
  }
  for (const Json& pair : j.at("pairs"))
    c.pairs.push_back({pair.at("law"), pair.at("other"), parse_difference(pair.at("mae")),
                       parse_difference(pair.at("rmse"))});
  return c;
}

Json noise_floors_json(const std::vector<NoiseFloor>& floors) {
  if (floors.empty()) return nullptr;
  Json first = floor_json(floors.front());
  first["also"] = Json::array();
  for (std::size_t i = 1; i < floors.size(); ++i)
    first["also"].push_back(floor_json(floors[i]));
  return first;
}

std::vector<NoiseFloor> parse_noise_floors(const Json& j) {
  if (j.is_null()) return {};
  std::vector<NoiseFloor> floors = {parse_floor(j)};
  for (const Json& other : j.at("also"))
    floors.push_back(parse_floor(other));
  return floors;
}

Json conditional_json(const Conditional& c) {
  if (c.laws.empty()) return nullptr;
  Json laws = Json::array();
  for (const ConditionalFit& fit : c.laws)
    laws.push_back(conditional_fit_json(fit));
  return {{"meaning", "uses the first part of every test to predict its rest; not to be ranked "
                      "with unconditional laws; errors on rows beyond condition_on_mm only"},
          {"condition_on_mm", c.condition_on_mm},
          {"usual_rows", c.usual_rows},
          {"n_experiments", c.n_experiments},
          {"n_without_start", c.n_without_start},
          {"n_without_rest", c.n_without_rest},
          {"models", laws}};
}

Conditional parse_conditional(const Json& j) {
  Conditional c;
  if (j.is_null()) return c;
  c.condition_on_mm = number_or_nan(j.at("condition_on_mm"));
  c.usual_rows = io::count_of(j.at("usual_rows"));
  c.n_experiments = io::count_of(j.at("n_experiments"));
  c.n_without_start = io::count_of(j.at("n_without_start"));
  c.n_without_rest = io::count_of(j.at("n_without_rest"));
  for (const Json& law : j.at("models"))
    c.laws.push_back(parse_conditional_fit(law));
  return c;
}

} // namespace frictab::calibrate
