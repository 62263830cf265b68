// Drift: how far a table, and each source generated from it, are from the law.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "table/table.h"

namespace frictab::verify {

// Rows beyond one end of an axis of the table.
struct BeyondEnd {
  std::string axis;
  std::string side;    // below | above
  std::string outside; // what the table does there: clamp | error | law; held: as the law does
  double end = 0;
  std::size_t rows = 0;
  double largest_excess = 0; // in the unit of the axis
};

// Where forming contacts begin: states below every contact normal stress that the table was made
// for, down to a tenth of the lowest, and the other states anywhere in their ranges.
struct BelowRange {
  double low_MPa = 0, high_MPa = 0; // of sigma_n_MPa
  std::string outside;              // what the table does there: clamp | law
  std::size_t n_points = 0;
  double max_abs_MPa = 0; // against the law; no failure where the table clamps
};

// One thing that was compared with the law.
struct DriftRecord {
  std::string model;   // law name
  std::string subject; // "table", "c/c99", "abaqus_vfric/double", ...
  bool ran = true;     // false: could not be run here; `why_not` says why
  std::string why_not;
  table::Drift rows; // on the validation rows inside the table's range, and where the law goes on
  std::size_t n_rows = 0;                    // rows
  std::size_t n_outside = 0;                 // of these outside the table's range
  std::vector<BeyondEnd> beyond;             // where they are
  double max_abs_outside_MPa = 0;            // the clamped answer against the law (not in `rows`)
  std::size_t n_refused = 0;                 // answered by NaN, as outside = error asks
  std::size_t n_not_refused = 0;             // answered by a number where it asks for NaN
  double worst_case_MPa = 0;                 // largest drift found over the whole range
  std::map<std::string, double> worst_state; // where; canonical names
  std::size_t n_points = 0;                  // points looked at over the range
  // Sources: states that the routine's arguments cannot represent, as a peak pressure below the
  // present one; they add no drift. Among the rows, among the range's points.
  std::size_t n_rows_not_representable = 0, n_points_not_representable = 0;
  double unit_roundoff = 0;             // sources: of their real type (2^-24 in single precision)
  double max_vs_table_MPa = 0;          // sources: largest difference from the table itself
  std::optional<BelowRange> below = {}; // where the law takes sigma_n_MPa, unless it is refused
  bool passed = false;
  std::optional<double> proven_MPa = {};    // tables: no state in the range drifts further
  std::string not_proven = {};              // why there is no such bound
  std::size_t proof_boxes = 0;              // that the proof looked at
  bool out_of_boxes = false;                // over_by_proof, and more boxes might have mended that
  double allowed_MPa = 0;                   // drift that passes; 0: the verification's own
  std::string allowed_from = {};            // in words, where the job leaves it to frictab
  std::optional<double> law_error_MPa = {}; // what the law errs by on unseen tests, where known
  bool over_law_error = false; // drifts further than that: within the tolerance or not, never "ok"
  bool over_by_proof = false;  // the bound is over the tolerance, whatever was found
  // What holds some states (canonical values), a solver's own table or a routine with constants of
  // the job: all figures above compare it with the law at the held states. What holding costs,
  // against the law at the rows' own states:
  std::optional<std::map<std::string, double>> held = {};
  double cost_mean_abs_MPa = 0, cost_max_abs_MPa = 0; // over the rows inside the range
};

// What it is off the table itself is rounding that somebody may want to know.
inline bool in_single_precision(const DriftRecord& r) {
  return r.ran && r.unit_roundoff >= 0x1p-24;
}

// What decides whether it passed, but for answers where there should be none: over the range, on
// the rows, and below the range where the law is followed there.
inline double largest_drift_MPa(const DriftRecord& r) {
  const double below = r.below && r.below->outside == "law" ? r.below->max_abs_MPa : 0;
  return std::max({r.worst_case_MPa, r.rows.max_abs, below});
}

struct Verification {
  double max_drift_MPa = 0; // the largest that any record allows
  std::vector<DriftRecord> records;
  bool require_proof = false; // what is found is not enough for a table
  bool require_run = false;   // what could not be run has failed

  bool failed(const DriftRecord& record) const {
    if (!record.ran) return require_run;
    const bool proven = record.proven_MPa && !record.over_by_proof;
    return !record.passed || (require_proof && record.subject == "table" && !proven);
  }
  // Neither passed nor failed: there is no compiler for it on this machine.
  std::size_t untested() const {
    return static_cast<std::size_t>(
        std::count_if(records.begin(), records.end(), [](const DriftRecord& r) { return !r.ran; }));
  }
  bool any_over_law_error() const {
    return std::any_of(records.begin(), records.end(),
                       [](const DriftRecord& r) { return r.ran && r.over_law_error; });
  }
  // Nothing failed; untested() says what that is worth.
  bool passed() const {
    for (const DriftRecord& record : records)
      if (failed(record)) return false;
    return true;
  }
};

// "0.5", or "0.418 to 0.5" where laws have tolerances of their own.
std::string allowed_text(const Verification& verification);
// "polynomial: 0.418 MPa, a twentieth of ..." of each law whose tolerance frictab chose.
std::vector<std::string> chosen_tolerances(const Verification& verification);

} // namespace frictab::verify
