// Errors, comparisons, noise floors and conditional use as parts of calibration.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "calibrate/judgement.h"

namespace frictab::calibrate {

// NaN and infinities are null in JSON.
double number_or_nan(const nlohmann::ordered_json& value);

nlohmann::ordered_json metrics_json(const Metrics& metrics);
Metrics parse_metrics(const nlohmann::ordered_json& j);

JudgedBy parse_judged_by(const std::string& name);

// Arrays over the experiments; null where none was left out. The names stand elsewhere.
nlohmann::ordered_json unseen_json(const std::vector<ExperimentError>& errors);
std::vector<ExperimentError> parse_unseen(const nlohmann::ordered_json& j,
                                          const std::vector<std::string>& experiments);

nlohmann::ordered_json determination_json(const Determination& determination);
Determination parse_determination(const nlohmann::ordered_json& j);
nlohmann::ordered_json influence_json(const std::vector<Influence>& influence);
std::vector<Influence> parse_influence(const nlohmann::ordered_json& j);

// null where nothing was drawn.
nlohmann::ordered_json choice_json(const Choice& choice);
Choice parse_choice(const nlohmann::ordered_json& j);

// null where nothing judges the laws.
nlohmann::ordered_json recommended_json(const Recommended& recommended);
Recommended parse_recommended(const nlohmann::ordered_json& j);

nlohmann::ordered_json comparisons_json(const Comparisons& comparisons);
Comparisons parse_comparisons(const nlohmann::ordered_json& j);

// The first one, with the others as its `also`; null where there is none.
nlohmann::ordered_json noise_floors_json(const std::vector<NoiseFloor>& floors);
std::vector<NoiseFloor> parse_noise_floors(const nlohmann::ordered_json& j);

// null where it was not asked for.
nlohmann::ordered_json conditional_json(const Conditional& conditional);
Conditional parse_conditional(const nlohmann::ordered_json& j);

} // namespace frictab::calibrate
