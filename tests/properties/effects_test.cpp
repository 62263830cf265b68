// Claims about every effect form in the registry: a new form is tested because it exists.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/names.h"
#include "core/text.h"
#include "effects/effect.h"
#include "expr/program.h"

namespace frictab::effects_test {

using effects::EffectForm;
using effects::parameters_of;
using effects::PlacedEffect;
using effects::Spread;
using expr::Program;

namespace {

const std::vector<double> some_x = {-1e6, -300, -273.15, -20, -1,  -1e-3, 0,    1e-9,
                                    1e-3, 0.5,  1,       4.7, 110, 500,   2750, 1e6};

const Spread spreads[] = {{0, 2, 10, 18, 20},     {20, 20, 110, 200, 260},
                          {-50, -40, -3, 12, 40}, {7, 7, 7, 7, 7},
                          {0, 0, 0, 0, 0},        {1e-6, 2e-6, 5e-6, 9e-6, 1e-5}};

// On columns of these spreads; a text column has three levels.
PlacedEffect placed(const EffectForm& form, const std::vector<Spread>& of, double amplitude) {
  PlacedEffect effect;
  effect.form = &form;
  std::vector<std::vector<double>> values;
  for (std::size_t i = 0; i < form.columns; ++i) {
    effect.inputs.push_back({effects::input_symbols(form)[i], {}, of[i].minimum, of[i].maximum});
    values.push_back({of[i].minimum, of[i].low, of[i].median, of[i].high, of[i].maximum});
  }
  for (std::size_t i = 0; i < form.texts; ++i)
    effect.inputs[i].levels = {"A", "B", "C"};
  effects::set_knots(effect, {values.begin(), values.end()});
  if (form.pattern) {
    effect.parameters = form.pattern(effect);
    for (double& value : effect.parameters)
      value *= amplitude;
  } else {
    effect.parameters = effects::start_values(form, of);
    effect.parameters[0] = amplitude;
  }
  return effect;
}

PlacedEffect placed(const EffectForm& form, double amplitude) {
  return placed(form, {spreads[0], spreads[0], spreads[0]}, amplitude);
}

Program program_of(const PlacedEffect& effect) {
  return {effects::formula_of(effect), effects::input_symbols(*effect.form),
          all_names(parameters_of(effect))};
}

class EffectForms : public testing::TestWithParam<const EffectForm*> {};

TEST_P(EffectForms, DescribesItself) {
  const EffectForm& form = *GetParam();
  EXPECT_FALSE(form.title.empty());
  EXPECT_FALSE(form.formula.empty());
  ASSERT_FALSE(form.parameters.empty());
  EXPECT_EQ(form.parameters[0].start, 0) << "the amplitude comes first, 0 is neutral";
  EXPECT_EQ(form.shapes.size() + 1, form.parameters.size());
  const bool depends = form.parameters_of;
  EXPECT_EQ(depends, !form.factor.has_value());
  EXPECT_EQ(depends, form.build != nullptr);
  EXPECT_EQ(depends, form.text != nullptr);
  EXPECT_EQ(depends, form.pattern != nullptr);
  EXPECT_EQ(form.penalty != nullptr, !form.knots.empty());
  for (const effects::Shape& shape : form.shapes)
    EXPECT_LT(shape.input, form.columns);
  auto parameters = parameters_of(placed(form, 0));
  parameters.insert(parameters.end(), form.parameters.begin(), form.parameters.end());
  for (const models::Parameter& parameter : parameters) {
    EXPECT_LE(parameter.lower, parameter.start) << parameter.name;
    EXPECT_GE(parameter.upper, parameter.start) << parameter.name;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
  }
}

TEST_P(EffectForms, HasAParameterForEachAmplitudeOfItsPattern) {
  for (const Spread& spread : spreads) {
    const PlacedEffect effect = placed(*GetParam(), {spread, spreads[1], spreads[2]}, 1);
    EXPECT_EQ(effect.parameters.size(), parameters_of(effect).size());
    EXPECT_LE(effects::amplitudes_of(effect), effect.parameters.size());
  }
}

TEST_P(EffectForms, StartsInsideItsBounds) {
  for (const Spread& spread : spreads) {
    const PlacedEffect effect = placed(*GetParam(), {spread, spreads[1], spreads[2]}, 0);
    const auto parameters = parameters_of(effect);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      EXPECT_GE(effect.parameters[i], parameters[i].lower) << parameters[i].name;
      EXPECT_LE(effect.parameters[i], parameters[i].upper) << parameters[i].name;
    }
  }
}

TEST_P(EffectForms, TriesShapesThatItsBoundsAllow) {
  const EffectForm& form = *GetParam();
  for (const Spread& spread : {spreads[0], spreads[1], spreads[5]})
    for (const auto& shapes : effects::shapes_to_try(form, {spread, spreads[1], spreads[0]})) {
      ASSERT_EQ(shapes.size(), form.shapes.size());
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        EXPECT_GE(shapes[i], form.parameters[i + 1].lower) << form.parameters[i + 1].name;
        EXPECT_LE(shapes[i], form.parameters[i + 1].upper) << form.parameters[i + 1].name;
      }
    }
}

