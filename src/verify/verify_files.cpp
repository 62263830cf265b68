// verify.json and JUnit XML.
#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "core/version.h"
#include "io/json.h"
#include "verify/verify.h"

namespace frictab::verify {

namespace {

using Json = nlohmann::ordered_json;

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
  return fmt::format("worst case {:.6g} MPa over the range at {}{}{}; allowed {:.6g} MPa{}",
                     record.worst_case_MPa, state, on_rows, below, record.allowed_MPa, answered);
}

std::string proof_text(const DriftRecord& record) {
  return record.proven_MPa
             ? fmt::format("{:.6g} MPa found, but only {:.6g} MPa proven; allowed {:.6g} MPa",
                           record.worst_case_MPa, *record.proven_MPa, record.allowed_MPa)
             : "not proven: " + record.not_proven;
}

Json beyond_json(const BeyondEnd& end) {
  return {{"axis", end.axis}, {"side", end.side}, {"outside", end.outside},
          {"end", end.end},   {"rows", end.rows}, {"largest_excess", end.largest_excess}};
}

Json record_json(const DriftRecord& record) {
  Json j = {{"model", record.model}, {"subject", record.subject}, {"ran", record.ran}};
  if (!record.ran) {
    j["why_not"] = record.why_not;
    return j;
  }
  j["passed"] = record.passed;
  j["allowed_MPa"] = record.allowed_MPa;
  if (!record.allowed_from.empty()) j["allowed_from"] = record.allowed_from;
  if (record.law_error_MPa) j["law_error_MPa"] = *record.law_error_MPa;
  if (record.over_law_error) j["over_law_error"] = true;
  j["max_abs_MPa"] = record.rows.max_abs;
  j["mean_abs_MPa"] = record.rows.mean_abs;
  j["rms_MPa"] = record.rows.rms;
  j["p99_MPa"] = record.rows.p99;
  j["n_rows"] = record.n_rows;
  j["share_outside"] = record.n_rows == 0 ? 0.0
                                          : static_cast<double>(record.n_outside) /
                                                static_cast<double>(record.n_rows);
  j["outside"] = Json::array();
  for (const BeyondEnd& end : record.beyond)
    j["outside"].push_back(beyond_json(end));
  j["max_abs_outside_MPa"] = record.max_abs_outside_MPa;
  j["n_refused"] = record.n_refused;
  if (record.n_rows_not_representable > 0) j["n_rows_not_posed"] = record.n_rows_not_representable;
  if (record.n_points_not_representable > 0)
    j["n_points_not_posed"] = record.n_points_not_representable;
  if (record.n_not_refused > 0) j["n_not_refused"] = record.n_not_refused;
  j["worst_case_MPa"] = record.worst_case_MPa;
  j["worst_case_at"] = record.worst_state;
  j["n_points"] = record.n_points;
  if (record.unit_roundoff > 0) j["unit_roundoff"] = record.unit_roundoff;
  if (record.subject != "table") j["max_vs_table_MPa"] = record.max_vs_table_MPa;
  if (record.proven_MPa) j["proven_MPa"] = *record.proven_MPa;
  if (!record.not_proven.empty()) j["not_proven"] = record.not_proven;
  if (record.proof_boxes > 0) j["proof_boxes"] = record.proof_boxes;
  if (record.over_by_proof) j["over_by_proof"] = true;
  if (record.out_of_boxes) j["out_of_boxes"] = true;
  if (record.below)
    j["below"] = {{"axis", "sigma_n_MPa"},
                  {"low", record.below->low_MPa},
                  {"high", record.below->high_MPa},
                  {"outside", record.below->outside},
                  {"n_points", record.below->n_points},
                  {"max_abs_MPa", record.below->max_abs_MPa}};
  if (record.held) {
    j["held"] = Json::object();
    for (const auto& [name, value] : *record.held)
      j["held"][name] = value;
    j["cost_mean_abs_MPa"] = record.cost_mean_abs_MPa;
    j["cost_max_abs_MPa"] = record.cost_max_abs_MPa;
  }
  return j;
}

// Returns null if nothing failed but something was not tested.
Json passed_json(const Verification& verification) {
  if (verification.passed() && verification.untested() > 0) return nullptr;
  return verification.passed();
}

} // namespace

std::string verification_json(const Verification& verification) {
  Json records = Json::array();
  for (const DriftRecord& record : verification.records)
    records.push_back(record_json(record));
  Json j = {{"schema", schema},
            {"tool_version", tool_version()},
            {"max_drift_MPa", verification.max_drift_MPa},
            {"passed", passed_json(verification)},
            {"untested", verification.untested()}};
  if (verification.require_proof) j["require_proof"] = true;
  if (verification.require_run) j["require_run"] = true;
  j["records"] = records;
  return io::json_text(j);
}

namespace {

std::size_t count_or_0(const Json& j, const char* key) {
  return j.contains(key) ? io::count_of(j.at(key)) : 0;
}

// Reads a share and returns it as a number of `rows`.
std::size_t share_of(const Json& j, std::size_t rows) {
  const double share = j.get<double>();
  if (!(share >= 0 && share <= 1) || rows > (std::size_t{1} << 50))
    throw Json::type_error::create(302, "a share of rows is a number from 0 to 1", &j);
  return static_cast<std::size_t>(share * static_cast<double>(rows) + 0.5);
}

} // namespace

