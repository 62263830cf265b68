// Writes a judgement as JSON.
#include "process/process_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/version.h"
#include "io/json.h"
#include "table/distance.h"

namespace frictab::process {

namespace {

using Json = nlohmann::ordered_json;

const char* prediction_name(Prediction prediction) {
  switch (prediction) {
  case Prediction::force:
    return "force";
  case Prediction::no_tool:
    return "no_tool";
  case Prediction::force_driven:
    return "force_driven";
  case Prediction::energy_driven:
    return "energy_driven";
  case Prediction::contact_changes:
    return "contact_changes";
  }
  return "";
}

Json json_of(const Share& share) {
  return {{"work", share.work}, {"area_time", share.contact}};
}

Json json_of(const StateCoverage& s) {
  return {{"state", s.state},
          {"unit", s.unit},
          {"tested", {s.tested_low, s.tested_high}},
          {"process", {s.low, s.high}},
          {"median", s.median},
          {"below", json_of(s.below)},
          {"above", json_of(s.above)},
          {"thin", json_of(s.thin)}};
}

Json json_of(const PartCoverage& part) {
  return {
      {"part", part.name}, {"share", part.share}, {"outside", part.outside}, {"thin", part.thin}};
}

Json json_of(const Setting& at) {
  Json j = Json::object();
  for (std::size_t s = 0; s < at.size(); ++s)
    if (std::isfinite(at[s])) j[setting_names[s]] = at[s];
  return j;
}

Json json_of(const OutOfReach& one) {
  return {{"state", one.state},
          {"limit", one.limit},
          {"side", one.below ? "below" : "above"},
          {"share", one.share},
          {"median", one.median}};
}

Json json_of(const Held& held) {
  Json j = {{"state", held.state}, {"value", held.value}, {"why", held.why}};
  if (held.high > held.low) {
    j["between"] = {held.low, held.high};
    j["cost_percent"] = held.cost_percent;
  }
  return j;
}

template <class T> Json list_of(const std::vector<T>& all) {
  Json list = Json::array();
  for (const T& one : all)
    list.push_back(json_of(one));
  return list;
}

Json json_of(const Coverage& c) {
  return {{"outside", json_of(c.outside)}, {"thin", json_of(c.thin)},
          {"states", list_of(c.states)},   {"further", list_of(c.further)},
          {"stroke", list_of(c.stroke)},   {"surface", list_of(c.surface)}};
}

Json json_of(const LawThere& law, Prediction prediction) {
  Json j = {{"law", law.law},
            {"candidate", law.candidate},
            {"leads", law.leads},
            {"may_be_best", law.may_be_best},
            {"best_in", law.best_in},
            {"near_error", law.near_error},
            {"tau_MPa", law.tau_MPa},
            {"differs_MPa", law.differs_MPa},
            {"late_percent", law.late_percent},
            {"end_percent", law.end_percent}};
  if (prediction == Prediction::force) {
    const stats::Interval range = shown_range(law.late_percent);
    j["late_percent_range"] = {range.low, range.high};
    j["rerun"] = std::abs(law.late_percent) > rerun_percent;
  }
  if (!law.force_kN.empty() && prediction == Prediction::force) j["force_kN"] = law.force_kN;
  return j;
}

Json json_of(const Resampled& r) {
  Json laws = Json::array();
  for (const Resampled::OfLaw& law : r.laws)
    laws.push_back({{"law", law.law}, {"chosen", law.share}, {"sd_percent", law.sd_percent}});
  return {{"draws", r.draws},
          {"late_percent_95", {r.late_percent.low, r.late_percent.high}},
          {"median_percent", r.median_percent},
          {"laws", laws}};
}

Json json_of(const Assessment& v, Prediction prediction) {
  Json laws = Json::array();
  for (const LawThere& law : v.laws)
    laws.push_back(json_of(law, prediction));
  Json j = {{"tests", v.tests},
            {"take", v.take},
            {"leading_percent", {v.low_percent, v.high_percent}},
            {"not_ruled_out_percent", {v.all_low_percent, v.all_high_percent}},
            {"leading_differ_MPa", v.differ_MPa},
            {"thin", v.thin},
            {"open_ln_tau", v.open}};
  if (v.resampled.draws > 0) j["resampled"] = json_of(v.resampled);
  if (v.parameter)
    j["parameter"] = {{"law", v.parameter->law},
                      {"name", v.parameter->parameter},
                      {"percent", v.parameter->percent}};
  j["laws"] = laws;
  return j;
}

Json json_of(const ProposedTests& t) {
  if (t.tests.empty()) return {{"none", t.why_none}};
  Json rig = Json::object();
  for (const auto& [name, range] : t.rig)
    rig[name] = {range.first, range.second};
  return {{"tests", list_of(t.tests)},
          {"repeated", t.repeated},
          {"centres", list_of(t.centres)},
          {"rig", rig},
          {"open_ln_tau", t.open},
          {"open_with_tests", t.with_tests},
          {"open_with_centres", t.with_centres},
          {"open_with_repeats", t.with_repeats},
          {"out_of_reach", list_of(t.out_of_reach)}};
}

// Some states by friction work, for explore.html.
Json states_json(const Process& p) {
  constexpr std::size_t drawn = 300;
  const std::vector<std::size_t> rows = drawn_by_work(p.work_J, drawn);
  Json states = Json::object();
  for (const data::Column& column : p.history.states.columns) {
    if (!column.levels.empty() || column.name == "time_s") continue;
    Json& values = states[column.name] = Json::array();
    for (const std::size_t row : rows)
      values.push_back(column.values[row]);
  }
  return states;
}

} // namespace

std::string process_json(const Process& p, const std::vector<std::string>& in_short) {
  Json j = {{"schema", "frictab/process/1"},
            {"tool_version", tool_version()},
            {"synthetic_data", p.synthetic},
            {"in_short", in_short},
            {"contact", p.history.states.sources},
            {"contacts", p.history.rows()},
            {"facets", p.history.facets},
            {"increments", p.history.time_s.size()},
            {"used", p.used.name},
            {"prediction", prediction_name(p.prediction)}};
  if (p.driven_was_found) j["prediction_from"] = "the course of force and speed";
  if (p.work_check_percent) j["work_check_percent"] = *p.work_check_percent;
  if (p.work_share_percent > 0) j["friction_share_of_work_percent"] = p.work_share_percent;
  if (p.used.solver_over_law > 0) j["solver_over_law"] = p.used.solver_over_law;
  j["coverage"] = json_of(p.coverage);
  j["held"] = list_of(p.history.held);
  j["assessment"] = json_of(p.assessment, p.prediction);
  if (p.with_added) j["with_added"] = json_of(*p.with_added, p.prediction);
  j["next"] = json_of(p.proposed);
  j["states"] = states_json(p);
  j["time_s"] = p.history.time_s;
  if (p.history.tool) j["force_kN"] = p.history.tool->force_kN;
  j["cautions"] = p.cautions;
  j["notes"] = p.history.notes;
  return io::json_text(j);
}

} // namespace frictab::process
