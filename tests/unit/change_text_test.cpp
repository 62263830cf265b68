// Effects in one line, and claims about every form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "effects/change_text.h"

namespace frictab::change_text_test {

using effects::change_text;
using effects::EffectInput;
using effects::find_effect;
using effects::PlacedEffect;

namespace {

PlacedEffect effect_of(const char* form, std::vector<EffectInput> inputs,
                       std::vector<double> parameters) {
  PlacedEffect effect;
  effect.form = find_effect(form);
  effect.inputs = std::move(inputs);
  effect.parameters = std::move(parameters);
  return effect;
}

TEST(ChangeText, OfOneQuantityIsTheChangeOverItsRange) {
  // 1 + a (x - x0)/w: 1.1 at 0, 0.9 at 20.
  EXPECT_EQ(change_text(effect_of("linear", {{"OA", {}, 0, 20}}, {-0.1, 10, 10})),
            "friction -18 % from 0 to 20");
}

TEST(ChangeText, SaysWhereAnExtremeLiesBetweenTheEnds) {
  EXPECT_EQ(change_text(effect_of("bump", {{"angle", {}, 0, 180}}, {-0.2, 90, 20})),
            "friction +0 % from 0 to 180, lowest (-20 %) at 90");
}

TEST(ChangeText, OfLevelsIsAgainstTheFirst) {
  EXPECT_EQ(change_text(effect_of("category", {{"oil", {"A", "B", "C"}}}, {0.12, -0.081})),
            "friction against A: B +12 %, C -8.1 %");
}

TEST(ChangeText, OfManyLevelsNamesTheLeastAndTheMost) {
  EXPECT_EQ(change_text(effect_of("category", {{"lot", {"a", "b", "c", "d", "e", "f", "g", "h"}}},
                                  {0.1, 0.2, 0.3, -0.1, 0, 0, 0})),
            "friction against a: e -10 %, d +30 %, the other 6 between them");
}

TEST(ChangeText, OfALevelAndAQuantityIsOneChangePerLevel) {
  // 1 + a_level (x2 - middle)/range.
  EXPECT_EQ(change_text(effect_of("category_slope",
                                  {{"tool", {"A", "B"}}, {"T_tool_C", {}, 20, 120}}, {0, 0.4})),
            "friction with T_tool_C from 20 to 120: A +0 %, B +50 %");
}

TEST(ChangeText, OfTwoTextsIsTheChangeByTheFirstAtEachLevelOfTheSecond) {
  const std::vector<effects::EffectInput> texts = {{"oil", {"A", "B"}}, {"coat", {"no", "TiN"}}};
  // 1 + a for A on no and for B on TiN, 1 - a for the others.
  const PlacedEffect pair = effect_of("category_pair", texts, {0.2});
  EXPECT_EQ(change_text(pair), "friction with B against A: -33 % with no, +50 % with TiN");
  const std::vector<PlacedEffect> law = {effect_of("category", {texts[0]}, {0.5}), pair};
  EXPECT_EQ(change_text(pair, law), "friction with B against A: +0 % with no, +125 % with TiN");
  // Of three levels: 1 + a1 and 1 + a2 for A and B on no, 1 - a1 - a2 for C.
  EXPECT_EQ(change_text(effect_of("category_pair", {{"oil", {"A", "B", "C"}}, texts[1]}, {0, 0.5})),
            "friction against A: B +50 % and C -50 % with no, B -50 % and C +50 % with TiN");
}

TEST(ChangeText, OfTwoQuantitiesIsTheChangeByTheFirstAtTheEndsOfTheSecond) {
  // 1 + a (x - x0)/w (x2 - y0)/w2: 1 at s = 0; from 1 to 1.5 at s = 20.
  EXPECT_EQ(change_text(
                effect_of("product", {{"v", {}, 0, 10}, {"s_mm", {}, 0, 20}}, {0.5, 0, 10, 0, 20})),
            "friction with v from 0 to 10: +0 % at s_mm = 0, +50 % at 20");
}

// v alone: 1 - 0.5 at the end of its range; as a whole 0.5 at s = 0 and 0.75 at s = 20.
TEST(ChangeText, OfAProductIsThatOfTheWholeLaw) {
  const PlacedEffect product =
      effect_of("product", {{"v", {}, 0, 10}, {"s_mm", {}, 0, 20}}, {0.5, 0, 10, 0, 20});
  PlacedEffect own = effect_of("linear", {{"v", {}, 0, 10}}, {-0.5, 0, 10});
  const std::vector<PlacedEffect> law = {own, product};
  EXPECT_EQ(change_text(own, law), "friction -50 % from 0 to 10");
  EXPECT_EQ(change_text(product, law),
            "friction with v from 0 to 10: -50 % at s_mm = 0, -25 % at 20");
  own.acts_on = effects::ActsOn::m; // another part of the law
  const std::vector<PlacedEffect> apart = {own, product};
  EXPECT_EQ(change_text(product, apart), change_text(product));
}

TEST(ChangeText, OfWhatIsAddedIsInMPa) {
  PlacedEffect effect = effect_of("linear", {{"p", {}, 0, 2}}, {0.1, 1, 1});
  effect.acts_on = effects::ActsOn::tau;
  effect.tau_scale_MPa = 40;
  EXPECT_EQ(change_text(effect), "tau_R +8 MPa from 0 to 2");
}

TEST(ChangeText, OfNearlyNoFrictionAtOneEndIsNoPercentage) {
  EXPECT_EQ(change_text(effect_of("linear", {{"x", {}, 0, 1}}, {1, 1, 1})),
            "friction 0 to 1 of the law's from 0 to 1");
}

TEST(ChangeText, OfEveryFormHasNumbersAndTheNamesOfItsQuantities) {
  for (const effects::EffectForm& form : effects::all_effects()) {
    PlacedEffect effect;
    effect.form = &form;
    std::vector<std::vector<double>> values(form.columns, {1, 2, 4, 6, 9});
    for (std::size_t i = 0; i < form.columns; ++i)
      effect.inputs.push_back({"q" + std::to_string(i), {}, 1, 9});
    for (std::size_t i = 0; i < form.texts; ++i)
      effect.inputs[i].levels = {"A", "B"};
    effects::set_knots(effect, {values.begin(), values.end()});
    const std::vector<effects::Spread> spreads(form.columns, {1, 2, 4, 6, 9});
    effect.parameters = form.pattern ? form.pattern(effect) : effects::start_values(form, spreads);
    if (!form.pattern) effect.parameters[0] = 0.3;
    const std::string text = change_text(effect);
    EXPECT_THAT(text, testing::StartsWith("friction")) << form.name;
    EXPECT_THAT(text, testing::AnyOf(testing::HasSubstr("%"), testing::HasSubstr("of the law's")))
        << form.name;
    EXPECT_THAT(text,
                testing::Not(testing::AnyOf(testing::HasSubstr("nan"), testing::HasSubstr("inf"))))
        << form.name << ": " << text;
  }
}

} // namespace
} // namespace frictab::change_text_test
