// Measures the drift of the laws combined in one user file.
#include "verify/combined.h"

#include <algorithm>
#include <cmath>

#include "codegen/coefficient.h"
#include "codegen/compile.h"
#include "table/build.h"
#include "table/drift.h"
#include "verify/broken.h"
#include "verify/probes.h"

namespace frictab::verify {

namespace {

// States over a law's range, and tau_R of its table at these states, MPa.
struct Asked {
  std::vector<std::string> names;
  table::States states;
  std::vector<double> tau;

  std::vector<const double*> columns() const { return columns_of(names, names, states); }
};

// Limits tau_R to the largest mu that targets write, times the pressure; for solvers that get mu.
void limit_mu(Asked& asked) {
  const auto at = state_place(asked.names, normal_stress);
  if (!at) return;
  const std::vector<double>& pressure = asked.states[*at];
  for (std::size_t i = 0; i < asked.tau.size(); ++i)
    asked.tau[i] = std::min(asked.tau[i], codegen::fortran::largest_coefficient * pressure[i]);
}

// Returns states over the range and, where forming contacts begin, in the decade below its lowest
// pressure.
table::States states_of(const table::Table& table, std::size_t samples) {
  auto ranges = table::table_ranges(table, nullptr, table.model);
  table::States states = table::probe_points(ranges, table.axes, samples);
  if (!to_decade_below(ranges)) return states;
  const table::States below = points_below(ranges, samples);
  for (std::size_t d = 0; d < states.size(); ++d)
    states[d].insert(states[d].end(), below[d].begin(), below[d].end());
  return states;
}

Asked ask_table(const codegen::Exporter& exporter, const codegen::ExportRequest& law,
                std::size_t samples) {
  Asked asked;
  asked.names = law.table.inputs();
  asked.states = states_of(law.table, samples);
  hold(asked.states, asked.names, exporter.fixed_states(law));
  asked.tau.resize(asked.states.empty() ? 1 : asked.states.front().size());
  table::TableFunction(law.table).evaluate(asked.tau.size(), asked.columns(), asked.tau);
  if (exporter.gives_mu(law)) limit_mu(asked);
  return asked;
}

void compare(DriftRecord& record, const Asked& asked, const std::vector<double>& tau) {
  std::size_t furthest = 0;
  record.n_points = tau.size();
  for (std::size_t i = 0; i < tau.size(); ++i) {
    if (tau[i] == not_representable) {
      ++record.n_points_not_representable;
      continue;
    }
    const double d = difference(tau[i], asked.tau[i]);
    if (d <= record.max_vs_table_MPa) continue;
    record.max_vs_table_MPa = d;
    furthest = i;
  }
  // A law without representable states has not been tested and must not pass.
  if (record.n_points_not_representable == tau.size()) record.max_vs_table_MPa = HUGE_VAL;
  for (std::size_t d = 0; d < asked.names.size(); ++d)
    record.worst_state[asked.names[d]] = asked.states[d][furthest];
}

DriftRecord verify_law(const CombinedSource& source, const codegen::ExportRequest& law,
                       const Asked& asked, const codegen::BuildVariant& variant, double allowed) {
  DriftRecord record;
  record.model = law.law_name + ": " + law.table.model;
  record.subject = source.exporter->name + "/" + variant.name;
  if (!can_run(record, variant)) return record;
  std::vector<double> tau(asked.tau.size(), not_representable);
  const codegen::CompiledTarget target(*source.exporter, law, source.bundle.files, variant);
  record.path = target.drive_path({}); // first: later calls may set the routine's constants
  target.drive(tau.size(), asked.columns(), tau);
  compare(record, asked, tau);
  record.worst_case_MPa = record.max_vs_table_MPa + law.table.record.worst_case_MPa.value_or(0);
  record.allowed_MPa = allowed;
  record.passed = record.worst_case_MPa <= allowed && path_fault(record).empty();
  return record;
}

} // namespace

std::vector<DriftRecord> verify_combined(const CombinedSource& source,
                                         std::optional<double> max_drift_MPa, std::size_t samples) {
  std::vector<DriftRecord> records;
  for (const codegen::ExportRequest& law : source.bundle.laws) {
    const Asked asked = ask_table(*source.exporter, law, samples);
    const double allowed = max_drift_MPa.value_or(law.table.record.tolerance_MPa.value_or(0.5));
    for (const codegen::BuildVariant& variant : source.exporter->variants(law))
      records.push_back(or_broken(
          law.law_name + ": " + law.table.model, source.exporter->name + "/" + variant.name,
          allowed, [&] { return verify_law(source, law, asked, variant, allowed); }));
  }
  return records;
}

} // namespace frictab::verify
