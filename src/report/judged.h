// In words, on which experiments laws were judged; one wording for each way.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "data/dataset.h"

namespace frictab::report {

struct JudgedWords {
  std::string ranking; // "Laws by mean absolute error on experiments not trained on"
  std::string files;   // where the files of validation stand; empty: their names
  std::string plotted; // rows in plots of measured against predicted
  std::string dots;    // HTML; errors of single tests; empty: two colours
  std::string trace;   // behind "residual before"
};

JudgedWords judged_words(calibrate::JudgedBy judged_by);

// "82,500 rows of 150 experiments to train, 16,500 rows of 30 experiments to validate".
std::string size_text(calibrate::JudgedBy judged_by, const data::Dataset& training,
                      const data::Dataset& validation);

// Of condensed data, which figures are of all rows and which of blocks, without a full stop; empty
// where rows are held.
// "460 sliding, 20 closing"; empty where nothing but sliding was found, or looked for.
std::string phases_text(const data::Dataset& data);

std::string condensed_text(const data::Dataset& training, const data::Dataset& validation);
// Those of blocks.
std::vector<std::string> from_blocks();

// Where tests are of very different length: as how many of equal length they weigh, with the
// longest one, without a full stop; empty where they weigh as more than half of their number.
// Errors and fits are over rows, and no interval is right where a few tests are nearly all of them.
std::string uneven_text(calibrate::JudgedBy judged_by, const data::Dataset& training,
                        const data::Dataset& validation);

// What validation is, in a sentence without a full stop.
std::string judged_text(const calibrate::Calibration& calibration);

} // namespace frictab::report
