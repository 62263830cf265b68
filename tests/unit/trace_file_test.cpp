// Effects in trace.json read back as they were.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/trace_text.h"
#include "trace/trace_file.h"

namespace frictab::trace_file_test {

using effects::find_effect;
using effects::PlacedEffect;
using trace::parse_traces;
using trace::Trace;
using trace::trace_json;
using trace::Verdict;

namespace {

using testing::HasSubstr;

trace::TracedEffect traced(PlacedEffect placed) {
  trace::TracedEffect effect;
  effect.placed = std::move(placed);
  effect.columns = {"tool", "s_mm"};
  return effect;
}

Trace of_coulomb(const char* form, effects::EffectInput input, std::vector<double> parameters) {
  PlacedEffect placed;
  placed.form = find_effect(form);
  placed.inputs = {std::move(input)};
  placed.parameters = std::move(parameters);
  Trace trace;
  trace.model = "coulomb";
  trace.effects = {traced(placed)};
  return trace;
}

Trace with_a_hinge() {
  return of_coulomb("hinge", {"T_tool_C", {}, 20, 120}, {0.5, 70, 50});
}

TEST(TraceFile, EffectsReadBackWithInputsKnotsAndPlace) {
  PlacedEffect curves;
  curves.form = find_effect("spline_by_level");
  curves.inputs = {{"tool", {"A", "B"}}, {"s_mm", {}, 0, 20, {0, 5, 20}}};
  curves.parameters = {0, 0.1, 0.2, 0, -0.1, 0.3};
  curves.stiffness = 12.5;
  PlacedEffect added;
  added.form = find_effect("hinge");
  added.inputs = {{"T_tool_C", {}, 20, 120}};
  added.parameters = {0.5, 70, 50};
  added.acts_on = effects::ActsOn::tau;
  added.tau_scale_MPa = 37.5;
  added.pressure_MPa = 12;
  Trace trace;
  trace.model = "coulomb";
  trace.effects = {traced(curves), traced(added)};
  const std::string text = trace_json({trace}, true);
  const auto again = parse_traces(text, "trace.json");
  ASSERT_EQ(again.front().effects.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const PlacedEffect &one = again.front().effects[i].placed, &other = trace.effects[i].placed;
    EXPECT_EQ(one.form, other.form);
    EXPECT_EQ(one.acts_on, other.acts_on);
    EXPECT_EQ(one.parameters, other.parameters);
    EXPECT_EQ(one.stiffness, other.stiffness);
    EXPECT_EQ(effects::effect_text(one), effects::effect_text(other));
    ASSERT_EQ(one.inputs.size(), other.inputs.size());
    for (std::size_t k = 0; k < one.inputs.size(); ++k) {
      EXPECT_EQ(one.inputs[k].column, other.inputs[k].column);
      EXPECT_EQ(one.inputs[k].levels, other.inputs[k].levels);
      EXPECT_EQ(one.inputs[k].low, other.inputs[k].low);
      EXPECT_EQ(one.inputs[k].high, other.inputs[k].high);
      EXPECT_EQ(one.inputs[k].knots, other.inputs[k].knots);
    }
  }
  EXPECT_EQ(again.front().effects[1].placed.tau_scale_MPa, 37.5);
  EXPECT_EQ(again.front().effects[1].placed.pressure_MPa, 12);
  EXPECT_EQ(trace_json(again, true), text);
}

TEST(TraceFile, GainBesideTheCalibratedLawIsToldWhereWeightsMoveTheLaw) {
  Trace trace = with_a_hinge();
  trace.extended_model = "coulomb_traced";
  trace.as_calibrated.validation.mae_MPa = 8.71;
  trace.before.validation.mae_MPa = 16.3;
  trace.improvement = {7.79, {2.91, 12.7}, 0.01};
  trace.over_calibrated = {0.212, {-0.753, 1.18}, 0.6};
  const std::string json = trace_json({trace}, true);
  const Trace again = parse_traces(json, "trace.json").front();
  EXPECT_EQ(trace_json({again}, true), json);
  EXPECT_THAT(test::trace_text(again),
              HasSubstr("\n  gained on unseen tests: 7.79 MPa (95 %: 2.91 to 12.7, paired by test)"
                        "\n  compared with the calibrated law: 0.212 MPa (95 %: -0.753 to 1.18, "
                        "paired by test)\n"));
  trace.before.validation.mae_MPa = 8.7;
  EXPECT_THAT(test::trace_text(trace), testing::Not(HasSubstr("beside the law as it was")));
}

TEST(TraceFile, AnEffectWithoutThePartsOfItsFormIsRefused) {
  PlacedEffect whole;
  whole.form = find_effect("spline_by_level");
  whole.inputs = {{"tool", {"A", "B"}}, {"s_mm", {}, 0, 20, {0, 5, 20}}};
  whole.parameters = {0, 0.1, 0.2, 0, -0.1, 0.3};
  Trace trace;
  trace.model = "coulomb";
  trace.effects = {traced(whole)};
  const auto good = nlohmann::json::parse(trace_json({trace}, true));
  ASSERT_NO_THROW(parse_traces(good.dump(), "trace.json"));
  const std::vector<std::pair<const char*, nlohmann::json>> damages = {
      {"/values", {0, 0.1}},
      {"/inputs/1/knots", {5, 0, 20}},
      {"/inputs/1/knots", nlohmann::json::array()},
      {"/inputs/0/levels", nlohmann::json::array()},
      {"/inputs", nlohmann::json::array()}};
  for (const auto& [part, damage] : damages) {
    nlohmann::json bad = good;
    bad["effects"][0]["in_the_law"][nlohmann::json::json_pointer(part)] = damage;
    EXPECT_THROW(parse_traces(bad.dump(), "trace.json"), InputError) << part;
  }
}

TEST(TraceFile, AnEffectThatActsNowhereIsRefused) {
  std::string text = trace_json({with_a_hinge()}, true);
  const std::string place = "\"acts_on\": \"mu\"";
  const std::size_t at = text.find(place);
  ASSERT_NE(at, text.npos);
  text.replace(at, place.size(), "\"acts_on\": \"nu\"");
  EXPECT_THAT([&] { parse_traces(text, "trace.json"); },
              testing::ThrowsMessage<InputError>(HasSubstr("acts on 'nu'")));
}

TEST(TraceFile, AParameterWithoutAnErrorSaysWhyInTextAndFile) {
  Trace trace = of_coulomb("step", {"humidity_pct", {}, 30, 60}, {0.2, 60, 2});
  const double none = std::numeric_limits<double>::quiet_NaN();
  trace.effects[0].parameters = {{"a", 0.2, 0.01, "1", ""},
                                 {"x0", 60, none, "%", "at its bound"},
                                 {"w", 2, none, "%", ""}}; // a reference: nobody asks
  EXPECT_THAT(test::trace_text(trace, words::Detail::verbose),
              HasSubstr(": a = 0.200 +- 0.010, x0 = 60.00 % (at its bound)\n"));
  const std::string text = trace_json({trace}, false);
  EXPECT_THAT(text, HasSubstr("\"no_error_because\": \"at its bound\""));
  EXPECT_EQ(trace_json(parse_traces(text, "trace.json"), false), text);
}

TEST(TraceFile, WhatWasNotAddedReadsBackWithItsReasons) {
  Trace trace;
  trace.model = "coulomb";
  trace.unseen = "nested_cross_validation";
  trace.nested = {20, 0.031, 0.007, 0.4, 0.1, 3, 2};
  trace.validation_shift = {true, 57, {41, 76}, 0.21, 1e-6};
  const trace::Design design{
      {"tool", "film_um"}, {{"A", "1.5"}, {"B", "4"}}, "T07", {"tool"}, 0.83, 2};
  trace.leads = {
      {"tool",
       {"tool"},
       "",
       "category",
       true,
       0.004,
       0,
       "contradicted by the validation tests",
       design,
       true,
       15,
       10.2},
      {"dwell", {"s_mm", "v_rel_mm_s"}, "dwell", "hinge", false, 0.3, 0.12, "p = 0.3", {}}};
  trace.scatter_between = 0.04;
  trace.scatter_interval = {0.03, 0.06};
  trace.scatter_at_least = 0.032;
  trace.repeatability = 0.05;
  trace.repeatability_from = "repeats";
  trace.order.column = "run_no";
  trace.order.p_value = 0.4;
  trace.remaining = {true, 0.2, "the validation tests lie beside"};
  for (const double seen : {0.08, std::numeric_limits<double>::infinity()})
    for (const Verdict verdict : {Verdict::effect_added, Verdict::nothing_missing,
                                  Verdict::nothing_found, Verdict::unexplained_structure}) {
      trace.smallest_seen = seen;
      trace.verdict = verdict;
      const std::string text = trace_json({trace}, false);
      const Trace again = parse_traces(text, "trace.json").front();
      EXPECT_EQ(again.verdict, verdict);
      EXPECT_EQ(again.smallest_seen, seen);
      EXPECT_EQ(again.nested.offered, 3u);
      EXPECT_EQ(again.nested.paying, 2u);
      EXPECT_EQ(again.leads.at(1).columns, trace.leads[1].columns);
      EXPECT_EQ(again.leads.at(0).why, trace.leads[0].why);
      EXPECT_TRUE(again.leads.at(0).between);
      EXPECT_TRUE(again.leads.at(0).significant);
      EXPECT_EQ(trace_json({again}, false), text);
      EXPECT_EQ(test::trace_text(again), test::trace_text(trace));
    }
}

TEST(TraceText, WhatIsNotConfirmedComesFirstWithWhatItWouldGain) {
  Trace trace;
  trace.model = "coulomb";
  trace::Lead lead;
  lead.name = "v_rel_mm_s";
  lead.columns = {"v_rel_mm_s"};
  lead.form = "spline";
  lead.p_value = 0.001;
  lead.why = "a search without some of the tests does not find it (10 folds)";
  lead.significant = true;
  lead.without_MPa = 15;
  lead.with_MPa = 10.24;
  trace.leads = {lead};
  const std::string found =
      "not confirmed: v_rel_mm_s (p = 0.001, would take 15.0 to about 10.2 MPa)";
  EXPECT_THAT(words::trace_in_short(trace), testing::StartsWith("coulomb: " + found));
  EXPECT_THAT(test::trace_text(trace, words::Detail::brief), HasSubstr(lead.why));
  trace.leads[0].with_MPa = 15.1; // fits under weights: no such promise
  EXPECT_EQ(words::not_confirmed(trace), "not confirmed: v_rel_mm_s (p = 0.001)");
  trace.leads[0].significant = false;
  EXPECT_THAT(words::trace_in_short(trace),
              testing::StartsWith("coulomb: suspected, not proven: v_rel_mm_s (p = 0.0010)"));
  trace.leads[0].p_value = 0.2; // and no tests to settle it
  EXPECT_THAT(words::trace_in_short(trace),
              testing::StartsWith("coulomb: no missing effect found"));
}

} // namespace
} // namespace frictab::trace_file_test
