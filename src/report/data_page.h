// data.html: a campaign before a law is fitted to it, test by test, as a page that opens offline.
#pragma once

#include <string>
#include <vector>

#include "calibrate/judgement.h"
#include "data/dataset.h"

namespace frictab::report {

struct DataPage {
  std::string title; // the job file's name
  bool synthetic = false;
  calibrate::JudgedBy judged_by;
  const data::Dataset& training;
  const data::Dataset& validation;
  std::vector<std::string> faults; // faults of most rows that make the data implausible
};

// Writes small plots of tau_R over the sliding distance (else time, else the row), one per test, on
// the same axes, so that a spoilt test is seen; spans and means of each test; and what was
// converted, computed, joined and left out.
std::string data_html(const DataPage& page);

} // namespace frictab::report
