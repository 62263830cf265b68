// Drift: the deviation of a table, and of each source generated from it, from the law.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "codegen/path_result.h"
#include "table/table.h"
#include "verify/finding.h"

namespace frictab::verify {

// Rows beyond one end of an axis of the table.
struct BeyondEnd {
  std::string axis;
  std::string side; // below | above
  // The table's behaviour there: clamp | error | law; held: clamps as the law does.
  std::string outside;
  double end = 0;
  std::size_t rows = 0;
  double largest_excess = 0; // in the unit of the axis
};

// States where forming contacts begin: contact normal stresses from a tenth of the table's lowest
// up to it, the other states anywhere in their ranges.
struct BelowRange {
  double low_MPa = 0, high_MPa = 0; // range of sigma_n_MPa
  std::string outside;              // the table's behaviour there: clamp | law
  std::size_t n_points = 0;
  double max_abs_MPa = 0; // against the law; not a failure if the table clamps
};

// Comparison of one subject, a table or a routine, with the law.
struct DriftRecord {
  std::string model;   // law name
  std::string subject; // "table", "c/c99", "abaqus_vfric/double", ...
  bool ran = true;     // false: could not be run here; `why_not` has the reason
  std::string why_not;
  // Drift on the validation rows inside the table's range, or where the law's formula goes on.
  table::Drift rows;
  std::size_t n_rows = 0;                    // number of validation rows
  std::size_t n_outside = 0;                 // rows outside the table's range
  std::vector<BeyondEnd> beyond;             // ends beyond which they lie
  double max_abs_outside_MPa = 0;            // clamped answers against the law (not in `rows`)
  std::size_t n_refused = 0;                 // answered by NaN, as outside = error requires
  std::size_t n_not_refused = 0;             // answered by a number where NaN is required
  double worst_case_MPa = 0;                 // largest drift found over the whole range
  std::map<std::string, double> worst_state; // its state, by canonical name
  std::size_t n_points = 0;                  // number of points evaluated over the range
  // Sources: number of states that the routine's arguments cannot represent, such as a peak
  // pressure below the present one; they add no drift. Counted in rows and in points of the range.
  std::size_t n_rows_not_representable = 0, n_points_not_representable = 0;
  double unit_roundoff = 0;    // sources: of their real type (2^-24 in single precision)
  double max_vs_table_MPa = 0; // sources: largest difference from the table itself
  // Present only if the law takes sigma_n_MPa and the table answers below its range.
  std::optional<BelowRange> below = {};
  bool passed = false;
  std::optional<double> proven_MPa = {}; // tables: no state in the range drifts further
  std::string not_proven = {};           // reason why no such bound is known
  std::size_t proof_boxes = 0;           // number of boxes that the proof examined
  bool out_of_boxes = false;             // over_by_proof, but more boxes might give a smaller bound
  double allowed_MPa = 0;                // largest drift that passes; 0: the verification's own
  std::string allowed_from = {};         // explains a limit that frictab chose
  std::optional<double> law_error_MPa = {}; // error of the law on unseen tests, if known
  // Drifts further than law_error_MPa: never "ok", even within the tolerance.
  bool over_law_error = false;
  // Largest difference from the law that the target's own files state (Exporter::stated_loss_MPa);
  // the target passes if no more is found, even above the tolerance.
  std::optional<double> stated_loss_MPa = {};
  bool over_by_proof = false; // the bound exceeds the tolerance, even if the drift found does not
  // States (canonical values) that a solver's own table, or a routine with constants of the job,
  // fixes. All figures above then compare with the law at the fixed states. The cost of fixing them
  // is the difference from the law at the rows' own states:
  std::optional<std::map<std::string, double>> fixed_states = {};
  double cost_mean_abs_MPa = 0, cost_max_abs_MPa = 0; // over the rows inside the range
  // Routines: driven over increments, all that they return and remember against an account of its
  // own; empty for what remembers nothing and for solvers' own tables.
  std::optional<codegen::PathResult> path = {};
  // Not run although this machine has its compiler: it could not be compiled or called.
  bool broken = false;
};

// True for a routine in single precision; its difference from the table is then a rounding error
// worth reporting.
inline bool in_single_precision(const DriftRecord& r) {
  return r.ran && r.unit_roundoff >= 0x1p-24;
}

// Returns the drift that decides whether a record passed: the largest over the range, on the rows
// and, if the table follows the law there, below the range. Numbers in place of required NaNs fail
// separately (n_not_refused).
inline double largest_drift_MPa(const DriftRecord& r) {
  const double below = r.below && r.below->outside == "law" ? r.below->max_abs_MPa : 0;
  return std::max({r.worst_case_MPa, r.rows.max_abs, below});
}

// Returns what a driven routine returned or remembered wrongly: "over 240 increments STATEV(1) slip
// differs by 0.5 mm"; empty if nothing.
std::string path_fault(const DriftRecord& record);

struct Verification {
  double max_drift_MPa = 0; // largest limit of any record
  std::vector<DriftRecord> records;
  bool require_proof = false;         // tables pass only with a proof
  bool require_run = false;           // subjects that could not be run have failed
  std::vector<Finding> findings = {}; // files that differ from what they were made from

  bool failed(const DriftRecord& record) const {
    if (!record.ran) return require_run || record.broken;
    const bool proven = record.proven_MPa && !record.over_by_proof;
    return !record.passed || (require_proof && record.subject == "table" && !proven);
  }
  // Number of subjects that neither passed nor failed, because this machine lacks their compiler.
  std::size_t untested() const {
    return static_cast<std::size_t>(std::count_if(
        records.begin(), records.end(), [](const DriftRecord& r) { return !r.ran && !r.broken; }));
  }
  // True if nothing failed; subjects counted by untested() do not fail.
  bool passed() const {
    return std::none_of(records.begin(), records.end(),
                        [&](const DriftRecord& record) { return failed(record); }) &&
           std::none_of(findings.begin(), findings.end(),
                        [](const Finding& finding) { return finding.failed; });
  }
};

// Formats as "0.5", or "0.418 to 0.5" if laws have different tolerances.
std::string allowed_text(const Verification& verification);
// Returns "polynomial: 0.418 MPa, a twentieth of ..." for each law whose tolerance frictab chose.
std::vector<std::string> chosen_tolerances(const Verification& verification);

} // namespace frictab::verify
