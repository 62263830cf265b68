// The first lines of a summary and of a page: which law to take, how wrong it is, what it lacks,
// where it is valid, how far its tables and routines drift, what to do next.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "calibrate/calibration.h"
#include "table/table.h"
#include "trace/trace.h"
#include "verify/verification.h"
#include "words/document.h"

namespace frictab::words {

struct Answers {
  const calibrate::Calibration* calibration = nullptr; // null: not calibrated
  const verify::Verification* verification = nullptr;  // null: not verified
  const std::vector<trace::Trace>& traces;
  const std::vector<table::Table>& tables;
  const std::vector<std::string>& cautions; // of the data
  std::string job;                          // its file, for a command
};

// One line each; without those that are not known.
Section in_short(const Answers& answers);

// The same as members of summary.json: recommended, best, expected_error_MPa, expected_error_95,
// valid, missing, drift_MPa, drift_is_proven, next.
void add_answers(nlohmann::ordered_json& json, const Answers& answers);

} // namespace frictab::words
