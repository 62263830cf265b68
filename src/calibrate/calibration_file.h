// Calibrations and single models as JSON files that read back to the same bits.
#pragma once

#include <string>
#include <string_view>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// calibration.json: every law with parameters, errors, termination. The wall time is given as the
// next of 10, 60, 600, 3600 seconds above it, so that the same job gives the same bytes.
std::string calibration_json(const Calibration& calibration);
Calibration parse_calibration(std::string_view text, const std::string& file);

// models/<name>.json: one law, complete.
std::string model_json(const ModelFit& fit, const Calibration& calibration);
// Model, standard errors and what the data reached; a model file holds no errors of prediction.
ModelFit parse_model_fit(std::string_view text, const std::string& file);
models::Model parse_model(std::string_view text, const std::string& file);

} // namespace frictab::calibrate
