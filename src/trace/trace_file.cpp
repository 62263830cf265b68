// Traces to JSON and back.
#include "trace/trace_file.h"

#include <algorithm>
#include <functional>
#include <limits>

#include <nlohmann/json.hpp>

#include "calibrate/judgement_json.h"
#include "core/error.h"
#include "core/text.h"
#include "core/version.h"
#include "io/json.h"

namespace frictab::trace {

using calibrate::number_or_nan;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema = "frictab/trace/1";

// (JSON has no infinity: null.)
double limit(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

Json derived_json(const std::string& derived) {
  return derived.empty() ? Json() : Json(derived);
}

std::string parse_derived(const Json& j) {
  return j.is_null() ? "" : j.get<std::string>();
}

const char* family_name(bool between) {
  return between ? "between_tests" : "within_tests";
}

Json parameters_json(const TracedEffect& effect) {
  Json list = Json::array();
  for (const TracedParameter& p : effect.parameters) {
    list.push_back(
        {{"name", p.name}, {"value", p.value}, {"std_error", p.std_error}, {"unit", p.unit}});
    if (!p.why_none.empty()) list.back()["no_error_because"] = p.why_none;
  }
  return list;
}

Json alternatives_json(const TracedEffect& effect) {
  Json list = Json::array();
  for (const Alternative& a : effect.alternatives)
    list.push_back({{"name", a.name},
                    {"columns", a.columns},
                    {"derived", derived_json(a.derived)},
                    {"form", a.form},
                    {"acts_on", effects::acts_on_name(a.acts_on)},
                    {"cannot_be_told_apart", a.in_set},
                    {"why_not", a.why_not}});
  return list;
}

Json placed_json(const effects::PlacedEffect& p) {
  Json inputs = Json::array();
  for (const effects::EffectInput& input : p.inputs) {
    Json one = {{"column", input.column}};
    if (input.levels.empty())
      one["held_between"] = {input.low, input.high};
    else
      one["levels"] = input.levels;
    if (!input.knots.empty()) one["knots"] = input.knots;
    inputs.push_back(one);
  }
  Json j = {{"inputs", inputs}, {"values", p.parameters}};
  if (p.stiffness > 0) j["stiffness"] = p.stiffness;
  if (p.acts_on == effects::ActsOn::tau) {
    j["unit_MPa"] = p.tau_scale_MPa;
    j["fades_below_MPa"] = p.pressure_MPa;
  }
  return j;
}

Json curve_json(const EffectCurve& c) {
  return {{"x", c.x},          {"factor", c.factor},   {"low_95", c.low},
          {"high_95", c.high}, {"point_x", c.point_x}, {"point_factor", c.point_factor}};
}

// null: there is nothing to settle, or nothing that would settle it.
Json design_json(const Design& d) {
  if (d.tests.empty()) return nullptr;
  Json tests = Json::array();
  for (const std::vector<std::string>& values : d.tests) {
    Json test;
    for (std::size_t c = 0; c < values.size(); ++c)
      test[d.columns[c]] = values[c];
    tests.push_back(test);
  }
  return {{"settles", d.settles},
          {"columns", d.columns},
          {"tests", tests},
          {"all_else_as_in", d.like},
          {"probability", d.probability},
          {"tests_for_80_percent", d.tests_needed}};
}

Design parse_design(const Json& j) {
  if (j.is_null()) return {};
  Design d{j.at("columns").get<std::vector<std::string>>(),
           {},
           j.at("all_else_as_in"),
           j.at("settles").get<std::vector<std::string>>(),
           number_or_nan(j.at("probability")),
           number_or_nan(j.at("tests_for_80_percent"))};
  for (const Json& test : j.at("tests")) {
    std::vector<std::string> values;
    for (const std::string& column : d.columns)
      values.push_back(test.at(column));
    d.tests.push_back(std::move(values));
  }
  return d;
}

Json effect_json(const TracedEffect& e) {
  return {{"columns", e.columns},
          {"derived", derived_json(e.derived)},
          {"form", e.placed.form->name},
          {"formula", effects::formula_text(e.placed)},
          {"acts_on", effects::acts_on_name(e.placed.acts_on)},
          {"parameters", parameters_json(e)},
          {"family", family_name(e.between)},
          {"p_value", e.p_value},
          {"gain_MPa", e.gain_MPa},
          {"order_confounded", e.order_confounded},
          {"discriminating_design", design_json(e.design)},
          {"alternatives", alternatives_json(e)},
          {"in_the_law", placed_json(e.placed)},
          {"curve", curve_json(e.curve)}};
}

effects::EffectInput parse_input(const Json& j) {
  effects::EffectInput input;
  input.column = j.at("column");
  if (j.contains("levels")) input.levels = j.at("levels").get<std::vector<std::string>>();
  if (j.contains("knots")) input.knots = j.at("knots").get<std::vector<double>>();
  if (j.contains("held_between")) {
    input.low = j.at("held_between").at(0);
    input.high = j.at("held_between").at(1);
  }
  return input;
}

effects::ActsOn parse_acts_on(const std::string& name) {
  if (const auto acts_on = effects::find_acts_on(name)) return *acts_on;
  throw InputError({"trace.json", 0, 0}, "an effect acts on '" + name + "'", "trace again");
}

// As many columns, knots, levels and parameters as the form asks for.
void check_placed(const effects::PlacedEffect& p) {
  const auto ascend = [](const std::vector<double>& knots) {
    return !knots.empty() &&
           std::adjacent_find(knots.begin(), knots.end(), std::greater_equal<>()) == knots.end();
  };
  bool fits = p.inputs.size() == p.form->columns;
  for (std::size_t i = 0; fits && i < p.form->knots.size() && i < p.inputs.size(); ++i)
    fits = p.form->knots[i] == 0 || ascend(p.inputs[i].knots);
  fits = fits && (!p.form->categorical || !p.inputs[0].levels.empty());
  if (!fits || p.parameters.size() != effects::parameters_of(p).size())
    throw InputError({"trace.json", 0, 0}, "an effect has not the parts of its form",
                     "trace again");
}

effects::PlacedEffect parse_placed(const Json& j, const Json& effect) {
  effects::PlacedEffect p;
  p.form = effects::find_effect(effect.at("form").get<std::string>());
  if (!p.form) throw InputError({"trace.json", 0, 0}, "unknown effect form", "trace again");
  for (const Json& input : j.at("inputs"))
    p.inputs.push_back(parse_input(input));
  p.parameters = j.at("values").get<std::vector<double>>();
  if (j.contains("stiffness")) p.stiffness = j.at("stiffness");
  if (j.contains("unit_MPa")) p.tau_scale_MPa = j.at("unit_MPa");
  if (j.contains("fades_below_MPa")) p.pressure_MPa = j.at("fades_below_MPa");
  p.acts_on = parse_acts_on(effect.at("acts_on"));
  check_placed(p);
  return p;
}

std::vector<double> numbers(const Json& j) {
  std::vector<double> values;
  for (const Json& value : j)
    values.push_back(number_or_nan(value));
  return values;
}

TracedEffect parse_effect_json(const Json& j) {
  TracedEffect e;
  e.placed = parse_placed(j.at("in_the_law"), j);
  e.columns = j.at("columns").get<std::vector<std::string>>();
  e.derived = parse_derived(j.at("derived"));
  for (const Json& p : j.at("parameters"))
    e.parameters.push_back({p.at("name"), number_or_nan(p.at("value")),
                            number_or_nan(p.at("std_error")), p.at("unit"),
                            p.value("no_error_because", "")});
  e.between = j.at("family") == family_name(true);
  e.p_value = number_or_nan(j.at("p_value"));
  e.gain_MPa = number_or_nan(j.at("gain_MPa"));
  e.order_confounded = j.at("order_confounded");
  e.design = parse_design(j.at("discriminating_design"));
  for (const Json& a : j.at("alternatives"))
    e.alternatives.push_back({a.at("name"), a.at("columns").get<std::vector<std::string>>(),
                              parse_derived(a.at("derived")), a.at("form"),
                              parse_acts_on(a.at("acts_on")), a.at("cannot_be_told_apart"),
                              a.at("why_not")});
  const Json& c = j.at("curve");
  e.curve = {numbers(c.at("x")),       numbers(c.at("factor")),  numbers(c.at("low_95")),
             numbers(c.at("high_95")), numbers(c.at("point_x")), numbers(c.at("point_factor"))};
  return e;
}

Json leads_json(const std::vector<Lead>& leads) {
  Json list = Json::array();
  for (const Lead& lead : leads)
    list.push_back(
        {{"name", lead.name},
         {"columns", lead.columns},
         {"derived", derived_json(lead.derived)},
         {"form", lead.form},
         {"family", family_name(lead.between)},
         {"p_value", lead.p_value},
         {"share", lead.share},
         {"why_not_added", lead.why},
         {"design", design_json(lead.design)},
         {"significant", lead.significant},
         {"searched_tests_mae_MPa", {{"without", lead.without_MPa}, {"with", lead.with_MPa}}}});
  return list;
}

std::vector<Lead> parse_leads(const Json& j) {
  std::vector<Lead> leads;
  for (const Json& lead : j)
    leads.push_back({lead.at("name"), lead.at("columns").get<std::vector<std::string>>(),
                     parse_derived(lead.at("derived")), lead.at("form"),
                     lead.at("family") == family_name(true), number_or_nan(lead.at("p_value")),
                     number_or_nan(lead.at("share")), lead.at("why_not_added"),
                     parse_design(lead.at("design")), lead.at("significant"),
                     lead.at("searched_tests_mae_MPa").at("without"),
                     lead.at("searched_tests_mae_MPa").at("with")});
  return leads;
}

Json worlds_json(const ValidationShift& w) {
  return {{"apart", w.found},
          {"shift_MPa", w.shift_MPa},
          {"interval_95", {w.interval.low, w.interval.high}},
          {"share", w.share},
          {"p_value", w.p_value}};
}

ValidationShift parse_worlds(const Json& j) {
  return {j.at("apart"),
          number_or_nan(j.at("shift_MPa")),
          {number_or_nan(j.at("interval_95").at(0)), number_or_nan(j.at("interval_95").at(1))},
          number_or_nan(j.at("share")),
          number_or_nan(j.at("p_value"))};
}

Json nested_json(const NestedCheck& n) {
  return {{"folds", n.folds},
          {"gain", n.gain},
          {"std_error", n.std_error},
          {"log_score", n.score},
          {"log_score_std_error", n.score_se},
          {"effects_offered", n.offered},
          {"effects_that_pay", n.paying}};
}

Json difference_json(const calibrate::Difference& gain) {
  return {{"validation_mae_MPa", gain.value_MPa},
          {"interval_95", {gain.interval.low, gain.interval.high}},
          {"p_value", gain.p_value}};
}

calibrate::Difference parse_difference(const Json& j) {
  const Json& interval = j.at("interval_95");
  return {number_or_nan(j.at("validation_mae_MPa")),
          {number_or_nan(interval.at(0)), number_or_nan(interval.at(1))},
          number_or_nan(j.at("p_value"))};
}

Json errors_json(const TraceErrors& errors) {
  return {{"training", calibrate::metrics_json(errors.training)},
          {"validation", calibrate::metrics_json(errors.validation)}};
}

TraceErrors parse_errors(const Json& j) {
  return {calibrate::parse_metrics(j.at("training")), calibrate::parse_metrics(j.at("validation"))};
}

Json detectable_json(const std::vector<Detectable>& all) {
  Json list = Json::array();
  for (const Detectable& d : all)
    list.push_back({{"column", d.column},
                    {"derived", derived_json(d.derived)},
                    {"acts_on", effects::acts_on_name(d.acts_on)},
                    {"identifiable", d.identifiable},
                    {"size_MPa", d.identifiable ? Json(d.size_MPa) : Json()},
                    {"share", d.identifiable ? Json(d.share) : Json()}});
  return list;
}

Json order_json(const OrderStructure& o) {
  return {{"structure", o.found},          {"column", o.column}, {"p_value", o.p_value},
          {"size_MPa", o.size_MPa},        {"share", o.share},   {"order_confounded", o.found},
          {"law_holds_it_at", o.reference}};
}

const char* const verdicts = "effect_added, nothing_missing, nothing_found, unexplained_structure";

Verdict parse_verdict(const std::string& text) {
  for (const Verdict v : {Verdict::effect_added, Verdict::nothing_missing, Verdict::nothing_found,
                          Verdict::unexplained_structure})
    if (text == verdict_name(v)) return v;
  throw InputError({"trace.json", 0, 0}, "unknown verdict '" + text + "'",
                   std::string("known: ") + verdicts);
}

Json aliases_json(const std::vector<Alias>& aliases) {
  Json list = Json::array();
  for (const Alias& one : aliases)
    list.push_back(
        {{"column", one.column}, {"state", one.state}, {"share", one.share}, {"text", one.text}});
  return list;
}

Json one_json(const Trace& t) {
  Json effects = Json::array();
  for (const TracedEffect& effect : t.effects)
    effects.push_back(effect_json(effect));
  const auto& floor = t.noise_floor;
  return {{"model", t.model},
          {"extended_model", derived_json(t.extended_model)},
          {"verdict", verdict_name(t.verdict)},
          {"alpha", t.alpha},
          {"effects", effects},
          {"unseen", t.unseen},
          {"validation_searched", t.validation_searched},
          {"as_calibrated", errors_json(t.as_calibrated)},
          {"before", errors_json(t.before)},
          {"after", errors_json(t.after)},
          {"nested_cross_validation", nested_json(t.nested)},
          {"validation_against_training", worlds_json(t.validation_shift)},
          {"leads", leads_json(t.leads)},
          {"improvement", difference_json(t.improvement)},
          {"improvement_over_calibrated",
           t.over_calibrated ? difference_json(*t.over_calibrated) : Json(nullptr)},
          {"scatter_by_noise_model",
           {{"mae_MPa", floor.mae_MPa}, {"rmse_MPa", floor.rmse_MPa}, {"method", floor.method}}},
          {"scatter_between_experiments",
           {{"share", t.scatter_between},
            {"interval_95", {t.scatter_interval.low, t.scatter_interval.high}},
            {"at_least", t.scatter_at_least},
            {"repeatability", t.repeatability ? Json(*t.repeatability) : Json()},
            {"repeatability_from", t.repeatability_from}}},
          {"smallest_seen_between_halves", t.smallest_seen},
          {"order_of_tests", order_json(t.order)},
          {"remaining",
           {{"structure", t.remaining.structure},
            {"p_value", t.remaining.p_value},
            {"note", t.remaining.note}}},
          {"detectable", detectable_json(t.detectable)},
          {"tried",
           {{"columns", t.n_columns},
            {"directions", t.n_candidates},
            {"sign_flips", t.n_flips},
            {"least_p_value", t.least_p_value}}},
          {"cannot_tell", aliases_json(t.cannot_tell)},
          {"not_identifiable", t.not_identifiable},
          {"rejected", t.rejected},
          {"notes", t.notes}};
}

std::vector<Alias> parse_aliases(const Json& j) {
  std::vector<Alias> aliases;
  for (const Json& one : j)
    aliases.push_back(
        {one.at("column"), one.at("state"), number_or_nan(one.at("share")), one.at("text")});
  return aliases;
}

OrderStructure parse_order(const Json& j) {
  return {j.at("structure"),
          j.at("column"),
          number_or_nan(j.at("p_value")),
          number_or_nan(j.at("size_MPa")),
          number_or_nan(j.at("share")),
          j.at("law_holds_it_at")};
}

Trace parse_one(const Json& j) {
  Trace t;
  t.model = j.at("model");
  t.extended_model = parse_derived(j.at("extended_model"));
  t.verdict = parse_verdict(j.at("verdict"));
  t.alpha = j.at("alpha");
  for (const Json& effect : j.at("effects"))
    t.effects.push_back(parse_effect_json(effect));
  t.unseen = j.at("unseen");
  t.validation_searched = j.at("validation_searched");
  t.as_calibrated = parse_errors(j.at("as_calibrated"));
  t.before = parse_errors(j.at("before"));
  const Json& nested = j.at("nested_cross_validation");
  t.nested = {io::count_of(nested.at("folds")),
              number_or_nan(nested.at("gain")),
              number_or_nan(nested.at("std_error")),
              number_or_nan(nested.at("log_score")),
              number_or_nan(nested.at("log_score_std_error")),
              io::count_of(nested.at("effects_offered")),
              io::count_of(nested.at("effects_that_pay"))};
  t.validation_shift = parse_worlds(j.at("validation_against_training"));
  t.leads = parse_leads(j.at("leads"));
  t.smallest_seen = limit(j.at("smallest_seen_between_halves"));
  t.after = parse_errors(j.at("after"));
  t.improvement = parse_difference(j.at("improvement"));
  if (const auto over = j.find("improvement_over_calibrated"); over != j.end() && !over->is_null())
    t.over_calibrated = parse_difference(*over);
  const Json& floor = j.at(j.contains("noise_floor") ? "noise_floor" // as versions to 0.1.0 wrote
                                                     : "scatter_by_noise_model");
  t.noise_floor.mae_MPa = number_or_nan(floor.at("mae_MPa"));
  t.noise_floor.rmse_MPa = number_or_nan(floor.at("rmse_MPa"));
  t.noise_floor.method = floor.at("method");
  const Json& scatter = j.at("scatter_between_experiments");
  t.scatter_between = number_or_nan(scatter.at("share"));
  t.scatter_interval = {number_or_nan(scatter.at("interval_95").at(0)),
                        number_or_nan(scatter.at("interval_95").at(1))};
  t.scatter_at_least = number_or_nan(scatter.at("at_least"));
  if (!scatter.at("repeatability").is_null()) t.repeatability = scatter.at("repeatability");
  t.repeatability_from = scatter.at("repeatability_from");
  t.order = parse_order(j.at("order_of_tests"));
  t.remaining = {j.at("remaining").at("structure"), number_or_nan(j.at("remaining").at("p_value")),
                 j.at("remaining").at("note")};
  for (const Json& d : j.at("detectable"))
    t.detectable.push_back({d.at("column"), parse_derived(d.at("derived")),
                            parse_acts_on(d.at("acts_on")), number_or_nan(d.at("size_MPa")),
                            number_or_nan(d.at("share")), d.at("identifiable")});
  t.n_columns = io::count_of(j.at("tried").at("columns"));
  t.n_candidates = io::count_of(j.at("tried").at("directions"));
  t.n_flips = io::count_of(j.at("tried").at("sign_flips"));
  t.least_p_value = j.at("tried").at("least_p_value");
  if (j.contains("cannot_tell")) t.cannot_tell = parse_aliases(j.at("cannot_tell"));
  t.not_identifiable = j.at("not_identifiable").get<std::vector<std::string>>();
  t.rejected = j.at("rejected").get<std::vector<std::string>>();
  t.notes = j.at("notes").get<std::vector<std::string>>();
  return t;
}

} // namespace

std::string trace_json(const std::vector<Trace>& traces, bool synthetic) {
  Json j = {{"schema", schema}, {"tool_version", tool_version()}, {"synthetic_data", synthetic}};
  j.update(one_json(traces.front()));
  Json others = Json::array();
  for (std::size_t i = 1; i < traces.size(); ++i)
    others.push_back(one_json(traces[i]));
  if (!others.empty()) j["others"] = others;
  return io::json_text(j);
}

std::vector<Trace> parse_traces(std::string_view text, const std::string& file) {
  const Json j = io::parse_json(text, file);
  io::check_schema(j, schema, file, "trace again");
  std::vector<Trace> traces;
  io::read_json(file, "trace again", [&] {
    traces.push_back(parse_one(j));
    if (j.contains("others"))
      for (const Json& other : j.at("others"))
        traces.push_back(parse_one(other));
  });
  return traces;
}

} // namespace frictab::trace
