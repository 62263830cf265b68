// verify.json and JUnit XML.
#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "core/text.h"
#include "core/version.h"
#include "io/json_fields.h"
#include "verify/verify.h"

namespace frictab::verify {

using io::Fields;

namespace {

constexpr const char* schema = "frictab/verify/1";

std::string failure_text(const DriftRecord& record) {
  std::string state;
  for (const auto& [name, value] : record.worst_state)
    state += fmt::format("{}{} = {}", state.empty() ? "" : ", ", name, value);
  const std::string answered =
      record.n_not_refused == 0
          ? ""
          : fmt::format("; {} rows answered by a number where outside = error",
                        record.n_not_refused);
  const std::string below =
      record.below && record.below->outside == "law"
          ? fmt::format("; {:.6g} MPa below the range", record.below->max_abs_MPa)
          : "";
  const std::string on_rows =
      record.n_rows == 0 ? "" : fmt::format("; {:.6g} MPa on the rows", record.rows.max_abs);
  if (const std::string fault = path_fault(record); !fault.empty()) return fault;
  const std::string allowed =
      record.stated_loss_MPa
          ? fmt::format("{:.6g} MPa is what its files state", *record.stated_loss_MPa)
          : fmt::format("allowed {:.6g} MPa", record.allowed_MPa);
  return fmt::format("worst case {:.6g} MPa over the range at {}{}{}; {}{}", record.worst_case_MPa,
                     state, on_rows, below, allowed, answered);
}

std::string proof_text(const DriftRecord& record) {
  return record.proven_MPa
             ? fmt::format("{:.6g} MPa found, but only {:.6g} MPa proven; allowed {:.6g} MPa",
                           record.worst_case_MPa, *record.proven_MPa, record.allowed_MPa)
             : "not proven: " + record.not_proven;
}

// Describes the number of rows outside the range as a share of all rows.
void describe_share_outside(Fields& f, DriftRecord& r) {
  const auto rows = static_cast<double>(r.n_rows);
  double share = r.n_rows == 0 ? 0 : static_cast<double>(r.n_outside) / rows;
  f.known("share_outside", share);
  if (!f.reads()) return;
  if (!(share >= 0 && share <= 1) || r.n_rows > (std::size_t{1} << 50))
    f.fail("a share of rows is a number from 0 to 1");
  r.n_outside = static_cast<std::size_t>(share * rows + 0.5);
}

} // namespace

static void describe(Fields& f, BeyondEnd& end) {
  f("axis", end.axis);
  f("side", end.side);
  f("outside", end.outside);
  f.known("end", end.end);
  f("rows", end.rows);
  f.known("largest_excess", end.largest_excess);
}

static void describe(Fields& f, BelowRange& below) {
  f.only_written("axis", "sigma_n_MPa");
  f.known("low", below.low_MPa);
  f.known("high", below.high_MPa);
  f("outside", below.outside);
  f("n_points", below.n_points);
  f.known("max_abs_MPa", below.max_abs_MPa);
}

static void describe_path(Fields& f, codegen::PathResult& path) {
  f("increments", path.increments);
  f("points", path.points);
  f.only_written("passed", path.passed());
  f.list("figures", path.figures, [](Fields& one, codegen::PathFigure& figure) {
    one("quantity", figure.quantity);
    one("unit", figure.unit);
    one.known("max_abs_error", figure.largest_error);
    one.known("of_allowed", figure.of_allowed);
    one("compared", figure.compared);
  });
}

static void describe(Fields& f, DriftRecord& r) {
  f("model", r.model);
  f("subject", r.subject);
  f("ran", r.ran);
  if (!r.ran) {
    f("why_not", r.why_not);
    f.unless_default("broken", r.broken);
    return;
  }
  f("passed", r.passed);
  if (f.has("allowed_MPa", true)) f.known("allowed_MPa", r.allowed_MPa); // not in files of 0.1
  f.unless_default("allowed_from", r.allowed_from);
  f.if_known("law_error_MPa", r.law_error_MPa);
  f.unless_default("over_law_error", r.over_law_error);
  f.if_known("stated_loss_MPa", r.stated_loss_MPa);
  f.known("max_abs_MPa", r.rows.max_abs);
  f.known("mean_abs_MPa", r.rows.mean_abs);
  f.known("rms_MPa", r.rows.rms);
  f.known("p99_MPa", r.rows.p99);
  f("n_rows", r.n_rows);
  describe_share_outside(f, r);
  f("outside", r.beyond);
  f.known("max_abs_outside_MPa", r.max_abs_outside_MPa);
  f("n_refused", r.n_refused);
  f.unless_default("n_rows_not_posed", r.n_rows_not_representable);
  f.unless_default("n_points_not_posed", r.n_points_not_representable);
  f.unless_default("n_not_refused", r.n_not_refused);
  f.known("worst_case_MPa", r.worst_case_MPa);
  f.known("worst_case_at", r.worst_state);
  f("n_points", r.n_points);
  if (f.has("unit_roundoff", r.unit_roundoff > 0)) f.known("unit_roundoff", r.unit_roundoff);
  if (f.has("max_vs_table_MPa", r.subject != "table"))
    f.known("max_vs_table_MPa", r.max_vs_table_MPa);
  f.if_known("proven_MPa", r.proven_MPa);
  f.unless_default("not_proven", r.not_proven);
  f.unless_default("proof_boxes", r.proof_boxes);
  f.unless_default("over_by_proof", r.over_by_proof);
  f.unless_default("out_of_boxes", r.out_of_boxes);
  f.if_there("below", r.below);
  f.if_known("held", r.fixed_states);
  if (r.fixed_states) {
    f.known("cost_mean_abs_MPa", r.cost_mean_abs_MPa);
    f.known("cost_max_abs_MPa", r.cost_max_abs_MPa);
  }
  if (!f.has("path", r.path.has_value())) return;
  if (f.reads()) r.path.emplace();
  f.within("path", [&](Fields& inner) { describe_path(inner, *r.path); });
}

static void describe(Fields& f, Finding& finding) {
  f.unless_default("model", finding.model);
  f("file", finding.file);
  f.unless_default("where", finding.where);
  f("what", finding.what);
  f.unless_default("mend", finding.mend);
  f("failed", finding.failed);
}

static void describe(Fields& f, Verification& v) {
  f.known("max_drift_MPa", v.max_drift_MPa);
  const bool open = v.passed() && v.untested() > 0; // nothing failed, something was not tested
  f.only_written("passed", open ? Fields::Json() : Fields::Json(v.passed()));
  f.only_written("untested", v.untested());
  f.unless_default("require_proof", v.require_proof);
  f.unless_default("require_run", v.require_run);
  f.list("records", v.records, [&](Fields& one, DriftRecord& record) {
    if (one.reads()) record.allowed_MPa = v.max_drift_MPa;
    describe(one, record);
  });
  f.unless_default("findings", v.findings);
}

std::string verification_json(const Verification& verification) {
  return io::record_text(schema, [&](Fields& f) { describe(f, io::to_write(verification)); });
}

Verification parse_verification(std::string_view text, const std::string& file) {
  Verification verification;
  io::read_record(text, file, schema, "run frictab verify again",
                  [&](Fields& f) { describe(f, verification); });
  return verification;
}

namespace {

std::string why_failed(const DriftRecord& record) {
  if (!record.ran) return (record.broken ? "" : "not run: ") + record.why_not;
  return record.passed ? proof_text(record) : failure_text(record);
}

void set_attribute(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_attribute(name) = printable(text).c_str();
}

void add_property(pugi::xml_node properties, const std::string& name, const std::string& value) {
  pugi::xml_node property = properties.append_child("property");
  set_attribute(property, "name", name);
  set_attribute(property, "value", value);
}

pugi::xml_node add_test(pugi::xml_node suite, const std::string& group, const std::string& name) {
  pugi::xml_node test = suite.append_child("testcase");
  set_attribute(test, "classname", group);
  set_attribute(test, "name", name);
  return test;
}

// Returns a suite with these counts, in this order.
pugi::xml_node add_suite(pugi::xml_document& document,
                         const std::vector<std::pair<const char*, std::size_t>>& counts) {
  pugi::xml_node suite = document.append_child("testsuites").append_child("testsuite");
  set_attribute(suite, "name", "frictab verify");
  for (const auto& [name, count] : counts)
    suite.append_attribute(name) = static_cast<unsigned>(count);
  add_property(suite.append_child("properties"), "tool_version", tool_version());
  return suite;
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

// Adds the figures of verify.json, also for cases that passed, so that a CI pipeline can plot them.
void add_figures(pugi::xml_node test, const DriftRecord& record) {
  Fields::Json figures;
  Fields fields(figures);
  describe(fields, io::to_write(record));
  pugi::xml_node properties = test.append_child("properties");
  for (const auto& [name, value] : figures.items())
    if (value.is_number()) add_property(properties, name, value.dump());
  if (record.path)
    for (const codegen::PathFigure& figure : record.path->figures)
      add_property(properties, "path: " + figure.quantity,
                   Fields::Json(figure.largest_error).dump());
}

void add_finding(pugi::xml_node suite, const Finding& finding) {
  pugi::xml_node test =
      add_test(suite, finding.file, finding.where.empty() ? finding.what : finding.where);
  const std::string text = finding.text() + (finding.mend.empty() ? "" : "; " + finding.mend);
  if (finding.failed)
    set_attribute(test.append_child("failure"), "message", text);
  else
    test.append_child("system-out").text() = printable(text).c_str();
}

} // namespace

// Leaves out times, so that the same job gives the same bytes.
std::string verification_junit(const Verification& verification) {
  std::size_t failures = 0, skipped = 0;
  for (const DriftRecord& record : verification.records) {
    failures += verification.failed(record);
    skipped += !record.ran && !verification.failed(record);
  }
  for (const Finding& finding : verification.findings)
    failures += finding.failed;
  pugi::xml_document document;
  pugi::xml_node suite =
      add_suite(document, {{"tests", verification.records.size() + verification.findings.size()},
                           {"failures", failures},
                           {"skipped", skipped}});
  add_property(suite.child("properties"), "max_drift_MPa",
               Fields::Json(verification.max_drift_MPa).dump());
  for (const DriftRecord& record : verification.records) {
    pugi::xml_node test = add_test(suite, record.model, record.subject);
    if (record.ran) add_figures(test, record);
    if (verification.failed(record))
      set_attribute(test.append_child("failure"), "message", why_failed(record));
    else if (!record.ran)
      set_attribute(test.append_child("skipped"), "message", record.why_not);
  }
  for (const Finding& finding : verification.findings)
    add_finding(suite, finding);
  return text_of(document);
}

std::string failure_junit(const std::vector<Fault>& faults) {
  pugi::xml_document document;
  pugi::xml_node suite =
      add_suite(document, {{"tests", faults.size()}, {"errors", faults.size()}, {"failures", 0}});
  for (const Fault& fault : faults) {
    const std::string place = format_place(fault.place);
    pugi::xml_node test = add_test(suite, place.empty() ? "verify" : place, fault.what);
    set_attribute(test.append_child("error"), "message",
                  (place.empty() ? "" : place + ": ") + fault.what +
                      (fault.hint.empty() ? "" : "; hint: " + fault.hint));
  }
  return text_of(document);
}

} // namespace frictab::verify