TEST_P(EffectForms, UsesOnlyItsInputsAndParameters) {
  const PlacedEffect effect = placed(*GetParam(), 0);
  std::set<std::string> known;
  for (const auto& name : effects::input_symbols(*effect.form))
    known.insert(name);
  for (const auto& name : all_names(parameters_of(effect)))
    known.insert(name);
  EXPECT_EQ(expr::symbols(effects::formula_of(effect)), known);
}

TEST_P(EffectForms, NeutralAmplitudeIsExactlyOne) {
  for (const Spread& spread : spreads) {
    const PlacedEffect effect = placed(*GetParam(), {spread, spreads[1], spreads[2]}, 0);
    const Program program = program_of(effect);
    for (const double x : some_x)
      for (const double x2 : some_x) {
        const double row[] = {x, x2, x};
        EXPECT_EQ(program({row, effect.form->columns}, effect.parameters), 1.0) << x << ' ' << x2;
      }
  }
}

TEST_P(EffectForms, IsFiniteInsideTheDataAndReactsToItsAmplitude) {
  for (const double amplitude : {-0.5, 0.5}) {
    const PlacedEffect effect = placed(*GetParam(), amplitude);
    const Program program = program_of(effect);
    bool reacts = false;
    for (double x = -5; x <= 25; x += 0.5) {
      const double row[] = {x, 20 - x, x};
      const double factor = program({row, effect.form->columns}, effect.parameters);
      EXPECT_TRUE(std::isfinite(factor)) << x;
      reacts = reacts || std::abs(factor - 1) > 1e-3;
    }
    EXPECT_TRUE(reacts);
  }
}

TEST_P(EffectForms, ReadsBackFromItsText) {
  const PlacedEffect effect = placed(*GetParam(), 0.37);
  const Program direct = program_of(effect);
  const Program read(expr::parse_expr(expr::to_text(effects::formula_of(effect))), direct.columns(),
                     direct.scalars());
  for (double x = 0; x <= 25; x += 0.7) {
    const double row[] = {x, 20 - x, x};
    const std::span<const double> in(row, effect.form->columns);
    EXPECT_EQ(direct(in, effect.parameters), read(in, effect.parameters));
  }
}

TEST_P(EffectForms, IsLinearInItsAmplitudesWhereItSaysSo) {
  const EffectForm& form = *GetParam();
  if (form.name == "power" || form.name == "exponential" || form.name == "arrhenius") return;
  const PlacedEffect one = placed(form, 0.25), two = placed(form, 0.5);
  const Program program = program_of(one);
  for (double x = 0; x <= 20; x += 0.7) {
    const double row[] = {x, 20 - x, 0.5 * x};
    const std::span<const double> in(row, form.columns);
    EXPECT_NEAR(program(in, two.parameters) - 1, 2 * (program(in, one.parameters) - 1), 1e-13);
  }
}

std::vector<const EffectForm*> forms() {
  std::vector<const EffectForm*> forms;
  for (const EffectForm& form : effects::all_effects())
    forms.push_back(&form);
  return forms;
}

std::string name_of(const testing::TestParamInfo<const EffectForm*>& test) {
  return test.param->name;
}

INSTANTIATE_TEST_SUITE_P(Registry, EffectForms, testing::ValuesIn(forms()), name_of);

TEST(Effects, HoldEveryFormOnce) {
  EXPECT_EQ(join(effects::effect_names(), " "),
            "power exponential linear logarithmic arrhenius saturation hinge step bump stribeck "
            "periodic category product parabola hysteresis category_slope threshold2 recovery "
            "product3 cosine ramp category_pair spline surface spline_by_level");
}

TEST(Effects, SpreadIgnoresWhatIsNotFinite) {
  const std::vector<double> values = {3, NAN, 1, INFINITY, 2};
  const Spread spread = effects::spread_of(values);
  EXPECT_EQ(spread.minimum, 1);
  EXPECT_EQ(spread.median, 2);
  EXPECT_EQ(spread.maximum, 3);
}

} // namespace
} // namespace frictab::effects_test
