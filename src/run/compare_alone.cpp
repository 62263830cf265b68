// Compares what does not need the job.
#include "run/compare_alone.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/text.h"
#include "core/version.h"
#include "run/stage_record.h"
#include "table/drift.h"
#include "verify/compare_table.h"

namespace frictab::run {

namespace fs = std::filesystem;

using verify::DriftRecord;
using verify::Finding;

namespace {

constexpr double same_figure = 1e-6; // relative, of two searches for the same drift

bool above(double a, double b) {
  return a > b * (1 + same_figure);
}

// Drift at the state where the table says that it is worst; empty if it does not say so of all
// states.
std::optional<double> drift_where_claimed(const verify::VerifyInput& input) {
  const table::TableFunction table(input.table);
  table::States state;
  for (const std::string& name : table.inputs()) {
    const std::optional<double> value = input.table.record.input(name).worst_case_at;
    if (!value) return std::nullopt;
    state.push_back({*value});
  }
  table::Probe probe = table::with_law(table::LawFunction(input.law, table.inputs()), state);
  return table::compare(probe, table);
}

// Compares the drift that the table claims with that found and proven now. Other samples or boxes
// than those of its job may find a little less or prove a little less.
std::vector<Finding> compare_claims(const std::string& file, const verify::VerifyInput& input,
                                    const DriftRecord& drift) {
  std::vector<Finding> findings;
  const auto add = [&](const char* figure, double claimed, const std::string& what, bool failed) {
    findings.push_back(
        {"", file, figure, fmt::format("is {}, {}", shortest(claimed), what), "", failed});
  };
  const table::TableRecord& record = input.table.record;
  if (const auto claimed = record.worst_case_MPa) {
    const auto there = drift_where_claimed(input);
    if (there && (above(*there, *claimed) || above(*claimed, *there)))
      add("worst_case_MPa", *claimed,
          fmt::format("and the drift at its worst_case_at is {} MPa", shortest(*there)), true);
    else if (above(drift.worst_case_MPa, *claimed))
      add("worst_case_MPa", *claimed,
          fmt::format("and {} MPa are found now", shortest(drift.worst_case_MPa)), false);
  }
  if (const auto claimed = record.proven_drift_MPa) {
    if (!drift.proven_MPa)
      add("proven_drift_MPa", *claimed, "and nothing is proven now: " + drift.not_proven, true);
    else if (above(*drift.proven_MPa, *claimed))
      add("proven_drift_MPa", *claimed,
          fmt::format("and {} MPa are proven now", shortest(*drift.proven_MPa)),
          !drift.out_of_boxes || above(drift.worst_case_MPa, *claimed));
    else if (above(*claimed, *drift.proven_MPa))
      add("proven_drift_MPa", *claimed,
          fmt::format("and even {} MPa are proven now", shortest(*drift.proven_MPa)), false);
  }
  return findings;
}

// Whether a file of DIR/FOLDER is as stages.json of DIR says; nullopt without such a record.
std::optional<bool> is_as_recorded(const std::string& file, const std::string& folder) {
  const fs::path path = fs::absolute(file).lexically_normal();
  if (path.parent_path().filename() != folder) return std::nullopt;
  const job::Job none;
  const StageRecord record(none, path.parent_path().parent_path());
  return record.is_as_written(folder + "/" + path.filename().string());
}

// Texts that another version may word otherwise.
bool is_wording(const Finding& finding) {
  for (const char* name :
       {"comment", "long_name", "title", "source", "Conventions", "tool_version", "formula"})
    if (finding.where == name || finding.where.starts_with(std::string(name) + " of ")) return true;
  return false;
}

} // namespace

std::vector<Finding> compare_alone(const std::string& table_file, const std::string& model_file,
                                   const calibrate::ModelFit& fit, const verify::VerifyInput& input,
                                   const DriftRecord& drift) {
  const table::TableRecord& record = input.table.record;
  std::vector<Finding> findings = compare_claims(table_file, input, drift);
  if (!findings.empty() && record.proven_drift_MPa) {
    // A proof ends where it is close enough to what is allowed: asks for what is claimed.
    verify::VerifyInput to_claim = input;
    to_claim.max_drift_MPa = *record.proven_drift_MPa;
    findings = compare_claims(table_file, to_claim, verify::verify(to_claim, {}).front());
  }
  if (record.tool_version) {
    for (Finding& finding : verify::compare_table(
             table_file, verify::table_of_model(input.law, fit, input.table, table_file))) {
      if (verify::is_drift_figure(finding)) continue;
      if (*record.tool_version != tool_version() && is_wording(finding)) finding.failed = false;
      findings.push_back(std::move(finding));
    }
  }
  const bool fine = std::ranges::none_of(findings, &Finding::failed);
  for (const auto& [file, folder] : {std::pair{table_file, "tables"}, {model_file, "models"}})
    if (fine && !is_as_recorded(file, folder).value_or(true))
      findings.push_back({"", file, "", "was changed since it was written, says stages.json", ""});
  for (Finding& finding : findings) {
    finding.model = input.law.model.name();
    if (finding.failed)
      finding.mend = "make table and model again by `frictab run JOB`; `frictab verify JOB` "
                     "compares them with the job as well";
  }
  return findings;
}

} // namespace frictab::run
