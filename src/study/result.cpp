// Converts results from a pipeline to JSON and back.
#include "study/result.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "calibrate/judgement_json.h"
#include "core/no_value.h"
#include "core/text.h"
#include "core/version.h"
#include "effects/effect.h"
#include "io/json.h"

namespace frictab::study {

using Json = nlohmann::ordered_json;
using calibrate::number_or_nan;

namespace {

constexpr const char* schema = "frictab/study-result/1";

double best_p_value(const calibrate::Comparisons& comparisons, const std::string& law) {
  const auto at = std::find(comparisons.laws.begin(), comparisons.laws.end(), law);
  const auto i = static_cast<std::size_t>(at - comparisons.laws.begin());
  return i < comparisons.best_p_values.size() ? comparisons.best_p_values[i] : no_value;
}

// A trained law has none: its numbers are part of its formula.
std::vector<FittedParameter> parameters_of(const calibrate::ModelFit& fit) {
  const models::Law& law = *fit.model.law;
  std::vector<FittedParameter> parameters;
  if (models::is_trained(law.calibrated)) return parameters;
  const std::size_t n = std::min(law.parameters.size(), fit.model.parameters.size());
  for (std::size_t i = 0; i < n; ++i)
    parameters.push_back({law.parameters[i].name, law.parameters[i].unit, fit.model.parameters[i],
                          i < fit.std_error.size() ? fit.std_error[i] : no_value});
  return parameters;
}

LawResult law_of(const calibrate::ModelFit& fit, const calibrate::Comparisons& comparisons) {
  const models::Law& law = *fit.model.law;
  const calibrate::Metrics& v = fit.validation;
  return {law.name,
          law.calibrated == models::Calibrated::fit,
          v.mae_MPa,
          v.rmse_MPa,
          v.bias_MPa,
          v.mae_interval,
          best_p_value(comparisons, law.name),
          fit.band.low,
          fit.band.high,
          parameters_of(fit)};
}

std::string cause_of(const trace::TracedEffect& effect) {
  return effect.derived.empty() ? join(effect.columns, " x ") : effect.derived;
}

} // namespace

CampaignResult result_of(const calibrate::Calibration& calibration, const run::JobData& data) {
  CampaignResult result;
  result.data_hash = calibration.data_hash;
  result.judged_by = calibrate::judged_by_name(calibration.judged_by);
  result.synthetic = calibration.synthetic;
  result.experiments = data.training.experiments.size() + data.validation.experiments.size();
  result.rows = data.training.rows_behind() + data.validation.rows_behind();
  for (const calibrate::ModelFit& fit : calibration.fits)
    result.laws.push_back(law_of(fit, calibration.comparisons));
  return result;
}

void add_effects(CampaignResult& result, const std::vector<trace::Trace>& traces) {
  result.traced = true;
  for (const trace::Trace& trace : traces)
    for (const trace::TracedEffect& effect : trace.effects)
      result.effects.push_back({trace.model, cause_of(effect), effect.placed.form->name,
                                effects::acts_on_name(effect.placed.acts_on), effect.p_value,
                                effect.gain_MPa});
}

namespace {

Json law_json(const LawResult& law) {
  Json json = {{"law", law.law},
               {"fitted", law.fitted},
               {"mae_MPa", law.mae_MPa},
               {"mae_interval_MPa", {law.mae_interval.low, law.mae_interval.high}},
               {"rmse_MPa", law.rmse_MPa},
               {"bias_MPa", law.bias_MPa},
               {"best_p_value", law.best_p_value},
               {"parameters", Json::array()}};
  if (law.band_low && law.band_high) json["band"] = {*law.band_low, *law.band_high};
  for (const FittedParameter& p : law.parameters)
    json["parameters"].push_back(
        {{"name", p.name}, {"value", p.value}, {"std_error", p.std_error}, {"unit", p.unit}});
  return json;
}

LawResult parse_law(const Json& json) {
  LawResult law;
  law.law = json.at("law");
  law.fitted = json.at("fitted");
  law.mae_MPa = number_or_nan(json.at("mae_MPa"));
  law.mae_interval = {number_or_nan(json.at("mae_interval_MPa").at(0)),
                      number_or_nan(json.at("mae_interval_MPa").at(1))};
  law.rmse_MPa = number_or_nan(json.at("rmse_MPa"));
  law.bias_MPa = number_or_nan(json.at("bias_MPa"));
  law.best_p_value = number_or_nan(json.at("best_p_value"));
  if (json.contains("band")) {
    law.band_low = json.at("band").at(0).get<double>();
    law.band_high = json.at("band").at(1).get<double>();
  }
  for (const Json& p : json.at("parameters"))
    law.parameters.push_back({p.at("name"), p.at("unit"), number_or_nan(p.at("value")),
                              number_or_nan(p.at("std_error"))});
  return law;
}

Json effect_json(const EffectResult& effect) {
  return {{"law", effect.law},         {"column", effect.column},   {"form", effect.form},
          {"acts_on", effect.acts_on}, {"p_value", effect.p_value}, {"gain_MPa", effect.gain_MPa}};
}

EffectResult parse_effect(const Json& json) {
  return {json.at("law"),
          json.at("column"),
          json.at("form"),
          json.at("acts_on"),
          number_or_nan(json.at("p_value")),
          number_or_nan(json.at("gain_MPa"))};
}

void read_result(const Json& json, CampaignResult& result) {
  result.data_hash = json.at("data");
  result.judged_by = json.at("judged_by");
  result.synthetic = json.at("synthetic_data");
  result.experiments = io::count_of(json.at("experiments"));
  result.rows = io::count_of(json.at("rows"));
  for (const Json& law : json.at("laws"))
    result.laws.push_back(parse_law(law));
  result.traced = json.at("traced");
  for (const Json& effect : json.at("effects"))
    result.effects.push_back(parse_effect(effect));
  result.missed = json.at("missed").get<std::vector<std::string>>();
}

} // namespace

std::string result_json(const CampaignResult& result, const std::string& key) {
  Json json = {{"schema", schema},
               {"tool_version", tool_version()},
               {"key", key},
               {"data", result.data_hash},
               {"synthetic_data", result.synthetic},
               {"judged_by", result.judged_by},
               {"experiments", result.experiments},
               {"rows", result.rows},
               {"laws", Json::array()},
               {"traced", result.traced},
               {"effects", Json::array()},
               {"missed", result.missed}};
  for (const LawResult& law : result.laws)
    json["laws"].push_back(law_json(law));
  for (const EffectResult& effect : result.effects)
    json["effects"].push_back(effect_json(effect));
  return io::json_text(json);
}

CampaignResult parse_result(std::string_view text, const std::string& file) {
  const std::string mends = "remove its folder: `frictab study run` rebuilds it";
  const Json json = io::parse_json(text, file);
  io::check_schema(json, schema, file, mends);
  CampaignResult result;
  io::read_json(file, mends, [&] { read_result(json, result); });
  return result;
}

} // namespace frictab::study
