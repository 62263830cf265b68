// Effects in trace.json read back as they were.
#include <gtest/gtest.h>

#include "trace/trace_file.h"

namespace frictab {
namespace {

TracedEffect traced(PlacedEffect placed) {
  TracedEffect effect;
  effect.placed = std::move(placed);
  effect.columns = {"tool", "s_mm"};
  return effect;
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
  added.acts_on = "tau";
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
    EXPECT_EQ(effect_text(one), effect_text(other));
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

} // namespace
} // namespace frictab
