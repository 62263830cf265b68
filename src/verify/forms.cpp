// Times the two forms of a law, table and direct, against each other.
#include "verify/forms.h"
#include "codegen/baked_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "core/error.h"
#include "core/text.h"
#include "core/text_table.h"
#include "table/direct.h"
#include "table/drift.h"
#include "verify/probes.h"

namespace frictab::verify {

namespace {

constexpr std::size_t states_timed = 4096;
constexpr std::size_t repeats = 11;
constexpr double least_seconds = 5e-4; // shortest duration of one repeat

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// One form, compiled and ready to be called.
class Subject {
public:
  Subject(const codegen::Exporter& exporter, const table::Table& table,
          const std::vector<std::string>& names, const table::States& states)
      : exporter_(exporter), request_{table, "mm-t-s", {}},
        target_(exporter, request_, exporter.generate(request_), exporter.variants(request_)[0]),
        columns_(columns_of(table.inputs(), names, states)), tau_(states.front().size()) {}

  const std::vector<double>& answer() {
    exporter_.batch(target_.handle(), request_, tau_.size(), columns_, tau_);
    return tau_;
  }

  // Returns the time per query. Doubles the number of calls until they fill a repeat.
  double ns_per_query() {
    for (;;) {
      const double before = thread_seconds();
      for (std::size_t i = 0; i < calls_; ++i)
        answer();
      const double seconds = thread_seconds() - before;
      if (seconds >= least_seconds)
        return 1e9 * seconds / static_cast<double>(calls_ * tau_.size());
      calls_ *= 2;
    }
  }

private:
  const codegen::Exporter& exporter_;
  codegen::ExportRequest request_;
  codegen::CompiledTarget target_;
  std::vector<const double*> columns_;
  std::vector<double> tau_;
  std::size_t calls_ = 1;
};

double median(std::array<double, repeats> values) {
  std::nth_element(values.begin(), values.begin() + repeats / 2, values.end());
  return values[repeats / 2];
}

void measure(FormComparison& out, const codegen::Exporter& exporter,
             const models::AssembledLaw& law, const table::Table& table,
             const table::Table& direct) {
  const std::vector<std::string> names = table.inputs();
  const table::LawFunction tau_R(law, names);
  const table::Probe probe = table::with_law(
      tau_R, table::box_points(table::table_ranges(table, nullptr, table.model), states_timed));
  Subject of_table(exporter, table, names, probe.states);
  Subject of_law(exporter, direct, names, probe.states);
  const std::vector<double>& answer = of_law.answer();
  for (std::size_t i = 0; i < answer.size(); ++i)
    out.direct.drift_MPa = std::max(out.direct.drift_MPa, std::abs(answer[i] - probe.law[i]));
  std::array<double, repeats> table_ns{}, law_ns{};
  of_table.ns_per_query(), of_law.ns_per_query(); // warms up caches and finds the number of calls
  for (std::size_t r = 0; r < repeats; ++r) {
    table_ns[r] = of_table.ns_per_query();
    law_ns[r] = of_law.ns_per_query();
  }
  out.table.ns_per_query = median(table_ns);
  out.direct.ns_per_query = median(law_ns);
}

} // namespace

FormComparison form_sizes(const models::AssembledLaw& law, const table::Table& table) {
  FormComparison out;
  out.model = table.model;
  out.nodes = table.nodes();
  out.table.bytes = sizeof(double) * codegen::baked_numbers(table);
  out.direct.bytes = sizeof(double) * codegen::baked_numbers(table::direct_form(law, table));
  if (table.record.worst_case_MPa) out.table.drift_MPa = *table.record.worst_case_MPa;
  return out;
}

FormComparison compare_forms(const models::AssembledLaw& law, const table::Table& table) {
  const codegen::Exporter& exporter = *codegen::find_exporter("c");
  FormComparison out = form_sizes(law, table);
  const std::string compiler = exporter.variants({table, "mm-t-s", {}})[0].command.front();
  if (table.axes.empty())
    out.why_not = "nothing is tabulated, both are the same";
  else if (!have_program(compiler))
    out.why_not = "there is no " + compiler + " on this machine";
  else
    try {
      measure(out, exporter, law, table, table::direct_form(law, table));
    } catch (const InputError& error) { // too large for a source
      out.why_not = error.what();
    }
  return out;
}

std::string form_verdict(const FormComparison& c) {
  if (!c.why_not.empty()) return c.why_not;
  // Speed of the table relative to the law.
  const double faster = c.direct.ns_per_query / c.table.ns_per_query;
  if (faster >= 2) return fmt::format("the table is {:.1f} times faster than the law", faster);
  if (faster > 1.05)
    return fmt::format("the table is only {:.1f} times faster: export.form = \"direct\" has no "
                       "drift",
                       faster);
  return fmt::format("the law itself is {:.1f} times faster: export.form = \"direct\"", 1 / faster);
}

std::string forms_in_short(const std::vector<FormComparison>& comparisons) {
  std::vector<std::string> names;
  for (const FormComparison& c : comparisons)
    if (c.why_not.empty() && c.direct.ns_per_query <= c.table.ns_per_query)
      names.push_back(c.model);
  if (names.empty()) return "";
  return "export.form = \"direct\": the formula of " + join(names, ", ") +
         " is faster than the table, and exact";
}

namespace {

void add_figures(std::vector<std::string>& row, const FormFigures& f, bool measured) {
  row.push_back(human_bytes(static_cast<double>(f.bytes)));
  row.push_back(measured || f.drift_MPa > 0 ? fmt::format("{:.2g}", f.drift_MPa) : "-");
  row.push_back(measured ? fmt::format("{:.1f}", f.ns_per_query) : "-");
}

} // namespace

std::string forms_text(const std::vector<FormComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows = {
      {"law", "table", "MPa off", "ns", "law itself", "MPa off", "ns", ""}};
  for (const FormComparison& c : comparisons) {
    rows.push_back({c.model});
    add_figures(rows.back(), c.table, c.why_not.empty());
    add_figures(rows.back(), c.direct, c.why_not.empty());
    rows.back().push_back(form_verdict(c));
  }
  return "Table or the law itself, as generated C on this machine (no file holds these times):\n" +
         text_table(rows, {false, true, true, true, true, true, true});
}

} // namespace frictab::verify
