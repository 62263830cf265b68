// Drift: how far a table, and each source generated from it, are from the law.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "table/table.h"

namespace frictab {

// One thing that was compared with the law.
struct DriftRecord {
  std::string model;   // law name
  std::string subject; // "table", "c/c99", "abaqus_vfric/double", ...
  bool ran = true;     // false: could not be run here; `why_not` says why
  std::string why_not;
  Drift rows;                                // on the validation rows inside the table's range
  std::size_t n_rows = 0;                    // rows compared
  std::size_t n_outside = 0;                 // of these outside the table's range (not in `rows`)
  double max_abs_outside_MPa = 0;            // the clamped answer against the law, on those
  double worst_case_MPa = 0;                 // largest drift found over the whole range
  std::map<std::string, double> worst_state; // where; canonical names
  std::size_t n_points = 0;                  // points looked at over the range
  double max_vs_table_MPa = 0;               // sources: largest difference from the table itself
  bool passed = false;
  std::optional<double> proven_MPa = {}; // tables: no state in the range drifts further
  std::string not_proven = {};           // why there is no such bound
};

struct Verification {
  double max_drift_MPa = 0;
  std::vector<DriftRecord> records;
  bool passed() const {
    for (const DriftRecord& record : records)
      if (record.ran && !record.passed) return false;
    return true;
  }
};

} // namespace frictab
