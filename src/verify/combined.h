// Verifies several laws in one user file (codegen/combine.h). Each law is called through the entry
// that all share, as its solver would with the law's name, and compared with its own table.
#pragma once

#include <optional>
#include <vector>

#include "codegen/exporter.h"
#include "verify/verification.h"

namespace frictab::verify {

struct CombinedSource {
  const codegen::Exporter* exporter;
  codegen::CombinedBundle bundle;
};

// Returns one record per law and variant, with a model such as "PUNCH: coulomb". The drift from the
// law is the sum of the drift from its table, over the table's whole range and the decade below its
// lowest pressure, and the table's recorded drift from the law (0 if the table has none). The
// allowed drift is `max_drift_MPa`, otherwise the table's tolerance, otherwise 0.5 MPa. Throws
// InputError if a table has no range for a state.
std::vector<DriftRecord> verify_combined(const CombinedSource& source,
                                         std::optional<double> max_drift_MPa, std::size_t samples);

} // namespace frictab::verify
