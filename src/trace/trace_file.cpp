// Converts traces to JSON and back.
#include "trace/trace_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include "calibrate/judgement_json.h"
#include "core/error.h"
#include "core/no_value.h"
#include "io/json_fields.h"

namespace frictab::trace {

using io::Fields;

namespace {

constexpr const char* schema = "frictab/trace/1";

void describe_family(Fields& f, bool& between) {
  f.one_of("family", between, {{"between_tests", true}, {"within_tests", false}}, {false});
}

void describe_verdict(Fields& f, Verdict& verdict) {
  f.one_of("verdict", verdict,
           {{verdict_name(Verdict::effect_added), Verdict::effect_added},
            {verdict_name(Verdict::nothing_missing), Verdict::nothing_missing},
            {verdict_name(Verdict::nothing_found), Verdict::nothing_found},
            {verdict_name(Verdict::unexplained_structure), Verdict::unexplained_structure}});
}

void describe_acts_on(Fields& f, effects::ActsOn& acts_on) {
  std::string name = effects::acts_on_name(acts_on);
  f("acts_on", name);
  if (!f.reads()) return;
  const auto known = effects::find_acts_on(name);
  if (!known) throw InputError({f.file(), 0, 0}, "an effect acts on '" + name + "'", "trace again");
  acts_on = *known;
}

void describe_form(Fields& f, effects::PlacedEffect& placed) {
  std::string name = f.reads() ? "" : placed.form->name;
  f("form", name);
  if (f.reads()) placed.form = effects::find_effect(name);
  if (!placed.form) f.fail("unknown effect form '" + name + "'");
}

void describe_input(Fields& f, effects::EffectInput& input) {
  f("column", input.column);
  std::pair ends(input.low, input.high);
  if (f.has("held_between", input.levels.empty())) f.known("held_between", ends);
  if (f.reads()) std::tie(input.low, input.high) = ends;
  f.unless_default("levels", input.levels);
  if (f.has("knots", !input.knots.empty())) f.known("knots", input.knots);
}

// Throws InputError unless columns, knots, levels and parameters match the form.
void check_placed(const effects::PlacedEffect& p, const std::string& file) {
  const auto ascend = [](const std::vector<double>& knots) {
    return !knots.empty() &&
           std::ranges::adjacent_find(knots, std::greater_equal<>()) == knots.end();
  };
  bool fits = p.inputs.size() == p.form->columns;
  for (std::size_t i = 0; fits && i < p.form->knots.size() && i < p.inputs.size(); ++i)
    fits = p.form->knots[i] == 0 || ascend(p.inputs[i].knots);
  for (std::size_t i = 0; fits && i < p.form->texts; ++i)
    fits = !p.inputs[i].levels.empty();
  if (!fits || p.parameters.size() != effects::parameters_of(p).size())
    throw InputError({file, 0, 0}, "an effect has not the parts of its form", "trace again");
}

void describe_placed(Fields& f, effects::PlacedEffect& p) {
  f.list("inputs", p.inputs, describe_input);
  f.known("values", p.parameters);
  const bool added = p.acts_on == effects::ActsOn::tau;
  if (f.has("stiffness", p.stiffness > 0)) f.known("stiffness", p.stiffness);
  if (f.has("unit_MPa", added)) f.known("unit_MPa", p.tau_scale_MPa);
  if (f.has("fades_below_MPa", added)) f.known("fades_below_MPa", p.pressure_MPa);
  if (f.reads()) check_placed(p, f.file());
}

void describe_gain(Fields& f, calibrate::Difference& gain) {
  f("validation_mae_MPa", gain.value_MPa);
  f("interval_95", gain.interval);
  f("p_value", gain.p_value);
}

void describe_scatter(Fields& f, Trace& t) {
  const bool old = f.reads() && f.json().contains("noise_floor"); // written up to version 0.1.0
  f.within(old ? "noise_floor" : "scatter_by_noise_model", [&](Fields& floor) {
    floor("mae_MPa", t.noise_floor.mae_MPa);
    floor("rmse_MPa", t.noise_floor.rmse_MPa);
    if (!old) floor("n_experiments", t.noise_floor.n_experiments);
    floor("method", t.noise_floor.method);
  });
  f.within("scatter_between_experiments", [&](Fields& between) {
    between("share", t.scatter_between);
    between("interval_95", t.scatter_interval);
    between("at_least", t.scatter_at_least);
    between("repeatability", t.repeatability);
    between("repeatability_from", t.repeatability_from);
  });
  f("smallest_seen_between_halves", t.smallest_seen);
  if (f.reads() && std::isnan(t.smallest_seen))
    t.smallest_seen = std::numeric_limits<double>::infinity();
}

} // namespace

static void describe(Fields& f, TracedParameter& p) {
  f("name", p.name);
  f("value", p.value);
  f("std_error", p.std_error);
  f("unit", p.unit);
  f.unless_default("no_error_because", p.why_none);
}

static void describe(Fields& f, Alternative& a) {
  f("name", a.name);
  f("columns", a.columns);
  f.null_if_empty("derived", a.derived);
  f("form", a.form);
  describe_acts_on(f, a.acts_on);
  f("cannot_be_told_apart", a.in_set);
  f("why_not", a.why_not);
}

static void describe(Fields& f, EffectCurve& c) {
  f("x", c.x);
  f("factor", c.factor);
  f("low_95", c.low);
  f("high_95", c.high);
  f("point_x", c.point_x);
  f("point_factor", c.point_factor);
}

// Describes the proposed tests; null if nothing is open or no test would settle it.
static void describe(Fields& f, Design& d) {
  if (f.null(d.tests.empty())) return;
  f("settles", d.settles);
  f("columns", d.columns);
  f.list("tests", d.tests, [&](Fields& test, std::vector<std::string>& values) {
    if (f.reads()) values.resize(d.columns.size());
    for (std::size_t c = 0; c < values.size(); ++c)
      test(d.columns[c].c_str(), values[c]);
  });
  f("all_else_as_in", d.like);
  f("probability", d.probability);
  f("tests_for_80_percent", d.tests_needed);
}

static void describe(Fields& f, TracedEffect& e) {
  f("columns", e.columns);
  f.null_if_empty("derived", e.derived);
  describe_form(f, e.placed);
  if (!f.reads()) f.only_written("formula", effects::formula_text(e.placed));
  describe_acts_on(f, e.placed.acts_on);
  f("parameters", e.parameters);
  describe_family(f, e.between);
  f("p_value", e.p_value);
  f("gain_MPa", e.gain_MPa);
  f("order_confounded", e.order_confounded);
  f("discriminating_design", e.design);
  f("alternatives", e.alternatives);
  f.within("in_the_law", [&](Fields& placed) { describe_placed(placed, e.placed); });
  f("curve", e.curve);
}

static void describe(Fields& f, Lead& lead) {
  f("name", lead.name);
  f("columns", lead.columns);
  f.null_if_empty("derived", lead.derived);
  f("form", lead.form);
  describe_family(f, lead.between);
  f("p_value", lead.p_value);
  f("share", lead.share);
  f("why_not_added", lead.why);
  f("design", lead.design);
  f("significant", lead.significant);
  f.within("searched_tests_mae_MPa", [&](Fields& mae) {
    mae.known("without", lead.without_MPa);
    mae.known("with", lead.with_MPa);
  });
}

static void describe(Fields& f, ValidationShift& w) {
  f("apart", w.found);
  f("shift_MPa", w.shift_MPa);
  f("interval_95", w.interval);
  f("share", w.share);
  f("p_value", w.p_value);
}

static void describe(Fields& f, NestedCheck& n) {
  f("folds", n.folds);
  f("gain", n.gain);
  f("std_error", n.std_error);
  f("log_score", n.score);
  f("log_score_std_error", n.score_se);
  f("effects_offered", n.offered);
  f("effects_that_pay", n.paying);
}

static void describe(Fields& f, TraceErrors& errors) {
  f("training", errors.training);
  f("validation", errors.validation);
}

static void describe(Fields& f, Detectable& d) {
  f("column", d.column);
  f.null_if_empty("derived", d.derived);
  describe_acts_on(f, d.acts_on);
  f("identifiable", d.identifiable);
  for (const auto& [key, size] : {std::pair("size_MPa", &d.size_MPa), {"share", &d.share}}) {
    double known = d.identifiable ? *size : no_value;
    f(key, known);
    if (f.reads()) *size = known;
  }
}

static void describe(Fields& f, OrderStructure& o) {
  f("structure", o.found);
  f("column", o.column);
  f("p_value", o.p_value);
  f("size_MPa", o.size_MPa);
  f("share", o.share);
  f.unless_default("change", o.change); // not in files of 0.2.0
  f.unless_default("step_between", o.step);
  f.only_written("order_confounded", o.found);
  f("law_holds_it_at", o.reference);
}

static void describe(Fields& f, Remaining& r) {
  f("structure", r.structure);
  f("p_value", r.p_value);
  f("note", r.note);
}

static void describe(Fields& f, Alias& one) {
  f("column", one.column);
  f("state", one.state);
  f("share", one.share);
  f("text", one.text);
}

static void describe(Fields& f, Trace& t) {
  f("model", t.model);
  f.null_if_empty("extended_model", t.extended_model);
  f.unless_default("chosen_over", t.chosen_over);
  f.unless_default("chosen_over_MPa", t.chosen_over_MPa);
  f.unless_default("chosen_over_before_MPa", t.chosen_over_before_MPa);
  describe_verdict(f, t.verdict);
  f.known("alpha", t.alpha);
  f("effects", t.effects);
  f("unseen", t.unseen);
  f("validation_searched", t.validation_searched);
  f("as_calibrated", t.as_calibrated);
  f("before", t.before);
  f("after", t.after);
  f("nested_cross_validation", t.nested);
  f("validation_against_training", t.validation_shift);
  f("leads", t.leads);
  f.within("improvement", [&](Fields& gain) { describe_gain(gain, t.improvement); });
  if (f.has("improvement_over_calibrated", true))
    f.within("improvement_over_calibrated", [&](Fields& gain) {
      if (!gain.null(!t.over_calibrated))
        describe_gain(gain, f.reads() ? t.over_calibrated.emplace() : *t.over_calibrated);
    });
  describe_scatter(f, t);
  f("order_of_tests", t.order);
  f("remaining", t.remaining);
  f("detectable", t.detectable);
  f.within("tried", [&](Fields& tried) {
    tried("columns", t.n_columns);
    tried("directions", t.n_candidates);
    tried("sign_flips", t.n_flips);
    tried.known("least_p_value", t.least_p_value);
  });
  if (f.has("cannot_tell", true)) f("cannot_tell", t.cannot_tell);
  f("not_identifiable", t.not_identifiable);
  f("rejected", t.rejected);
  f("notes", t.notes);
}

namespace {

void describe_file(Fields& f, std::vector<Trace>& traces) {
  describe(f, traces.front());
  if (!f.has("others", traces.size() > 1)) return;
  const std::size_t others = f.reads() ? f.json().at("others").size() : traces.size() - 1;
  f.each("others", others, [&](Fields& other, std::size_t i) {
    describe(other, f.reads() ? traces.emplace_back() : traces[i + 1]);
  });
}

} // namespace

std::string trace_json(const std::vector<Trace>& traces, bool synthetic) {
  return io::record_text(schema, [&](Fields& f) {
    f.only_written("synthetic_data", synthetic);
    describe_file(f, io::to_write(traces));
  });
}

std::vector<Trace> parse_traces(std::string_view text, const std::string& file) {
  std::vector<Trace> traces(1);
  io::read_record(text, file, schema, "trace again", [&](Fields& f) { describe_file(f, traces); });
  return traces;
}

} // namespace frictab::trace
