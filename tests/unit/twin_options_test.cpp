// Claims about what the twin says to wrong options.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "twin/twin.h"

namespace frictab::twin_options_test {

using twin::TwinOptions;

namespace {

using testing::HasSubstr;

template <class Body> std::string fault(Body body) {
  try {
    body();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

std::string effect_fault(const std::string& text) {
  return fault([&] {
    TwinOptions options;
    options.effects = {twin::parse_effect(text)};
    options.design = twin::parse_design("v=5,500;T=20,200;points=50;validation=2",
                                        twin::default_design(twin::twin_set("D")));
    twin::make_twin(options);
  });
}

std::string design_fault(const std::string& text) {
  return fault([&] { twin::parse_design(text, twin::default_design(twin::twin_set("D"))); });
}

TEST(TwinOptions, UnknownFormNamesTheNearest) {
  EXPECT_THAT(effect_fault("form=satration,column=s_mm,strength=0.1"),
              HasSubstr("unknown form 'satration'\n  hint: did you mean 'saturation'?"));
}

TEST(TwinOptions, UnknownColumnNamesTheNearest) {
  EXPECT_THAT(effect_fault("form=linear,column=humidty_pct,strength=0.1"),
              HasSubstr("unknown column 'humidty_pct'\n  hint: did you mean 'humidity_pct'?"));
  EXPECT_THAT(effect_fault("form=linear,column=frictionwork,strength=0.1"),
              HasSubstr("did you mean 'friction_work'?"));
}

TEST(TwinOptions, UnknownKeyNamesTheNearest) {
  EXPECT_THAT(effect_fault("form=linear,column=s_mm,strenght=0.1"),
              HasSubstr("did you mean 'strength'?"));
}

TEST(TwinOptions, BadNumbersAreNamed) {
  EXPECT_THAT(effect_fault("form=linear,column=s_mm,strength=15%"),
              HasSubstr("'15%' of 'strength' is not a finite number"));
  EXPECT_THAT(effect_fault("form=linear,column=s_mm,strength=-1"), HasSubstr("negative"));
  EXPECT_THAT(effect_fault("form=linear,column=s_mm,amplitude=nan"), HasSubstr("not a finite"));
  EXPECT_THAT(effect_fault("form=saturation,column=s_mm,strength=0.1,x0=-3"),
              HasSubstr("x0 = -3 is out of bounds"));
}

TEST(TwinOptions, AllFaultsOfAnEffectComeTogether) {
  const std::string text = effect_fault("form=liner,colum=s_mm,on=cap");
  for (const char* what : {"'liner'", "'colum'", "unknown on 'cap'", "no column", "neither"})
    EXPECT_THAT(text, HasSubstr(what));
}

TEST(TwinOptions, TextAndNumbersDoNotMix) {
  EXPECT_THAT(effect_fault("form=linear,column=tool,strength=0.1"), HasSubstr("holds text"));
  EXPECT_THAT(effect_fault("form=category,column=s_mm,strength=0.1"), HasSubstr("holds numbers"));
}

TEST(TwinOptions, SecondColumnGoesWithItsForm) {
  EXPECT_THAT(effect_fault("form=product,column=s_mm,strength=0.1"), HasSubstr("needs column2"));
  EXPECT_THAT(effect_fault("form=linear,column=s_mm,column2=psi,strength=0.1"),
              HasSubstr("takes no column2"));
  EXPECT_THAT(effect_fault("form=product3,column=s_mm,column2=psi,strength=0.1"),
              HasSubstr("needs column3"));
}

TEST(TwinOptions, StrengthOutOfReachSaysWhatIsReachable) {
  const std::string text = effect_fault("form=bump,column=s_mm,strength=1000,sign=-");
  EXPECT_THAT(text, HasSubstr("cannot reach strength 1000"));
  EXPECT_THAT(text, HasSubstr("the strongest that keeps friction positive is"));
}

TEST(TwinOptions, EffectThatTurnsFrictionNegativeIsRefused) {
  EXPECT_THAT(effect_fault("form=linear,column=s_mm,amplitude=-9"), HasSubstr("negative"));
}

TEST(TwinOptions, GivenShapesAreUsed) {
  const twin::EffectSpec spec =
      twin::parse_effect("form=saturation, column=s_mm, strength=0.1, x0=2.5");
  EXPECT_EQ(spec.shapes.at("x0"), 2.5);
}

TEST(TwinOptions, DesignFaultsComeTogether) {
  const std::string text = design_fault("p=1725,x;psy=1;replicates=0;points=1.5");
  for (const char* what : {"'x' of 'p'", "did you mean 'psi'?", "replicates must be a whole",
                           "points must be a whole"})
    EXPECT_THAT(text, HasSubstr(what));
  EXPECT_THAT(design_fault("psi=0.5"), HasSubstr("psi = 0.5 is outside 1 to 100"));
  EXPECT_THAT(design_fault("replicates=100000;points=100000"), HasSubstr("50,000,000 rows"));
}

template <class Change> std::string options_fault(Change change) {
  TwinOptions options;
  change(options);
  return fault([&] { twin::make_twin(options); });
}

TEST(TwinOptions, UnknownSetAndNoiseAreNamed) {
  EXPECT_THAT(options_fault([](TwinOptions& o) { o.set = "X"; }), HasSubstr("known: D, W, B"));
  EXPECT_THAT(options_fault([](TwinOptions& o) { o.noise = "norml"; }),
              HasSubstr("did you mean 'normal'?"));
  EXPECT_THAT(options_fault([](TwinOptions& o) { o.noise_scale = -1; }),
              HasSubstr("outside 0 to 5"));
  EXPECT_THAT(options_fault([](TwinOptions& o) { o.hide = {"filmum"}; }),
              HasSubstr("did you mean 'film_um'?"));
}

} // namespace
} // namespace frictab::twin_options_test
