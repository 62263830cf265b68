// Measures drift: a table, and sources generated from it, against the law.
#pragma once

#include <filesystem>

#include "codegen/exporter.h"
#include "table/build.h"
#include "table/tolerance.h"
#include "verify/verification.h"

namespace frictab::verify {

// What one table is held against.
struct VerifyInput {
  const models::AssembledLaw& law;
  const table::Table& table;
  std::string table_name;              // for messages
  const data::Dataset* rows = nullptr; // validation rows; may be absent
  double max_drift_MPa = table::usual_tolerance_MPa;
  std::size_t samples = 200000;       // points over the whole range
  const DriftRecord* known = nullptr; // the table's own, where it was compared just before
  std::size_t proof_boxes = table::usual_proof_boxes; // that the proof may look at
  std::string allowed_from = {};                      // in words, where max_drift_MPa was chosen
  std::optional<double> law_error_MPa = {};           // on unseen tests, where known
};

// Compares the table, then each variant of each bundle. A variant whose compiler is absent is
// recorded as not run, with the reason. Throws InputError where table and model do not fit.
struct GeneratedSource {
  const codegen::Exporter* exporter;
  codegen::ExportRequest request;
  codegen::SourceBundle bundle;
};
std::vector<DriftRecord> verify(const VerifyInput& input,
                                const std::vector<GeneratedSource>& sources);

// What a table carries of its comparison: the worst case, where it is, and the bound.
void set_drift(table::TableRecord& record, const DriftRecord& drift);

// verify.json and verify.xml (JUnit).
std::string verification_json(const Verification& verification);
Verification parse_verification(std::string_view text, const std::string& file);
std::string verification_junit(const Verification& verification);

} // namespace frictab::verify
