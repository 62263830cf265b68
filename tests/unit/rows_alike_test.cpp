// A traced law with all rows alike: what becomes of the effects in it, on synthetic campaigns.
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "trace/judge/rows_alike.h"
#include "trace/search/choose_effect.h"
#include "twin/twin.h"

namespace frictab::rows_alike_test {
namespace {

using trace::Cause;
using trace::FittedAlike;
using trace::Rival;
using trace::Search;

// 18 tests of 25 rows. With `effect` the humidity of the room doubles friction from end to end.
twin::Twin campaign(bool effect) {
  twin::TwinOptions options;
  options.seed = 4;
  options.law = "coulomb";
  options.design = twin::parse_design("p=500,1200,2750;psi=1,20;v=5;T=20,110,200;points=25",
                                      twin::default_design(twin::twin_set("D")));
  options.profile = "varied";
  options.more_bystanders = true;
  options.scatter = twin::parse_scatter("test=0.04,slow=0.03,rho=0.8,white=0.015");
  if (effect)
    options.effects.push_back(twin::parse_effect("form=linear, column=humidity_pct, strength=0.5"));
  return twin::make_twin(options);
}

class RowsAlike : public testing::Test {
protected:
  explicit RowsAlike(bool effect = true)
      : twin_(campaign(effect)), calibrated_(calibrate::calibrate(
                                     {twin_.training.data, twin_.validation.data, models(), {}})),
        search_(input_) {}

  static calibrate::ModelOptions models() {
    calibrate::ModelOptions models;
    models.use = {"coulomb"};
    return models;
  }

  // The law with one plain effect per column, fitted under the noise model.
  Rival with_effects_of(const std::vector<std::string>& columns) const {
    std::vector<effects::PlacedEffect> effects;
    std::vector<Cause> causes;
    for (const std::string& name : columns)
      for (const Cause& cause : trace::all_causes(search_.candidates()))
        if (trace::cause_name(cause, search_.candidates()) == name) {
          effects.push_back(trace::plain_effect(search_, cause));
          causes.push_back(cause);
        }
    EXPECT_EQ(causes.size(), columns.size());
    return trace::fit_rival(search_.campaign(), search_.base(), effects, causes,
                            search_.base().noise, trace::NoiseSearch::again);
  }

  std::vector<std::string> left(const FittedAlike& fitted) const {
    std::vector<std::string> names;
    for (const Cause& cause : fitted.rival.causes)
      names.push_back(trace::cause_name(cause, search_.candidates()));
    return names;
  }

  twin::Twin twin_;
  calibrate::Calibration calibrated_;
  trace::TraceOptions options_;
  trace::TraceInput input_{
      twin_.training.data, twin_.validation.data, calibrated_.fits.front(), options_, 100, 1};
  Search search_;
};

class RowsAlikeWithoutEffect : public RowsAlike {
protected:
  RowsAlikeWithoutEffect() : RowsAlike(false) {}
};

TEST_F(RowsAlike, KeepThePlantedEffectAndTakeOutThoseOfOtherColumns) {
  const FittedAlike fitted =
      trace::fit_rows_alike(search_.campaign(), with_effects_of({"Ra_um", "humidity_pct"}));
  EXPECT_EQ(left(fitted), std::vector<std::string>{"humidity_pct"});
  EXPECT_EQ(fitted.kept, std::vector<std::size_t>{1});
}

TEST_F(RowsAlike, AreTheLeastSquaresFitOfTheEffectsThatAreLeft) {
  const FittedAlike fitted =
      trace::fit_rows_alike(search_.campaign(), with_effects_of({"Ra_um", "humidity_pct"}));
  const Rival alone = with_effects_of({"humidity_pct"});
  const Rival alike =
      trace::with_weights(search_.campaign(), alone, trace::rows_alike(alone.noise));
  ASSERT_EQ(fitted.rival.parameters.size(), alike.parameters.size());
  for (std::size_t p = 0; p < alike.parameters.size(); ++p)
    EXPECT_NEAR(fitted.rival.parameters[p] / alike.parameters[p], 1, 1e-4) << p;
}

TEST_F(RowsAlikeWithoutEffect, LeaveNothingOfColumnsThatDoNothing) {
  EXPECT_EQ(left(trace::fit_rows_alike(search_.campaign(), with_effects_of({"humidity_pct"}))),
            std::vector<std::string>{});
  EXPECT_EQ(trace::fit_rows_alike(search_.campaign(), search_.base()).kept.size(), 0u);
}

} // namespace
} // namespace frictab::rows_alike_test
