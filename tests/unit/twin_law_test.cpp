// Claims about campaigns whose truth is a friction law of the registry.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/law_problem.h"
#include "effects/extended_law.h"
#include "support/twin_fault.h"
#include "twin/twin_effect.h"
#include "twin/twin_summary.h"

namespace frictab::twin_law_test {

using models::Conventions;
using twin::make_twin;
using twin::mean_of;
using twin::Twin;

namespace {

using test::fault_of;
using testing::HasSubstr;

twin::TwinOptions of_law(const std::string& law, const std::vector<std::string>& effects = {}) {
  twin::TwinOptions options;
  options.law = law;
  options.profile = "varied";
  options.design = twin::parse_design("p=500,1625,2750;points=60;validation=10", {});
  for (const std::string& effect : effects)
    options.effects.push_back(twin::parse_effect(effect));
  return options;
}

double mae(std::span<const double> tau, const std::vector<double>& law) {
  double sum = 0;
  for (std::size_t i = 0; i < law.size(); ++i)
    sum += std::abs(tau[i] - law[i]);
  return sum / static_cast<double>(law.size());
}

// tau_R of a law that may have effects in it, on the columns of a part.
std::vector<double> tau_by_hand(const models::Law& law, const twin::TwinPart& part,
                                const std::vector<double>& parameters) {
  const Conventions conventions;
  const auto names = models::inputs(law, conventions);
  std::vector<const double*> columns;
  for (const std::string& name : names)
    columns.push_back(part.data.values(name).data());
  std::vector<double> tau(part.data.rows());
  expr::Program(models::tau_formula(law, conventions), names, models::parameter_names(law))
      .evaluate(tau.size(), columns, parameters, tau.data());
  return tau;
}

class TwinOfLaw : public testing::TestWithParam<std::string> {};

TEST_P(TwinOfLaw, HasNothingThatTheLawLacks) {
  twin::TwinOptions options = of_law(GetParam());
  options.noise_scale = 0;
  const Twin twin = make_twin(options);
  EXPECT_LT(mae(twin.validation.data.values("tau_R_MPa"),
                tau_by_hand(twin.law->law(), twin.validation, twin.law->parameters())),
            5.01e-4); // rounding of the measurement
  const auto fit = calibrate::LawProblem(twin.law->law(), Conventions{}, twin.training.data)
                       .fit(calibrate::Loss::l2, 0)
                       .result;
  EXPECT_LT(mae(twin.validation.oracle_MPa,
                tau_by_hand(twin.law->law(), twin.validation, fit.parameters)),
            1e-3);
}

TEST_P(TwinOfLaw, LooksLikeTheTwinItself) {
  const Twin twin = make_twin(of_law(GetParam()));
  const Twin physics = make_twin(of_law(""));
  EXPECT_NEAR(mean_of(twin.training.oracle_MPa), mean_of(physics.training.oracle_MPa),
              0.15 * mean_of(physics.training.oracle_MPa));
  EXPECT_EQ(twin.training.data.values("sigma_n_MPa")[1000],
            physics.training.data.values("sigma_n_MPa")[1000]);
}

TEST_P(TwinOfLaw, StrengthIsWhatItsOwnRecalibrationLeaves) {
  const Twin twin = make_twin(of_law(GetParam(), {"form=saturation,column=s_mm,strength=0.3"}));
  EXPECT_NEAR(twin.effects[0].strength, 0.3, 1e-6);
  const auto tau = twin.training.data.values("tau_R_MPa");
  const auto fit = calibrate::LawProblem(twin.law->law(), Conventions{}, twin.training.data)
                       .fit(calibrate::Loss::l2, 0)
                       .result;
  const double left = mae(tau, tau_by_hand(twin.law->law(), twin.training, fit.parameters));
  EXPECT_NEAR(left / mae(tau, twin.training.recalibrated_MPa), 1, 2e-3);
  EXPECT_NEAR(left / mae(tau, twin.training.oracle_MPa), 1.3, 0.05); // recalibration of the truth
  EXPECT_EQ(twin::summarise(twin).find("base_law")->constants.size(), fit.parameters.size());
}

TEST_P(TwinOfLaw, ZeroAmplitudeLeavesEveryBit) {
  const Twin plain = make_twin(of_law(GetParam()));
  for (const std::string on : {"mu", "m", "tau"}) {
    if (on == "m" && !plain.law->has_limit()) continue;
    const Twin neutral =
        make_twin(of_law(GetParam(), {"form=bump,column=T_contact_C,amplitude=0,on=" + on}));
    EXPECT_EQ(plain.training.oracle_MPa, neutral.training.oracle_MPa) << on;
    EXPECT_EQ(plain.validation.oracle_MPa, neutral.validation.oracle_MPa) << on;
  }
}

// Of the registry: the twin's design need not determine laws of the literature.
std::vector<std::string> registered_truths() {
  std::vector<std::string> names = twin::truth_names();
  std::erase_if(names, [](const std::string& name) { return !models::find_law(name); });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Laws, TwinOfLaw, testing::ValuesIn(registered_truths()),
                         [](const auto& param) { return param.param; });

// The same effects as the trace stage would add them.
TEST(TwinLaw, EffectsAreThoseOfTheExtendedLaw) {
  for (const std::string name : {"orowan", "shaw", "log_coulomb"}) {
    const Twin twin =
        make_twin(of_law(name, {"form=saturation,column=s_mm,amplitude=0.2",
                                "form=linear,column=T_tool_C,amplitude=-0.6,on=m",
                                "form=hinge,column=v_rel_mm_s,amplitude=0.05,on=tau"}));
    std::vector<effects::PlacedEffect> effects;
    for (const twin::PlantedEffect& planted : twin.effects) {
      effects::PlacedEffect& effect = effects.emplace_back();
      effect.form = planted.form;
      effect.inputs = {{planted.spec.column, {}, -1e9, 1e9}};
      effect.acts_on = planted.spec.on;
      effect.parameters = planted.parameters;
      effect.tau_scale_MPa = mean_of(twin.training.base_MPa);
    }
    const models::Law law = effects::extended_law(twin.law->law(), Conventions{},
                                                  twin.law->parameters(), effects, "truth");
    const auto expected = tau_by_hand(law, twin.validation, models::start_values(law.parameters));
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_NEAR(twin.validation.oracle_MPa[i], expected[i], 1e-9 * expected[i]) << name;
  }
}

TEST(TwinLaw, EffectOnALimitOfItsOwnLeavesTheOtherBranch) {
  const Twin plain = make_twin(of_law("orowan"));
  const Twin twin = make_twin(of_law("orowan", {"form=linear,column=T_tool_C,strength=0.2,on=m"}));
  const auto sigma = twin.training.data.values("sigma_n_MPa");
  const double mu = twin.law->parameters()[0];
  std::size_t coulomb = 0, changed = 0;
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    if (sigma[i] < 600) { // far below any limit
      ASSERT_NEAR(twin.training.oracle_MPa[i], mu * sigma[i], 1e-9);
      ++coulomb;
    }
    if (twin.training.oracle_MPa[i] != plain.training.oracle_MPa[i]) ++changed;
  }
  EXPECT_GT(coulomb, sigma.size() / 5);
  EXPECT_GT(changed, sigma.size() / 10);
}

TEST(TwinLaw, UnknownOnesAreAnsweredWithTheKnown) {
  for (const char* name : {"colomb", "coulomb_0.08", "orowan_mean", "neural_network"})
    EXPECT_THAT(fault_of(of_law(name)),
                HasSubstr("is not a law that is fitted to data\n  hint: known: coulomb, shear,"))
        << name;
}

TEST(TwinLaw, EffectOnALimitNeedsOne) {
  EXPECT_THAT(
      fault_of(of_law("shear", {"form=linear,column=T_tool_C,strength=0.1,on=m"})),
      HasSubstr("law 'shear' has no limit to act on\n  hint: it is a limit itself: use on=mu"));
}

} // namespace
} // namespace frictab::twin_law_test
