// The data of a job in words: size, what was read, converted and left out; tests, columns and
// ranges.
#pragma once

#include <string>

#include "calibrate/judgement.h"
#include "data/dataset.h"
#include "words/document.h"

namespace frictab::words {

struct DataParts {
  const data::Dataset& training;
  const data::Dataset& validation; // without rows: there is none of its own
  calibrate::JudgedBy judged_by;
};

// Size and findings. brief: what may change a result; full: also files, conversions and phases.
Section data_read(const DataParts& parts, Detail detail);

// A row per file, and per run of files that were read in the same way: format, lines of names and
// units, rows, and columns that are not read.
Section files_read(const DataParts& parts);

// A row per test: rows, mean coefficients, lowest to highest value of each quantity.
Section tests(const DataParts& parts);

// Role of each column that is not a quantity, with its reason; at most the first hundred.
Section column_roles(const data::Dataset& data);

// Lowest to highest value of each quantity.
Table ranges(const DataParts& parts);

// The name of a file without the folders of a user's machine.
std::string shown_path(const std::string& path);

} // namespace frictab::words
