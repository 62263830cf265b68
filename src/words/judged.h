// Wording of how laws were validated: on which experiments, one text for each way.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "data/dataset.h"

namespace frictab::words {

struct JudgedWords {
  std::string ranking; // "Laws by mean absolute error on experiments not trained on"
  std::string plotted; // rows in plots of measured against predicted
  std::string dots;    // errors of single tests; empty: two colours
  std::string trace;   // follows "residual before"
};

JudgedWords judged_words(calibrate::JudgedBy judged_by);

// Returns "82,500 rows of 150 experiments to train, 16,500 rows of 30 experiments to validate".
std::string size_text(calibrate::JudgedBy judged_by, const data::Dataset& training,
                      const data::Dataset& validation);

// Returns "460 sliding, 20 closing"; empty if all rows are sliding, or phases were not detected.
std::string phases_text(const data::Dataset& data);

// States which figures of condensed data are of all rows and which of blocks, without a full stop;
// empty where the data are not condensed.
std::string condensed_text(const data::Dataset& training, const data::Dataset& validation);
// Names of the results that are computed from blocks.
std::vector<std::string> from_blocks();

// Warns of tests with very different lengths, without a full stop: the number of tests of equal
// length that they weigh as, and the longest one. Errors and fits are over rows, and no interval is
// right where a few tests have nearly all rows. Empty where they weigh as at least half of their
// number.
std::string uneven_text(calibrate::JudgedBy judged_by, const data::Dataset& training,
                        const data::Dataset& validation);

// Describes the validation in a sentence without a full stop.
std::string judged_text(const calibrate::Calibration& calibration);

} // namespace frictab::words