Verification parse_verification(std::string_view text, const std::string& file) {
  const Json j = io::parse_json(text, file);
  io::check_schema(j, schema, file, "run frictab verify again");
  try {
    Verification verification;
    verification.max_drift_MPa = j.at("max_drift_MPa");
    verification.require_proof = j.value("require_proof", false);
    verification.require_run = j.value("require_run", false);
    for (const Json& one : j.at("records")) {
      DriftRecord r;
      r.model = one.at("model");
      r.subject = one.at("subject");
      r.ran = one.at("ran");
      if (r.ran) {
        r.passed = one.at("passed");
        // Missing in files of version 0.1.
        r.allowed_MPa = one.value("allowed_MPa", verification.max_drift_MPa);
        r.allowed_from = one.value("allowed_from", "");
        if (one.contains("law_error_MPa")) r.law_error_MPa = one.at("law_error_MPa");
        r.over_law_error = one.value("over_law_error", false);
        r.rows = {one.at("max_abs_MPa"), one.at("mean_abs_MPa"), one.at("rms_MPa"),
                  one.at("p99_MPa")};
        r.n_rows = io::count_of(one.at("n_rows"));
        r.n_outside = share_of(one.at("share_outside"), r.n_rows);
        for (const Json& end : one.at("outside"))
          r.beyond.push_back({end.at("axis"), end.at("side"), end.at("outside"), end.at("end"),
                              io::count_of(end.at("rows")), end.at("largest_excess")});
        r.max_abs_outside_MPa = one.at("max_abs_outside_MPa");
        r.n_refused = io::count_of(one.at("n_refused"));
        r.n_rows_not_representable = count_or_0(one, "n_rows_not_posed");
        r.n_points_not_representable = count_or_0(one, "n_points_not_posed");
        r.n_not_refused = count_or_0(one, "n_not_refused");
        r.worst_case_MPa = one.at("worst_case_MPa");
        r.worst_state = one.at("worst_case_at").get<std::map<std::string, double>>();
        r.n_points = io::count_of(one.at("n_points"));
        r.unit_roundoff = one.value("unit_roundoff", 0.0);
        r.max_vs_table_MPa = one.value("max_vs_table_MPa", 0.0);
        if (one.contains("proven_MPa")) r.proven_MPa = one.at("proven_MPa");
        r.not_proven = one.value("not_proven", "");
        r.proof_boxes = count_or_0(one, "proof_boxes");
        r.over_by_proof = one.value("over_by_proof", false);
        r.out_of_boxes = one.value("out_of_boxes", false);
        if (one.contains("below")) {
          const Json& below = one.at("below");
          r.below = {below.at("low"), below.at("high"), below.at("outside"),
                     io::count_of(below.at("n_points")), below.at("max_abs_MPa")};
        }
        if (one.contains("held")) {
          r.held = one.at("held").get<std::map<std::string, double>>();
          r.cost_mean_abs_MPa = one.at("cost_mean_abs_MPa");
          r.cost_max_abs_MPa = one.at("cost_max_abs_MPa");
        }
      } else {
        r.why_not = one.at("why_not");
        r.allowed_MPa = verification.max_drift_MPa;
      }
      verification.records.push_back(std::move(r));
    }
    return verification;
  } catch (const Json::exception& error) {
    throw InputError({file, 0, 0}, std::string("not as frictab writes it: ") + error.what(),
                     "run frictab verify again");
  }
}

namespace {

std::string why_failed(const DriftRecord& record) {
  if (!record.ran) return "not run: " + record.why_not;
  return record.passed ? proof_text(record) : failure_text(record);
}

} // namespace

namespace {

void add_property(pugi::xml_node properties, const std::string& name, const std::string& value) {
  pugi::xml_node property = properties.append_child("property");
  property.append_attribute("name") = name.c_str();
  property.append_attribute("value") = value.c_str();
}

// Adds the figures of verify.json, also for cases that passed, so that a CI pipeline can plot them.
void add_figures(pugi::xml_node test, const DriftRecord& record) {
  const Json figures = record_json(record);
  pugi::xml_node properties = test.append_child("properties");
  for (const auto& [name, value] : figures.items())
    if (value.is_number()) add_property(properties, name, value.dump());
}

} // namespace

// Leaves out times, so that the same job gives the same bytes.
std::string verification_junit(const Verification& verification) {
  pugi::xml_document document;
  pugi::xml_node suite = document.append_child("testsuites").append_child("testsuite");
  std::size_t failures = 0, skipped = 0;
  for (const DriftRecord& record : verification.records) {
    failures += verification.failed(record);
    skipped += !record.ran && !verification.failed(record);
  }
  suite.append_attribute("name") = "frictab verify";
  suite.append_attribute("tests") = static_cast<unsigned>(verification.records.size());
  suite.append_attribute("failures") = static_cast<unsigned>(failures);
  suite.append_attribute("skipped") = static_cast<unsigned>(skipped);
  pugi::xml_node of_all = suite.append_child("properties");
  add_property(of_all, "tool_version", tool_version());
  add_property(of_all, "max_drift_MPa", Json(verification.max_drift_MPa).dump());
  for (const DriftRecord& record : verification.records) {
    pugi::xml_node test = suite.append_child("testcase");
    test.append_attribute("classname") = record.model.c_str();
    test.append_attribute("name") = record.subject.c_str();
    if (record.ran) add_figures(test, record);
    if (verification.failed(record))
      test.append_child("failure").append_attribute("message") = why_failed(record).c_str();
    else if (!record.ran)
      test.append_child("skipped").append_attribute("message") = record.why_not.c_str();
  }
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

} // namespace frictab::verify
