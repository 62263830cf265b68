// Claims about every effect form in the registry: a new form is tested because it exists.
#include <cmath>

#include <gtest/gtest.h>

#include "core/text.h"
#include "effects/effect.h"
#include "expr/program.h"

namespace frictab {
namespace {

const std::vector<double> some_x = {-1e6, -300, -273.15, -20, -1,  -1e-3, 0,    1e-9,
                                    1e-3, 0.5,  1,       4.7, 110, 500,   2750, 1e6};

std::vector<std::string> names_of(const EffectForm& form) {
  std::vector<std::string> names;
  for (const Parameter& parameter : form.parameters)
    names.push_back(parameter.name);
  return names;
}

// Start values for columns of very different spread.
std::vector<std::vector<double>> starts(const EffectForm& form) {
  const Spread spreads[] = {{0, 2, 10, 18, 20},     {20, 20, 110, 200, 260},
                            {-50, -40, -3, 12, 40}, {7, 7, 7, 7, 7},
                            {0, 0, 0, 0, 0},        {1e-6, 2e-6, 5e-6, 9e-6, 1e-5}};
  std::vector<std::vector<double>> all;
  for (const Spread& spread : spreads)
    all.push_back(start_values(form, {spread, spreads[1], spreads[2]}));
  return all;
}

class EffectForms : public testing::TestWithParam<const EffectForm*> {};
class EffectFormulas : public EffectForms {}; // those that are the same wherever they are placed

TEST_P(EffectForms, DescribesItself) {
  const EffectForm& form = *GetParam();
  EXPECT_FALSE(form.title.empty());
  EXPECT_FALSE(form.formula.empty());
  ASSERT_FALSE(form.parameters.empty());
  for (std::size_t i = 0; i < form.amplitudes; ++i)
    EXPECT_EQ(form.parameters[i].start, 0) << "amplitudes come first, 0 is neutral";
  EXPECT_EQ(form.shapes.size() + 1, form.parameters.size());
  EXPECT_EQ(form.build != nullptr, form.factor == nullptr);
  EXPECT_EQ(form.build != nullptr, form.parameters_of != nullptr);
  for (const Parameter& parameter : form.parameters) {
    EXPECT_LE(parameter.lower, parameter.start) << parameter.name;
    EXPECT_GE(parameter.upper, parameter.start) << parameter.name;
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
  }
}

TEST_P(EffectForms, StartValuesRespectBounds) {
  const EffectForm& form = *GetParam();
  for (const auto& values : starts(form))
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_GE(values[i], form.parameters[i].lower) << form.parameters[i].name;
      EXPECT_LE(values[i], form.parameters[i].upper) << form.parameters[i].name;
    }
}

TEST_P(EffectFormulas, UsesOnlyItsInputsAndParameters) {
  const EffectForm& form = *GetParam();
  std::set<std::string> known;
  for (const auto& name : input_symbols(form))
    known.insert(name);
  for (const auto& name : names_of(form))
    known.insert(name);
  EXPECT_EQ(symbols(form.factor()), known);
}

TEST_P(EffectFormulas, NeutralAmplitudeIsExactlyOne) {
  const EffectForm& form = *GetParam();
  const Program program(form.factor(), input_symbols(form), names_of(form));
  for (const auto& values : starts(form))
    for (const double x : some_x)
      for (const double x2 : some_x) {
        const double row[] = {x, x2, x};
        EXPECT_EQ(program({row, form.columns}, values), 1.0) << x << ' ' << x2;
      }
}

TEST_P(EffectFormulas, IsFiniteInsideTheDataAndReactsToItsAmplitude) {
  const EffectForm& form = *GetParam();
  const Program program(form.factor(), input_symbols(form), names_of(form));
  auto values = start_values(form, {{0, 2, 10, 18, 20}, {0, 2, 10, 18, 20}, {0, 2, 10, 18, 20}});
  for (const double amplitude : {-0.5, 0.5}) {
    values[0] = amplitude;
    bool reacts = false;
    for (double x = -5; x <= 25; x += 0.5) {
      const double row[] = {x, 20 - x, x};
      const double factor = program({row, form.columns}, values);
      EXPECT_TRUE(std::isfinite(factor)) << x;
      reacts = reacts || std::abs(factor - 1) > 1e-3;
    }
    EXPECT_TRUE(reacts);
  }
}

TEST_P(EffectFormulas, ReadsBackFromItsText) {
  const EffectForm& form = *GetParam();
  const Program direct(form.factor(), input_symbols(form), names_of(form));
  const Program read(parse_expr(to_text(form.factor())), input_symbols(form), names_of(form));
  auto values = start_values(form, {{0, 2, 10, 18, 20}, {0, 2, 10, 18, 20}, {0, 2, 10, 18, 20}});
  values[0] = 0.37;
  for (double x = 0; x <= 25; x += 0.7) {
    const double row[] = {x, 20 - x, x};
    const std::span<const double> in(row, form.columns);
    EXPECT_EQ(direct(in, values), read(in, values));
  }
}

std::vector<const EffectForm*> forms(bool categorical_too) {
  std::vector<const EffectForm*> forms;
  for (const EffectForm& form : all_effects())
    if (categorical_too || form.factor) forms.push_back(&form);
  return forms;
}

std::string name_of(const testing::TestParamInfo<const EffectForm*>& test) {
  return test.param->name;
}

INSTANTIATE_TEST_SUITE_P(Registry, EffectForms, testing::ValuesIn(forms(true)), name_of);
INSTANTIATE_TEST_SUITE_P(Registry, EffectFormulas, testing::ValuesIn(forms(false)), name_of);

TEST(Effects, HoldEveryFormOnce) {
  EXPECT_EQ(join(effect_names(), " "),
            "power exponential linear logarithmic arrhenius saturation hinge step bump stribeck "
            "periodic category product spline");
}

TEST(Effects, SpreadIgnoresWhatIsNotFinite) {
  const std::vector<double> values = {3, NAN, 1, INFINITY, 2};
  const Spread spread = spread_of(values);
  EXPECT_EQ(spread.minimum, 1);
  EXPECT_EQ(spread.median, 2);
  EXPECT_EQ(spread.maximum, 3);
}

} // namespace
} // namespace frictab
