// [verify] of a job.
#pragma once

#include <cstddef>
#include <optional>

#include "table/options.h"

namespace frictab::verify {

struct VerifyOptions {
  std::optional<double> max_drift_MPa;                // absent: table.tolerance_MPa
  std::size_t samples = 200000;                       // points over the whole range
  std::size_t proof_boxes = table::usual_proof_boxes; // that a proof looks at (table/bound.h)
  bool require_proof = false; // a table has to be proven to keep the tolerance
  bool require_run = false;   // every routine has to be compiled and run
};

} // namespace frictab::verify
