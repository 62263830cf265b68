// Several laws in one user file (codegen/combine.h): each is asked through the entry that they
// share, as its solver would under the law's name, and compared with its own table.
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

// One record for each law and variant, its model "PUNCH: coulomb". The drift from the law is that
// from the table, over its whole range and the decade below its lowest pressure, and what the table
// itself is known to drift from its law (0 of a table that does not say it); allowed is
// `max_drift_MPa`, else the table's tolerance, else 0.5 MPa. Throws InputError where a table has no
// range for a state.
std::vector<DriftRecord> verify_combined(const CombinedSource& source,
                                         std::optional<double> max_drift_MPa, std::size_t samples);

} // namespace frictab::verify
