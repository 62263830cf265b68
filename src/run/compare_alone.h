// Compares a table, without its job, with its model and with stages.json of the same results.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "verify/verify.h"

namespace frictab::run {

// Returns what differs in a table that frictab made (a table made elsewhere has nothing to compare
// but its claims): values, formulas, texts and constants from its model; the drift that it claims
// from `drift`, its record of now; and, where it lies in the results of a job, both files by their
// hashes in stages.json. `fit`: what the model file has.
std::vector<verify::Finding> compare_alone(const std::string& table_file,
                                           const std::string& model_file,
                                           const calibrate::ModelFit& fit,
                                           const verify::VerifyInput& input,
                                           const verify::DriftRecord& drift);

} // namespace frictab::run
