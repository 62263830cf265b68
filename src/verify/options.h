// Options in [verify] of a job.
#pragma once

#include <cstddef>
#include <optional>

#include "table/options.h"

namespace frictab::verify {

struct VerifyOptions {
  std::optional<double> max_drift_MPa; // empty: table.tolerance_MPa
  std::size_t samples = 200000;        // number of points over the whole range
  // Largest number of boxes that a proof examines (table/bound.h).
  std::size_t proof_boxes = table::usual_proof_boxes;
  bool require_proof = false; // fail tables without a proof of their tolerance
  bool require_run = false;   // fail routines that could not be compiled and run
};

} // namespace frictab::verify
