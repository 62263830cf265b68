// From a file's own columns to canonical ones: names, units, coefficients, forces, slopes.
#pragma once

#include "data/dataset.h"
#include "data/raw.h"

namespace frictab {

// One file, mapped, not yet cut into experiments.
struct MappedFile {
  std::vector<Column> columns;
  std::vector<std::string> experiment; // per row; empty where the file has no such column
  std::vector<std::string> notes;
};

// Adds every fault of the file's columns and cells to `faults`.
MappedFile map_columns(const CsvTable& raw, const DataOptions& options, FaultList& faults);

} // namespace frictab
