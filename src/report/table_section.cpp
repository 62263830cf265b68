// Writes tables and the drift from their laws, also of the sources generated from them.
#include <cmath>

#include <fmt/format.h>

#include "codegen/table_text.h"
#include "core/no_value.h"
#include "core/text.h"
#include "data/quantity.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/svg.h"
#include "table/beyond_data.h"
#include "table/distance.h"
#include "verify/beyond.h"

namespace frictab::report {

using verify::DriftRecord;

namespace {

std::string summary_of(const table::Table& table) {
  std::string grid;
  for (const table::TableAxis& axis : table.axes)
    grid += (grid.empty() ? "" : " \u00D7 ") + std::to_string(axis.nodes.size());
  const std::string what = models::quantity_name(table.quantity);
  std::string text = "One constant, " + what + ". ";
  if (!table.axes.empty())
    text = fmt::format(
        "{}{}, {}; holds {}, interpolated {}{}. ", table.axes.size() > 1 ? grid + " = " : "",
        count_of(table.nodes(), "node"), human_bytes(static_cast<double>(table.bytes())), what,
        table.interpolation == table::Interpolation::cubic ? "cubically" : "linearly",
        table.log_value ? " in its logarithm" : "");
  text += "Inputs: ";
  const std::vector<std::string> inputs = table.inputs();
  for (std::size_t i = 0; i < inputs.size(); ++i)
    text += (i ? ", " : "") + ("<code>" + svg::escape(inputs[i]) + "</code>");
  if (inputs.empty()) text += "none";
  const std::string edge = codegen::edge_text(table);
  const std::string far = table::distance_text(table);
  text += "." + (edge.empty() ? "" : " It " + svg::escape(edge) + ".");
  return text + (far.empty() ? "" : " " + svg::escape(far) + ".");
}

// Lists the sizes of a source with the table and with the law itself.
std::string forms_of(const ReportInput& input, const table::Table& table) {
  for (const verify::FormComparison& form : input.forms)
    if (form.model == table.model && !table.axes.empty())
      return fmt::format(" A source holds {} of numbers as this table, {} as the law itself "
                         "(<code>export.form = \"direct\"</code>, no drift but rounding); which of "
                         "the two is faster <code>frictab run</code> measures and prints.",
                         human_bytes(static_cast<double>(form.table.bytes)),
                         human_bytes(static_cast<double>(form.direct.bytes)));
  return "";
}

TemplateValues axis_row(const ReportInput& input, const table::Table& table,
                        const table::TableAxis& axis) {
  std::string why = table.record.input(axis.name).range_from.value_or("");
  if (const std::string beyond = table::beyond_data_text(axis); !beyond.empty())
    why += (why.empty() ? "" : "; ") + beyond;
  if (const auto held = table.record.input(axis.name).held_why)
    why += (why.empty() ? "" : "; ") + *held;
  const bool any = !axis.nodes.empty();
  return {{{"name", svg::escape(axis.name)},
           {"unit", shown_unit(axis.unit)},
           {"low", short_figures(any ? axis.nodes.front() : no_value)},
           {"high", short_figures(any ? axis.nodes.back() : no_value)},
           {"nodes", thousands(axis.nodes.size())},
           {"spacing", axis.log ? "logarithm" : "the quantity itself"},
           {"reach", reach_bar(input, axis)},
           {"why", why.empty() ? "\u2013" : svg::escape(why)}},
          {},
          {}};
}

std::string state_text(const DriftRecord& record) {
  std::string text;
  const auto add = [&](const std::string& name, double value) {
    text += (text.empty() ? "" : " ") +
            fmt::format("<span>{} = {}</span>", svg::escape(name), short_figures(value));
  };
  for (const data::Quantity& quantity : data::quantities())
    if (const auto at = record.worst_state.find(quantity.name); at != record.worst_state.end())
      add(at->first, at->second);
  for (const auto& [name, value] : record.worst_state)
    if (!data::find_quantity(name)) add(name, value);
  return text.empty() ? "\u2013" : text;
}

// Differences that are mere rounding get no digits.
std::string drift_figures(double value) {
  return value > 0 && value < 1e-9 ? "&lt; 1e-9" : figures(value);
}

std::string proven_text(const DriftRecord& r) {
  if (r.proven_MPa) return drift_figures(rounded_up(*r.proven_MPa));
  return r.not_proven.empty() ? "\u2013" : "not available: " + svg::escape(r.not_proven);
}

std::string outside_text(const DriftRecord& r) {
  if (r.n_rows == 0) return "\u2013";
  const double percent = 100 * static_cast<double>(r.n_outside) / static_cast<double>(r.n_rows);
  if (r.n_outside == 0) return "none";
  std::string text = fmt::format("{} ({} %), up to {} MPa off", thousands(r.n_outside),
                                 figures(percent, 2), figures(r.max_abs_outside_MPa));
  for (const verify::BeyondEnd& end : r.beyond)
    text += "<br>" + svg::escape(verify::beyond_text(end));
  return text;
}

// Describes the drift below the range for the table, and for routines whose drift is larger there
// than anywhere in the range; for others it would repeat the table's.
std::string below_text(const DriftRecord& r) {
  if (!r.below || (r.subject != "table" && r.below->max_abs_MPa <= r.worst_case_MPa)) return "";
  return fmt::format("sigma_n_MPa {:.4g} to {:.4g} MPa, below the range ({}): up to {} MPa off",
                     r.below->low_MPa, r.below->high_MPa, r.below->outside,
                     figures(r.below->max_abs_MPa));
}

// For native tables: the fixed states and their error. For routines: rows they could not represent.
std::string subject_text(const DriftRecord& r) {
  std::string text = svg::escape(r.subject);
  for (const std::string& remark : {r.fixed_states ? verify::cost_text(r) : std::string(),
                                    verify::not_representable_text(r), below_text(r)})
    if (!remark.empty()) text += "<br>" + svg::escape(remark);
  return text;
}

const char* result_of(const DriftRecord& r) {
  if (!r.passed) return "failed";
  if (r.over_law_error) return "within the tolerance, but more than the law errs";
  return r.over_by_proof ? "passed as found; over the tolerance by proof" : "passed";
}

// `table`: the record of the table from which the source was made; most sources have their largest
// drift at the same state.
TemplateValues record_row(const DriftRecord& r, const DriftRecord& table) {
  const bool any_rows = r.n_rows > r.n_outside || r.rows.max_abs > 0; // the law answers outside
  const auto on_rows = [&](double value) { return any_rows ? drift_figures(value) : "\u2013"; };
  TemplateValues row;
  row.flags["ran"] = r.ran;
  row.text = {{"model", svg::escape(r.model)},
              {"subject", subject_text(r)},
              {"worst", drift_figures(r.worst_case_MPa)},
              {"proven", proven_text(r)},
              {"state",
               &r != &table && r.worst_state == table.worst_state ? "as the table" : state_text(r)},
              {"vs_table", r.subject == "table" ? "\u2013" : drift_figures(r.max_vs_table_MPa)},
              {"max", on_rows(r.rows.max_abs)},
              {"mean", on_rows(r.rows.mean_abs)},
              {"rms", on_rows(r.rows.rms)},
              {"p99", on_rows(r.rows.p99)},
              {"outside", outside_text(r)},
              {"result", result_of(r)},
              {"result_class", r.passed && !r.over_law_error ? "pass" : "fail"},
              {"why_not", svg::escape(r.why_not)}};
  return row;
}

} // namespace

void add_tables(TemplateValues& page, const ReportInput& input) {
  std::vector<TemplateValues>& tables = page.lists["tables"];
  for (const table::Table& table : input.tables) {
    TemplateValues item;
    const std::string refinement = table.record.refinement.value_or("");
    item.text = {{"model", svg::escape(table.model)},
                 {"summary", summary_of(table) + forms_of(input, table)},
                 {"refinement", svg::escape(refinement)}};
    item.flags = {{"has_axes", !table.axes.empty()},
                  {"has_refinement", !refinement.empty() && !table.axes.empty()}};
    item.lists["axes"] = {};
    for (const table::TableAxis& axis : table.axes)
      item.lists["axes"].push_back(axis_row(input, table, axis));
    tables.push_back(std::move(item));
  }
  page.flags["has_tables"] = !tables.empty();
}

void add_drift(TemplateValues& page, const ReportInput& input) {
  std::vector<TemplateValues>& records = page.lists["records"];
  const DriftRecord* table = nullptr;
  for (const DriftRecord& record : input.verification.records) {
    if (!table || record.subject == "table" || record.model != table->model) table = &record;
    records.push_back(record_row(record, *table));
  }
  page.flags["has_records"] = !records.empty();
  page.text["allowed"] = verify::allowed_text(input.verification);
}

} // namespace frictab::report
