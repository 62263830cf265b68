// Measures drift: a table, and sources generated from it, against the law.
#pragma once

#include <filesystem>

#include "codegen/exporter.h"
#include "core/error.h"
#include "table/build.h"
#include "table/tolerance.h"
#include "verify/verification.h"

namespace frictab::verify {

// One table, its law, and the conditions under which they are compared.
struct VerifyInput {
  const models::AssembledLaw& law;
  const table::Table& table;
  std::string table_name;              // for messages
  const data::Dataset* rows = nullptr; // validation rows; may be absent
  double max_drift_MPa = table::usual_tolerance_MPa;
  std::size_t samples = 200000;       // number of points over the whole range
  const DriftRecord* known = nullptr; // the table's own record, if it was compared just before
  // Largest number of boxes that the proof examines.
  std::size_t proof_boxes = table::usual_proof_boxes;
  std::string allowed_from = {};            // explanation if frictab chose max_drift_MPa
  std::optional<double> law_error_MPa = {}; // on unseen tests, if known
};

// Files generated from a table for one target.
struct GeneratedSource {
  const codegen::Exporter* exporter;
  codegen::ExportRequest request;
  codegen::SourceBundle bundle;
};
// Compares the table, then each variant of each bundle, with the law. Records a variant whose
// compiler is missing as not run, with the reason. Throws InputError if table and model do not fit.
std::vector<DriftRecord> verify(const VerifyInput& input,
                                const std::vector<GeneratedSource>& sources);

// Stores the result in the table's record: largest drift, its state, and the proven bound.
void set_drift(table::TableRecord& record, const DriftRecord& drift);

// Format verify.json, parse it, and format verify.xml (JUnit).
std::string verification_json(const Verification& verification);
Verification parse_verification(std::string_view text, const std::string& file);
std::string verification_junit(const Verification& verification);

// Formats verify.xml of a verification that could not be carried out: a case with an <error> per
// fault, so that a CI pipeline shows why nothing was verified.
std::string failure_junit(const std::vector<Fault>& faults);

} // namespace frictab::verify
