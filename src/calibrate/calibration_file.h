// Calibrations and single models as JSON files that read back to the same bits.
#pragma once

#include <string>
#include <string_view>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Returns calibration.json: every law with parameters, errors and termination. The wall time is
// rounded up to 10, 60, 600 or 3600 seconds, so that the same job gives the same bytes.
std::string calibration_json(const Calibration& calibration);
Calibration parse_calibration(std::string_view text, const std::string& file);

// Returns models/<name>.json: one complete law.
std::string model_json(const ModelFit& fit, const Calibration& calibration);
// Reads the model, its standard errors and the ranges of the data; a model file has no prediction
// errors.
ModelFit parse_model_fit(std::string_view text, const std::string& file);
models::Model parse_model(std::string_view text, const std::string& file);

} // namespace frictab::calibrate
