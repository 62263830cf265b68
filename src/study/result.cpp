// Converts results from a pipeline to JSON and back.
#include "study/result.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "calibrate/judgement_json.h"
#include "core/no_value.h"
#include "core/text.h"
#include "effects/effect.h"
#include "io/json.h"
#include "io/json_fields.h"

namespace frictab::study {

using io::Fields;

namespace {

constexpr const char* schema = "frictab/study-result/2";

double best_p_value(const calibrate::Comparisons& comparisons, const std::string& law) {
  const auto at = std::ranges::find(comparisons.laws, law);
  const auto i = static_cast<std::size_t>(at - comparisons.laws.begin());
  return i < comparisons.best_p_values.size() ? comparisons.best_p_values[i] : no_value;
}

// Returns no parameters for a trained law, because its numbers are part of its formula.
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
  result.rows = data.training.source_rows() + data.validation.source_rows();
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

static void describe(Fields& f, FittedParameter& p) {
  f("name", p.name);
  f("value", p.value);
  f("std_error", p.std_error);
  f("unit", p.unit);
}

static void describe(Fields& f, LawResult& law) {
  f("law", law.law);
  f("fitted", law.fitted);
  f("mae_MPa", law.mae_MPa);
  f("mae_interval_MPa", law.mae_interval);
  f("rmse_MPa", law.rmse_MPa);
  f("bias_MPa", law.bias_MPa);
  f("best_p_value", law.best_p_value);
  f("parameters", law.parameters);
  if (!f.has("band", law.band_low && law.band_high)) return;
  std::pair band(law.band_low.value_or(0), law.band_high.value_or(0));
  f.known("band", band);
  if (f.reads()) std::tie(law.band_low, law.band_high) = band;
}

static void describe(Fields& f, EffectResult& effect) {
  f("law", effect.law);
  f("column", effect.column);
  f("form", effect.form);
  f("acts_on", effect.acts_on);
  f("p_value", effect.p_value);
  f("gain_MPa", effect.gain_MPa);
}

static void describe(Fields& f, CampaignResult& result) {
  f("data", result.data_hash);
  f("stages", result.stages_hash);
  f("synthetic_data", result.synthetic);
  f("judged_by", result.judged_by);
  f("experiments", result.experiments);
  f("rows", result.rows);
  f("laws", result.laws);
  f("traced", result.traced);
  f("effects", result.effects);
  f("missed", result.missed);
}

std::string result_json(const CampaignResult& result, const std::string& key) {
  return io::sealed(io::record_text(schema, [&](Fields& f) {
    f.only_written("key", key);
    describe(f, io::to_write(result));
  }));
}

std::string damage_of_result(std::string_view text, const std::string& key) {
  if (io::seal_of(text) != io::Seal::right) return "its hash does not fit";
  return text.find(fmt::format("\"key\": \"{}\"", key)) == text.npos
             ? "it is the result of another campaign"
             : "";
}

CampaignResult parse_result(std::string_view text, const std::string& file) {
  CampaignResult result;
  io::read_record(text, file, schema, "remove its folder: `frictab study run` rebuilds it",
                  [&](Fields& f) { describe(f, result); });
  return result;
}

} // namespace frictab::study
