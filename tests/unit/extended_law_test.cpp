// A law with effects in it: neutral effects change nothing, others act where they are placed.
#include <cmath>

#include <gtest/gtest.h>

#include "data/derived.h"
#include "data/quantity.h"
#include "effects/extended_law.h"
#include "expr/program.h"

namespace frictab::extended_law_test {

using effects::ActsOn;
using effects::extended_law;
using effects::PlacedEffect;
using effects::symbol_of;
using models::find_law;
using models::Law;
using models::start_values;

namespace {

const std::vector<std::string> states = {"sigma_n_MPa", "psi",  "v_rel_mm_s",
                                         "T_contact_C", "s_mm", "sigma_f_MPa"};

PlacedEffect effect(const char* form, ActsOn acts_on, double amplitude) {
  PlacedEffect effect;
  effect.form = effects::find_effect(form);
  effect.acts_on = acts_on;
  const std::vector<effects::EffectInput> numbers = {
      {"humidity_pct", {}, 30, 60}, {"Ra_um", {}, 0.1, 0.5}, {"film_um", {}, 1, 9}};
  const std::vector<effects::Spread> spreads = {
      {30, 35, 45, 55, 60}, {0.1, 0.2, 0.3, 0.4, 0.5}, {1, 2, 5, 8, 9}};
  const std::vector<effects::EffectInput> texts = {{"tool", {"A", "B", "C"}}, {"oil", {"X", "Y"}}};
  effect.inputs.assign(texts.begin(), texts.begin() + static_cast<long>(effect.form->texts));
  for (std::size_t i = 0; effect.inputs.size() < effect.form->columns; ++i)
    effect.inputs.push_back(numbers[i]);
  std::vector<std::vector<double>> values;
  for (const effects::EffectInput& input : effect.inputs)
    values.push_back({input.low, 0.5 * (input.low + input.high), input.high});
  effects::set_knots(effect, {values.begin(), values.end()});
  if (effect.form->parameters_of)
    for (std::size_t p = effects::parameters_of(effect).size(); p > 0; --p)
      effect.parameters.push_back((static_cast<double>(effect.parameters.size()) + 1) * amplitude);
  else {
    effect.parameters = effects::start_values(*effect.form, spreads);
    effect.parameters[0] = amplitude;
  }
  effect.tau_scale_MPa = 100;
  return effect;
}

// tau_R at one state; `column` is the effect's first column.
double tau(const Law& law, double sigma, double column, double second = 0.25) {
  const auto names = models::inputs(law, {});
  std::vector<double> row;
  for (const std::string& name : names)
    row.push_back(name == "sigma_n_MPa"                      ? sigma
                  : name == "psi"                            ? 3
                  : name == "v_rel_mm_s"                     ? 50
                  : name == "T_contact_C"                    ? 110
                  : name == "s_mm"                           ? 4
                  : name == "sigma_f_MPa"                    ? 400
                  : name == "humidity_pct" || name == "tool" ? column
                                                             : second);
  return expr::Program(models::tau_formula(law, {}), names,
                       models::parameter_names(law))(row, start_values(law.parameters));
}

TEST(SlowExtendedLaw, NeutralEffectsLeaveEveryBitOfEveryLaw) {
  for (const Law& law : models::all_laws())
    for (const effects::EffectForm& form : effects::all_effects())
      for (const ActsOn place : {ActsOn::mu, ActsOn::m, ActsOn::mu_m, ActsOn::tau}) {
        const PlacedEffect neutral[] = {effect(form.name.c_str(), place, 0)};
        const Law extended =
            extended_law(law, {}, start_values(law.parameters), neutral, "extended");
        for (const double sigma : {0.0, 300.0, 900.0, 2700.0})
          for (const double column : {0.0, 1.0, 37.3, 90.0})
            EXPECT_EQ(tau(extended, sigma, column), tau(law, sigma, column))
                << law.name << ' ' << form.name << ' ' << effects::acts_on_name(place);
      }
}

TEST(ExtendedLaw, AnEffectWithoutAllItsParametersIsRefused) {
  for (const char* form : {"hinge", "category"}) {
    PlacedEffect short_one = effect(form, ActsOn::mu, 0.1);
    short_one.parameters.pop_back();
    EXPECT_THROW(effects::factor_of(short_one, "e_"), std::logic_error) << form;
  }
}

TEST(ExtendedLaw, AnEffectOnMuActsBelowTheLimitOnly) {
  const Law& coulomb = *find_law("coulomb");
  const PlacedEffect half[] = {effect("linear", ActsOn::mu, 0.5)};
  const Law extended =
      extended_law(coulomb, {}, start_values(coulomb.parameters), half, "extended");
  // (x - 45)/20 = 0.5 at 55
  EXPECT_NEAR(tau(extended, 1000, 55) / tau(coulomb, 1000, 55), 1.25, 1e-12);
  EXPECT_EQ(tau(extended, 9000, 55), tau(coulomb, 9000, 55)) << "both at k";
}

TEST(ExtendedLaw, AnEffectOnTheLimitActsAtTheLimitOnly) {
  const Law& orowan = *find_law("orowan");
  const PlacedEffect half[] = {effect("linear", ActsOn::m, 0.5)};
  const Law extended = extended_law(orowan, {}, start_values(orowan.parameters), half, "extended");
  EXPECT_EQ(tau(extended, 100, 55), tau(orowan, 100, 55));
  EXPECT_NEAR(tau(extended, 5000, 55) / tau(orowan, 5000, 55), 1.25, 1e-12);
}

TEST(ExtendedLaw, AnEffectOnMuAndTheLimitActsOnTheLawAsAWhole) {
  const Law& orowan = *find_law("orowan");
  const PlacedEffect half[] = {effect("linear", ActsOn::mu_m, 0.5)};
  const Law extended = extended_law(orowan, {}, start_values(orowan.parameters), half, "extended");
  EXPECT_EQ(extended.parameters.size(), orowan.parameters.size() + 1);
  for (const double sigma : {100.0, 5000.0})
    EXPECT_NEAR(tau(extended, sigma, 55) / tau(orowan, sigma, 55), 1.25, 1e-12) << sigma;
}

TEST(ExtendedLaw, AnAddedEffectIsInUnitsOfItsScale) {
  const Law& coulomb = *find_law("coulomb");
  const PlacedEffect half[] = {effect("linear", ActsOn::tau, 0.5)};
  const Law extended =
      extended_law(coulomb, {}, start_values(coulomb.parameters), half, "extended");
  EXPECT_NEAR(tau(extended, 1000, 55) - tau(coulomb, 1000, 55), 25, 1e-10);
}

TEST(ExtendedLaw, AnAddedEffectFadesWithThePressure) {
  for (const char* name : {"coulomb", "shear"}) { // that takes the pressure, that does not
    const Law& law = *find_law(name);
    PlacedEffect half[] = {effect("linear", ActsOn::tau, 0.5)};
    half[0].pressure_MPa = 200;
    const Law extended = extended_law(law, {}, start_values(law.parameters), half, "extended");
    const auto added = [&](double sigma) { return tau(extended, sigma, 55) - tau(law, sigma, 55); };
    EXPECT_NEAR(added(1000), 25, 1e-10) << name;
    EXPECT_NEAR(added(200), 25, 1e-10) << name;
    EXPECT_NEAR(added(50), 6.25, 1e-10) << name;
    EXPECT_EQ(added(0), 0) << name;
    EXPECT_EQ(effects::formula_text(half[0]),
              "tau_R + 100 MPa min(1, sigma_n_MPa/200) (a (x - x0)/w)");
  }
}

TEST(ExtendedLaw, HoldsAnEffectAtTheEndsOfWhereItWasLearned) {
  const Law& coulomb = *find_law("coulomb");
  for (const effects::EffectForm& form : effects::all_effects()) {
    if (form.texts > 0) continue;
    const PlacedEffect some[] = {effect(form.name.c_str(), ActsOn::mu, 0.3)};
    const Law extended =
        extended_law(coulomb, {}, start_values(coulomb.parameters), some, "extended");
    EXPECT_EQ(tau(extended, 500, 60), tau(extended, 500, 1e4)) << form.name;
    EXPECT_EQ(tau(extended, 500, 30), tau(extended, 500, -1e4)) << form.name;
  }
}

TEST(ExtendedLaw, GivesEachLevelItsFactor) {
  const Law& coulomb = *find_law("coulomb");
  const PlacedEffect tools[] = {effect("category", ActsOn::mu, 0.1)};
  const Law extended =
      extended_law(coulomb, {}, start_values(coulomb.parameters), tools, "extended");
  const double base = tau(coulomb, 500, 0);
  EXPECT_EQ(tau(extended, 500, 0), base);
  EXPECT_NEAR(tau(extended, 500, 1) / base, 1.1, 1e-12);
  EXPECT_NEAR(tau(extended, 500, 2) / base, 1.2, 1e-12);
}

TEST(ExtendedLaw, ListsFittedParametersOfEveryEffectBehindTheLawsOwn) {
  const Law& coulomb = *find_law("coulomb");
  const PlacedEffect two[] = {effect("saturation", ActsOn::mu, 0.1),
                              effect("hinge", ActsOn::m, 0.2)};
  const Law extended = extended_law(coulomb, {}, start_values(coulomb.parameters), two, "extended");
  EXPECT_EQ(models::parameter_names(extended),
            (std::vector<std::string>{"mu", "e1_a", "e1_x0", "e2_a", "e2_x0", "m_limit"}));
  EXPECT_EQ(models::inputs(extended, {}),
            (std::vector<std::string>{"sigma_n_MPa", "sigma_f_MPa", "humidity_pct"}));
}

TEST(ExtendedLaw, ParametersHaveTheUnitsOfTheColumnsTheyAreValuesOf) {
  const Law& coulomb = *find_law("coulomb");
  PlacedEffect sliding = effect("saturation", ActsOn::mu, 0.1),
               work = effect("step", ActsOn::mu, 0.1);
  PlacedEffect pair = effect("recovery", ActsOn::mu, 0.1), humid = effect("hinge", ActsOn::m, 0.2);
  sliding.inputs[0].column = "s_mm";
  work.inputs[0].column = "friction_work";
  pair.inputs[0].column = "v_rel_mm_s";
  pair.inputs[1].column = "T_contact_C";
  const PlacedEffect all[] = {sliding, work, pair, humid};
  const Law extended = extended_law(coulomb, {}, start_values(coulomb.parameters), all, "extended");
  std::map<std::string, std::string> unit;
  for (const models::Parameter& parameter : extended.parameters)
    unit[parameter.name] = parameter.unit;
  EXPECT_EQ(unit.at("e1_a"), "1");
  EXPECT_EQ(unit.at("e1_x0"), "mm");
  EXPECT_EQ(unit.at("e2_x0"), data::find_derived("friction_work")->unit);
  EXPECT_EQ(unit.at("e2_w"), data::find_derived("friction_work")->unit);
  EXPECT_EQ(unit.at("e3_x0"), "mm/s");
  EXPECT_EQ(unit.at("e3_t0"), data::find_quantity("T_contact_C")->unit);
  EXPECT_EQ(unit.at("e4_x0"), "") << "of a recorded column nobody says the unit";
}

TEST(ExtendedLaw, TurnsAnyColumnNameIntoASymbol) {
  EXPECT_EQ(symbol_of("humidity_pct"), "humidity_pct");
  EXPECT_EQ(symbol_of("Ra (um)"), "Ra__um_");
  EXPECT_EQ(symbol_of("2nd tool"), "c_2nd_tool");
  EXPECT_EQ(symbol_of("mu"), "c_mu") << "a parameter";
  EXPECT_EQ(symbol_of("log"), "c_log") << "a function";
  EXPECT_EQ(symbol_of("e1_a"), "c_e1_a") << "an effect's parameter";
  EXPECT_EQ(symbol_of("e_1"), "e_1");
}

} // namespace
} // namespace frictab::extended_law_test
