// One campaign's result as the report needs it: results/KEY/study.json. Outputs of its stages are
// in the same folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/judgement.h"
#include "run/job_data.h"
#include "trace/trace.h"

namespace frictab::study {

struct FittedParameter {
  std::string name, unit;
  double value = 0;
  double std_error = 0; // over experiments; NaN: the data do not determine the parameter
};

struct LawResult {
  std::string law;
  bool fitted = false; // has fitted parameters, in contrast to constants of the literature
  double mae_MPa = 0, rmse_MPa = 0, bias_MPa = 0; // on tests outside the training
  calibrate::Interval mae_interval;               // 95 %, whole tests resampled
  double best_p_value = 0; // of "no law has a smaller MAE"; NaN: laws were not compared
  std::optional<double> band_low, band_high; // 5 % and 95 % quantiles of factors of new tests
  std::vector<FittedParameter> parameters;
};

struct EffectResult {
  std::string law;
  std::string column; // "dwell_s", "dwell_s x friction_work"
  std::string form, acts_on;
  double p_value = 0;  // family-wise
  double gain_MPa = 0; // decrease of the MAE on unseen tests
};

struct CampaignResult {
  std::string data_hash, judged_by;
  std::string stages_hash; // of stages.json, which has those of all other files
  bool synthetic = false;
  std::size_t experiments = 0, rows = 0; // training and validation
  std::vector<LawResult> laws;           // by rank, as calibrated: without traced effects
  bool traced = false;
  std::vector<EffectResult> effects;
  std::vector<std::string> missed; // missed targets, in words
};

// Returns the result of a calibration, without traced effects.
CampaignResult result_of(const calibrate::Calibration& calibration, const run::JobData& data);
void add_effects(CampaignResult& result, const std::vector<trace::Trace>& traces);

// `key`: 16 hex digits. The text ends with a hash of its content.
std::string result_json(const CampaignResult& result, const std::string& key);
// Says what is wrong with the text as result_json's of this key; empty: nothing.
std::string damage_of_result(std::string_view text, const std::string& key);
// Throws InputError if the text was not written by result_json.
CampaignResult parse_result(std::string_view text, const std::string& file);

} // namespace frictab::study
