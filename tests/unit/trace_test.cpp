// The trace stage on synthetic campaigns whose truth is known.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/input_columns.h"
#include "core/parallel.h"
#include "core/random.h"
#include "data/roles.h"
#include "support/trace_text.h"
#include "trace/advise/leads.h"
#include "trace/search/search.h"
#include "trace/trace.h"
#include "trace/trace_file.h"
#include "twin/twin.h"

namespace frictab::trace_test {

using data::Column;
using data::Dataset;
using effects::ActsOn;
using test::trace_text;
using trace::Trace;
using trace::trace_json;
using trace::TraceOptions;
using trace::Verdict;
using twin::parse_design;
using twin::TwinOptions;

namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// 54 tests of 25 rows: large enough for every claim here, small enough for a search that is
// repeated twenty times.
constexpr const char* design = "p=500,1200,2750;psi=1,4.47,20;v=5,500;T=20,110,200;points=25";
constexpr double tests = 54;

TwinOptions campaign(const std::string& law, std::uint64_t seed, const std::string& effect = "") {
  TwinOptions options;
  options.seed = seed;
  options.law = law;
  options.design = parse_design(design, twin::default_design(twin::twin_set("D")));
  options.profile = "varied";
  options.more_bystanders = true;
  options.scatter = twin::parse_scatter("test=0.04,slow=0.03,rho=0.8,white=0.015");
  if (!effect.empty()) options.effects.push_back(twin::parse_effect(effect));
  return options;
}

// Where what stands beside the cause is not the matter.
TwinOptions few_columns(TwinOptions options) {
  options.more_bystanders = false;
  return options;
}

struct Data {
  Dataset training, validation;
};

Data data_of(const TwinOptions& options) {
  twin::Twin twin = twin::make_twin(options);
  return {std::move(twin.training.data), std::move(twin.validation.data)};
}

calibrate::Calibration calibrated(const Data& data, const std::string& law) {
  calibrate::ModelOptions models;
  models.use = {law};
  calibrate::CalibrationOptions calibration;
  calibration.bootstrap = 100;
  return calibrate::calibrate({data.training, data.validation, models, calibration});
}

Trace traced(const Data& data, const std::string& law, const TraceOptions& how = {}) {
  const calibrate::Calibration fitted = calibrated(data, law);
  const Trace found =
      trace::trace({data.training, data.validation, fitted.fits.front(), how, 100, 1});
  // Of every campaign here: no effect is delivered that makes the calibrated law worse.
  if (!found.effects.empty() && found.unseen == "validation") {
    EXPECT_LT(found.after.validation.mae_MPa, found.as_calibrated.validation.mae_MPa);
    EXPECT_NEAR(found.over_calibrated.value().value_MPa,
                found.as_calibrated.validation.mae_MPa - found.after.validation.mae_MPa, 1e-9);
  }
  return found;
}

Trace traced(const TwinOptions& options, const TraceOptions& how = {}) {
  return traced(data_of(options), options.law, how);
}

// The order of the twin's tests counts the validation tests, too: it has to be declared.
TraceOptions declared_order() {
  TraceOptions how;
  how.order = "run_order";
  return how;
}

Column& column(Dataset& data, const std::string& name) {
  return *std::find_if(data.columns.begin(), data.columns.end(),
                       [&](const Column& c) { return c.name == name; });
}

void scale(Dataset& data, const std::string& name, double by) {
  for (double& value : column(data, name).values)
    value *= by;
}

// As an effect, or among what the data cannot tell from it.
bool names(const Trace& trace, const std::string& column) {
  for (const trace::TracedEffect& effect : trace.effects) {
    if (effect.placed.inputs[0].column == column) return true;
    for (const trace::Alternative& other : effect.alternatives)
      if (other.in_set && (other.derived == column || other.columns == std::vector{column}))
        return true;
  }
  return false;
}

std::vector<std::string> causes(const Trace& trace) {
  std::vector<std::string> names;
  for (const trace::TracedEffect& effect : trace.effects)
    names.push_back(effect.placed.inputs[0].column);
  return names;
}

// Under the noise model's weights a law without the twin's running-in and wear predicts twice as
// badly as it was calibrated.
TEST(LongTrace, NoiseFloorIsNotAboveWhatTheCalibratedLawLeaves) {
  TwinOptions options;
  options.seed = 3;
  options.design = parse_design("points=20", twin::default_design(twin::twin_set("D")));
  options.more_bystanders = true;
  const Trace t = traced(data_of(options), "log_coulomb");
  EXPECT_LT(t.noise_floor.mae_MPa, 1.05 * t.as_calibrated.training.mae_MPa);
  EXPECT_LT(t.noise_floor.rmse_MPa, 1.05 * t.as_calibrated.training.rmse_MPa);
}

TEST(LongTrace, SaysThatNothingWasFoundWhereTheLawIsTheTruth) {
  for (const char* law : {"coulomb", "orowan", "log_coulomb", "exp_coulomb"}) {
    const Trace t = traced(campaign(law, 11));
    EXPECT_EQ(t.verdict, Verdict::nothing_found) << law << trace_text(t);
    EXPECT_TRUE(t.effects.empty());
    EXPECT_EQ(t.extended_model, "");
    EXPECT_FALSE(t.remaining.structure);
    EXPECT_GT(t.remaining.p_value, 0.002) << "two families of four laws: below it in 1.6 %";
    // The floor is known here: what the true law leaves. The noise model pools all tests, while a
    // third of them, at the highest pressure, make most of the error: 1 / sqrt(2 * 18) = 17 %.
    EXPECT_NEAR(t.noise_floor.mae_MPa / t.before.training.mae_MPa, 1, 0.2) << law;
    EXPECT_THAT(t.remaining.note, HasSubstr("that nothing explains"));
    EXPECT_THAT(t.remaining.note, HasSubstr("repeat tests, or give trace.repeatability"));
    EXPECT_GT(t.smallest_seen, 0.02) << "tests differ by 4 %";
    EXPECT_LT(t.smallest_seen, 0.2);
    // Folds: something between alpha and 2.5 alpha had to pay, and did not.
    if (t.nested.folds > 0) {
      EXPECT_GT(t.leads.at(0).p_value, t.alpha) << law << trace_text(t);
    }
    EXPECT_LE(t.nested.offered, 1u);
    EXPECT_FALSE(t.validation_shift.found);
  }
}

TEST(Trace, ScatterIsJudgedByTheRepeatability) {
  TraceOptions how;
  how.repeatability = 0.05;
  const Trace null = traced(campaign("log_coulomb", 4), how);
  EXPECT_EQ(null.verdict, Verdict::nothing_missing) << null.remaining.note;
  EXPECT_EQ(null.repeatability_from, "given");
  TwinOptions options = campaign("log_coulomb", 4, "form=linear,column=film_um,strength=0.6");
  options.hide = {"film_um", "film2_um"};
  const Trace t = traced(options, how);
  EXPECT_TRUE(t.effects.empty()) << trace_text(t);
  EXPECT_GT(t.scatter_between, 0.05) << "the film's scatter is left between experiments";
  EXPECT_GT(t.scatter_at_least, 0.05);
  EXPECT_EQ(t.verdict, Verdict::unexplained_structure);
  EXPECT_THAT(t.remaining.note, HasSubstr("something that no column recorded differs"));
}

TEST(Trace, RepeatedTestsSayWhatTheRigRepeats) {
  TwinOptions options = campaign("log_coulomb", 4);
  options.profile = "constant";
  options.bystanders = options.more_bystanders = false; // tests with other tools are not repeats
  options.design =
      parse_design("p=500,2750;psi=1,20;v=5,500;T=20,200;replicates=2;points=40", *options.design);
  const Trace t = traced(options);
  EXPECT_EQ(t.repeatability_from, "repeats");
  ASSERT_TRUE(t.repeatability.has_value());
  // Of 16 pairs: three standard errors are 53 %.
  EXPECT_NEAR(*t.repeatability, 0.04, 0.02);
  EXPECT_EQ(t.verdict, Verdict::nothing_missing) << trace_text(t);
}

struct Planted {
  const char* effect;
  const char* column;
  ActsOn acts_on;
};

class LongTracePlanted : public testing::TestWithParam<Planted> {};

TEST_P(LongTracePlanted, EffectIsFoundPlacedAndRemoved) {
  const Planted& p = GetParam();
  const Trace t = traced(campaign("log_coulomb", 4, p.effect));
  ASSERT_EQ(t.verdict, Verdict::effect_added) << trace_text(t);
  EXPECT_EQ(t.effects.front().placed.inputs[0].column, p.column) << trace_text(t);
  EXPECT_EQ(t.effects.front().placed.acts_on, p.acts_on);
  EXPECT_LE(t.effects.front().p_value, 0.5 * t.alpha);
  EXPECT_EQ(t.extended_model, "log_coulomb_traced");
  EXPECT_EQ(t.unseen, "validation");
  EXPECT_LT(t.after.validation.mae_MPa, t.before.validation.mae_MPa);
  EXPECT_GT(t.improvement.interval.low, 0);
  EXPECT_GT(t.nested.gain, t.nested.std_error);
  EXPECT_EQ(t.nested.folds, 10u);
  EXPECT_NEAR(t.noise_floor.mae_MPa / t.after.training.mae_MPa, 1, 0.2); // as of the truth
  EXPECT_GT(t.effects.front().gain_MPa, 0);
  EXPECT_FALSE(t.validation_shift.found);
}

std::string name_of(const testing::TestParamInfo<Planted>& test) {
  std::string name = test.param.column;
  std::erase(name, '_');
  return name + std::to_string(test.index);
}

// Twice as large as an 81-test campaign needs them.
INSTANTIATE_TEST_SUITE_P(
    Effects, LongTracePlanted,
    testing::Values(
        Planted{"form=saturation,column=s_mm,strength=0.6", "s_mm", ActsOn::mu},
        Planted{"form=power,column=humidity_pct,strength=0.6", "humidity_pct", ActsOn::mu},
        Planted{"form=category,column=tool,strength=0.6", "tool", ActsOn::mu},
        Planted{"form=hinge,column=psi,strength=0.6", "psi", ActsOn::mu},
        Planted{"form=linear,column=peak_sigma_n,strength=0.6", "peak_sigma_n", ActsOn::mu},
        Planted{"form=logarithmic,column=dwell_s,strength=0.6", "dwell_s", ActsOn::mu}),
    name_of);

// Adds two texts, drawn for each test, and changes friction by the pair of their levels alone: up
// where both are the first or both the second.
void add_pair(Dataset& data, double change, std::uint64_t seed) {
  Random random(seed, 1);
  Column oil{"oil", "", {}, {"A", "B"}}, coat{"coat", "", {}, {"none", "TiN"}};
  auto& tau = column(data, "tau_R_MPa").values;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const bool b = random.below(2) == 1, tin = random.below(2) == 1;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      oil.values.push_back(b);
      coat.values.push_back(tin);
      tau[i] *= b == tin ? 1 + change : 1 - change;
    }
  }
  data.columns.push_back(oil);
  data.columns.push_back(coat);
}

TEST(LongTrace, TwoTextsThatActOnlyTogetherAreFound) {
  Data data = data_of(few_columns(campaign("coulomb", 5)));
  add_pair(data.training, 0.12, 1);
  add_pair(data.validation, 0.12, 2);
  const Trace t = traced(data, "coulomb");
  ASSERT_EQ(t.effects.size(), 1u) << trace_text(t);
  EXPECT_EQ(t.effects[0].placed.form->name, "category_pair");
  EXPECT_EQ(effects::level_names(t.effects[0].placed),
            (std::vector<std::string>{"none, A", "none, B", "TiN, A", "TiN, B"}));
  EXPECT_NEAR(t.effects[0].placed.parameters[0], 0.12, 0.03);
  EXPECT_EQ(t.effects[0].curve.factor.size(), 4u);
  EXPECT_THAT(t.notes, Not(Contains(HasSubstr("oil"))));
}

// Of a batch with another supplier no test shows anything.
TEST(LongTrace, TwoTextsOfWhichPairsWereNotTestedAreNotSearched) {
  Data data = data_of(few_columns(campaign("coulomb", 5)));
  for (Dataset* part : {&data.training, &data.validation}) {
    add_pair(*part, 0, 1);
    Column &oil = column(*part, "oil"), &coat = column(*part, "coat");
    for (std::size_t i = 0; i < oil.values.size(); ++i)
      if (oil.values[i] == 1) coat.values[i] = 1;
  }
  const Trace t = traced(data, "coulomb");
  EXPECT_THAT(t.notes,
              Contains("coat x oil, as not every pair of levels has 2 tests: not searched"));
}

TEST(LongTrace, DriftAlongADeclaredOrderIsReportedNotShipped) {
  const TwinOptions options =
      campaign("log_coulomb", 6, "form=linear,column=latent,latent=drift,strength=0.6");
  const Trace t = traced(options, declared_order());
  EXPECT_EQ(t.verdict, Verdict::unexplained_structure) << trace_text(t);
  EXPECT_TRUE(t.order.found);
  EXPECT_EQ(t.order.column, "run_order");
  EXPECT_GT(t.order.size_MPa, 0);
  EXPECT_THAT(t.remaining.note, HasSubstr("drift, wear or batch"));
  // The law keeps its form; its parameters are those of a campaign without the drift.
  EXPECT_EQ(t.extended_model, "log_coulomb_traced");
  EXPECT_EQ(models::parameter_names(*t.extended.model.law),
            models::parameter_names(*models::find_law("log_coulomb")));
  EXPECT_LT(t.after.validation.mae_MPa, 1.05 * t.before.validation.mae_MPa);

  // The same drift in a file that nobody said anything about: files are sorted in many ways.
  Data data = data_of(options);
  for (Dataset* part : {&data.training, &data.validation}) {
    std::vector<std::size_t> by(part->experiments.size());
    std::iota(by.begin(), by.end(), 0);
    const auto place = [&](std::size_t e) { return part->values("run_order")[part->first_row[e]]; };
    std::stable_sort(by.begin(), by.end(),
                     [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    *part = part->subset(by);
    std::erase_if(part->columns, [](const Column& c) {
      return c.name == "run_order" || c.name == "batch" || c.name == "lab_T_C";
    });
    for (std::size_t e = 0; e < part->experiments.size(); ++e)
      part->experiments[e] = fmt::format("{:03}", e);
  }
  const Trace unsaid = traced(data, "log_coulomb");
  EXPECT_FALSE(unsaid.order.found) << trace_text(unsaid);
  EXPECT_EQ(unsaid.order.column, "");
  EXPECT_THAT(unsaid.remaining.note, Not(HasSubstr("order of tests")));
}

// Tests numbered 1, 2, ... in each file, in the twin's order.
void number_tests(Dataset& part, const std::string& name) {
  std::vector<double>& places = column(part, "run_order").values;
  const std::vector<double> before = places;
  for (std::size_t e = 0; e < part.experiments.size(); ++e) {
    double place = 1;
    for (std::size_t other = 0; other < part.experiments.size(); ++other)
      place += before[part.first_row[other]] < before[part.first_row[e]];
    std::fill(places.begin() + static_cast<long>(part.first_row[e]),
              places.begin() + static_cast<long>(part.first_row[e + 1]), place);
  }
  column(part, "run_order").name = name;
}

TEST(Trace, AColumnCalledLikeAnOrderThatNumbersTheTestsIsOne) {
  Data data =
      data_of(campaign("log_coulomb", 6, "form=linear,column=latent,latent=drift,strength=0.6"));
  for (Dataset* part : {&data.training, &data.validation})
    number_tests(*part, "Test_No");
  const Trace t = traced(data, "log_coulomb");
  EXPECT_TRUE(t.order.found) << trace_text(t);
  EXPECT_EQ(t.order.column, "Test_No");
  EXPECT_EQ(t.verdict, Verdict::unexplained_structure);

  for (Dataset* part : {&data.training, &data.validation})
    column(*part, "Test_No").name = "K";
  EXPECT_EQ(traced(data, "log_coulomb").order.column, "");
  for (Dataset* part : {&data.training, &data.validation}) {
    column(*part, "K").role = data::Role::order;
    column(*part, "K").why = data::set_by_job;
  }
  EXPECT_EQ(traced(data, "log_coulomb").order.column, "K");
}

// Also where a search sees a part of the tests only, which are not numbered without gaps.
TEST(LongTrace, IsTheSameWhereTheOrderIsDeclaredByItsNameAndByTheJob) {
  TwinOptions options =
      few_columns(campaign("log_coulomb", 6, "form=category,column=tool,strength=0.6"));
  options.effects.push_back(
      twin::parse_effect("form=linear,column=latent,latent=drift,strength=0.6"));
  options.design = parse_design("points=8", *options.design);
  Data data = data_of(options);
  for (Dataset* part : {&data.training, &data.validation})
    number_tests(*part, "Test_No");
  const Trace by_name = traced(data, "log_coulomb");
  ASSERT_EQ(by_name.verdict, Verdict::effect_added) << trace_text(by_name);
  EXPECT_TRUE(by_name.order.found);
  TraceOptions how;
  how.order = "Test_No";
  const Trace by_job = traced(data, "log_coulomb", how);
  EXPECT_EQ(by_name.nested.gain, by_job.nested.gain);
  EXPECT_EQ(by_name.nested.std_error, by_job.nested.std_error);
  EXPECT_EQ(trace_json({by_name}, true), trace_json({by_job}, true));
}

TEST(LongTrace, ABatchIsNotBlamedForWhatFollowsTheOrderOfTests) {
  for (const char* hidden : {"latent=order,on=tau", "latent=batch"}) {
    const Trace t =
        traced(campaign("log_coulomb", 3,
                        fmt::format("form=linear,column=latent,{},strength=0.6", hidden)),
               declared_order());
    EXPECT_TRUE(t.effects.empty()) << trace_text(t);
    EXPECT_TRUE(t.order.found) << hidden;
  }
}

TEST(LongTrace, WearMayBeShippedWhereTheUserDeclaresTheToolDistance) {
  TraceOptions how = declared_order();
  how.tool_distance = "run_order";
  const Trace t =
      traced(campaign("log_coulomb", 6, "form=linear,column=run_order,strength=0.6"), how);
  EXPECT_EQ(t.verdict, Verdict::effect_added) << trace_text(t);
}

// Not the twin's: its effects act on one of the two branches.
TEST(LongTrace, AParameterOfTheTracedLawThatABoundHoldsHasNoErrorAndSaysSo) {
  // Orowan's kink is Shaw's law with an exponent beyond any bound.
  const Data data =
      data_of(few_columns(campaign("orowan", 5, "form=power,column=humidity_pct,strength=0.8")));
  const Trace t = traced(data, "shaw");
  ASSERT_EQ(t.extended_model, "shaw_traced") << trace_text(t);
  const calibrate::ModelFit& fit = t.extended;
  EXPECT_EQ(fit.model.law->parameters[2].name, "n");
  EXPECT_TRUE(std::isnan(fit.std_error[2]));
  EXPECT_GT(fit.std_error[3], 0) << "of the effect";
  EXPECT_THAT(fit.remarks, Contains(StartsWith("n is at its bound 20: experiments with sigma_N")));
}

TEST(LongTrace, WhatMovesBothBranchesOfOrowanIsPlacedOnBoth) {
  Data data = data_of(campaign("orowan", 6));
  for (Dataset* part : {&data.training, &data.validation}) {
    const auto humidity = part->values("humidity_pct");
    std::vector<double>& tau = column(*part, "tau_R_MPa").values;
    for (std::size_t i = 0; i < tau.size(); ++i)
      tau[i] *= 1 - 0.01 * (humidity[i] - 45);
  }
  const Trace t = traced(data, "orowan");
  EXPECT_THAT(causes(t), testing::ElementsAre("humidity_pct")) << trace_text(t);
  ASSERT_FALSE(t.effects.empty());
  EXPECT_EQ(t.effects.front().placed.acts_on, ActsOn::mu_m);
  EXPECT_LT(t.after.validation.mae_MPa, 0.7 * t.before.validation.mae_MPa);
}

// A humidity that rises with the order of tests, or is set in turn.
TEST(LongTrace, WhatGoesWithTheOrderOfTestsIsOfferedTogetherWithTheTestsThatWouldDecide) {
  Data data = data_of(campaign("log_coulomb", 6));
  std::vector<double> humidity;
  for (Dataset* part : {&data.training, &data.validation}) {
    const auto place = part->values("run_order");
    std::vector<double>& of_part = column(*part, "humidity_pct").values;
    std::vector<double>& tau = column(*part, "tau_R_MPa").values;
    for (std::size_t i = 0; i < tau.size(); ++i) {
      of_part[i] = 30 + 0.3 * place[i] + 0.5 * std::fmod(place[i], 3);
      tau[i] *= 1 + 0.01 * (of_part[i] - 45);
    }
  }
  const Trace t = traced(data, "log_coulomb", declared_order());
  EXPECT_TRUE(t.effects.empty()) << trace_text(t);
  ASSERT_FALSE(t.leads.empty());
  const trace::Lead& lead = t.leads.front();
  EXPECT_THAT(lead.columns, testing::ElementsAre("humidity_pct")) << trace_text(t);
  EXPECT_THAT(lead.why,
              HasSubstr("a drift over the order of tests explains it as well (run_order)"));
  EXPECT_THAT(lead.design.settles, testing::ElementsAre("humidity_pct", "run_order"));
  ASSERT_GE(lead.design.tests.size(), 4u);
  for (std::size_t i = 1; i < lead.design.tests.size(); ++i)
    EXPECT_NE(lead.design.tests[i], lead.design.tests[i - 1]) << "low and high in turn";
}

TEST(Trace, IgnoredColumnsCannotBeACause) {
  TraceOptions how;
  how.ignore = {"humidity_pct"};
  const Trace t =
      traced(campaign("log_coulomb", 4, "form=power,column=humidity_pct,strength=0.6"), how);
  EXPECT_THAT(causes(t), Not(Contains("humidity_pct")));
  how.ignore = {"humidity"};
  try {
    traced(campaign("log_coulomb", 4), how);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no column 'humidity'"));
  }
}

// One trace for what would cost three.
TEST(LongTrace, IsTheSameForAnyNumberOfThreadsAndReadBackFromItsFile) {
  TwinOptions options =
      few_columns(campaign("log_coulomb", 4, "form=power,column=humidity_pct,strength=0.6"));
  options.design = parse_design("points=10", *options.design);
  set_threads(1);
  const Trace t = traced(options);
  const std::string one = trace_json({t}, true);
  set_threads(2);
  EXPECT_EQ(trace_json({traced(options)}, true), one);
  set_threads(0);
  const std::string text = trace_json({t, t}, true);
  const std::vector<Trace> back = trace::parse_traces(text, "trace.json");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(trace_text(back[0]), trace_text(t));
  EXPECT_EQ(back[0].as_calibrated.training.mae_MPa, t.as_calibrated.training.mae_MPa);
  EXPECT_EQ(back[0].nested.gain, t.nested.gain);
  EXPECT_EQ(back[0].nested.std_error, t.nested.std_error);
}

// Verdict and columns of a campaign with an effect.
void expect_same(const Trace& one, const Trace& other, const char* what) {
  EXPECT_EQ(one.verdict, other.verdict) << what;
  EXPECT_EQ(causes(one), causes(other)) << what;
  const auto named = [](const Trace& t) {
    std::vector<std::string> forms;
    for (const trace::TracedEffect& e : t.effects)
      forms.push_back(e.placed.form->name + " on " + effects::acts_on_name(e.placed.acts_on));
    return forms;
  };
  EXPECT_EQ(named(one), named(other)) << what;
}

// (Coulomb's law: log_coulomb bounds the stress in its logarithm at 1 kPa, which a unit moves.)
TEST(LongTrace, DoesNotDependOnUnitDigitsOrTheOrderOfFiles) {
  TwinOptions options =
      few_columns(campaign("coulomb", 4, "form=power,column=humidity_pct,strength=0.6"));
  options.design = parse_design("points=8", *options.design); // five traces
  const Data data = data_of(options);
  const Trace plain = traced(data, "coulomb");
  ASSERT_EQ(plain.verdict, Verdict::effect_added) << trace_text(plain);
  for (const double unit : {1e-6, 1e6}) {
    Data scaled = data;
    for (Dataset* part : {&scaled.training, &scaled.validation})
      for (const char* stress : {"sigma_n_MPa", "sigma_f_MPa", "tau_R_MPa"})
        scale(*part, stress, unit);
    const Trace t = traced(scaled, "coulomb");
    expect_same(t, plain, unit > 1 ? "1e6" : "1e-6");
    // Errors are in that unit, to what the fits converge to.
    EXPECT_NEAR(t.after.validation.mae_MPa / unit / plain.after.validation.mae_MPa, 1, 1e-3);
  }
  Data noisy = data;
  Random random(1, 2);
  for (double& tau : column(noisy.training, "tau_R_MPa").values)
    tau *= 1 + 1e-7 * random.normal();
  expect_same(traced(noisy, "coulomb"), plain, "1e-7");
  Data shuffled = data;
  std::vector<std::size_t> order(data.training.experiments.size());
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(std::span(order));
  shuffled.training = data.training.subset(order);
  random.shuffle(std::span(shuffled.training.columns));
  expect_same(traced(shuffled, "coulomb"), plain, "order");
}

// The law, a factor of its own in each test, and a column for it.
Data with_factor(double size, double in_validation) {
  TwinOptions options = few_columns(campaign("log_coulomb", 8));
  options.design->validation = 24;
  Data data = data_of(options);
  Random random(8, 3);
  for (Dataset* part : {&data.training, &data.validation}) {
    Column wire{"wire", "", {}, {}};
    std::vector<double>& tau = column(*part, "tau_R_MPa").values;
    for (std::size_t e = 0; e < part->experiments.size(); ++e) {
      const double z = random.normal();
      for (std::size_t i = part->first_row[e]; i < part->first_row[e + 1]; ++i) {
        tau[i] *= std::exp(size * z);
        wire.values.push_back(10 + (part == &data.training ? z : in_validation * z));
      }
    }
    part->columns.push_back(std::move(wire));
  }
  return data;
}

// Twelve tests, left out in turn, leave open whether a run-in predicts better; forty others do not.
TEST(LongTrace, ManyValidationTestsShowWhatFewLeftOutTestsLeaveOpen) {
  TwinOptions options = campaign("log_coulomb", 1, "form=saturation,column=s_mm,strength=0.17");
  options.design = parse_design("p=500,1200,2750;psi=1,20;v=5,500;T=110;points=10;validation=40",
                                twin::default_design(twin::twin_set("D")));
  Data data = data_of(options);
  ASSERT_EQ(data.training.experiments.size(), 12u);
  const Trace t = traced(data, "log_coulomb");
  EXPECT_TRUE(names(t, "s_mm")) << trace_text(t);
  EXPECT_EQ(t.nested.paying, 0u);
  EXPECT_GT(t.improvement.interval.low, 0);
  EXPECT_THAT(trace_text(t), HasSubstr("shown by the validation tests; training tests, left out "
                                       "in turn, leave it open: error"));
  const std::vector<std::size_t> eight = {0, 1, 2, 3, 4, 5, 6, 7};
  data.validation = data.validation.subset(eight);
  const Trace few = traced(data, "log_coulomb"); // of twenty tests, all of which are searched
  EXPECT_EQ(causes(few), std::vector<std::string>{"s_mm"}) << trace_text(few);
  EXPECT_TRUE(few.validation_searched);
}

TEST(Trace, TestsThatChangeOneStateAtATimeAreRecognised) {
  const auto states = [](bool together) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(24, 3);
    for (Eigen::Index e = 0; e < 24; ++e)
      for (Eigen::Index s = 0; s < 3; ++s)
        if (together ? (e >> s) % 2 == 0 : e % 4 == s) all(e, s) = e % 3 == 0 ? 1 : -1;
    return all;
  };
  EXPECT_TRUE(trace::one_factor_at_a_time(states(false)));
  EXPECT_FALSE(trace::one_factor_at_a_time(states(true)));
  EXPECT_FALSE(trace::one_factor_at_a_time(Eigen::MatrixXd::Random(24, 1))) << "of one state";
}

TEST(LongTrace, AnEffectThatValidationContradictsIsALeadThatSaysSo) {
  const Trace good = traced(with_factor(0.3, 1), "log_coulomb");
  EXPECT_EQ(good.verdict, Verdict::effect_added) << trace_text(good);
  EXPECT_EQ(causes(good), std::vector<std::string>{"wire"});
  const Trace t = traced(with_factor(0.3, -1), "log_coulomb");
  EXPECT_TRUE(t.effects.empty()) << trace_text(t);
  EXPECT_EQ(t.extended_model, "");
  EXPECT_EQ(t.verdict, Verdict::unexplained_structure);
  ASSERT_FALSE(t.leads.empty());
  EXPECT_EQ(t.leads.front().columns, std::vector<std::string>{"wire"});
  EXPECT_THAT(t.leads.front().why, StartsWith("contradicted by the validation tests"));
  EXPECT_THAT(t.leads.front().why, Not(HasSubstr("hardly vary")));
  EXPECT_THAT(t.remaining.note, HasSubstr("the validation tests contradict"));
  Data same = with_factor(0.3, 0);
  std::vector<double>& wire = column(same.validation, "wire").values;
  std::fill(wire.begin(), wire.end(), 11.0);
  const Trace unseen = traced(same, "log_coulomb");
  ASSERT_FALSE(unseen.leads.empty());
  EXPECT_THAT(unseen.leads.front().why,
              testing::EndsWith("; the validation tests hardly vary wire"));
}

TEST(Trace, AValidationFromAnotherWorldIsCalledThat) {
  Data data = data_of(campaign("log_coulomb", 11));
  for (double& tau : column(data.validation, "tau_R_MPa").values)
    tau += 57;
  const Trace t = traced(data, "log_coulomb");
  EXPECT_EQ(t.verdict, Verdict::unexplained_structure) << trace_text(t);
  EXPECT_TRUE(t.validation_shift.found);
  EXPECT_GT(t.validation_shift.interval.low, 0);
  EXPECT_THAT(t.remaining.note,
              HasSubstr(fmt::format("lie {:+.3g} MPa off the training tests as a whole",
                                    t.validation_shift.shift_MPa)));
  // A shift of ln(tau), brought back to MPa: the same for tests of equal stress only.
  EXPECT_NEAR(t.validation_shift.shift_MPa, 57, 20);
  EXPECT_TRUE(t.effects.empty());
}

TEST(Trace, SaysWhatItCouldHaveSeen) {
  const Trace t = traced(campaign("log_coulomb", 11));
  const auto find = [&](const std::string& name) {
    return *std::find_if(t.detectable.begin(), t.detectable.end(),
                         [&](const trace::Detectable& d) { return d.column == name; });
  };
  EXPECT_TRUE(find("humidity_pct").identifiable);
  // A difference between experiments that scatter by 4 % needs about 4.7 standard errors.
  EXPECT_NEAR(find("film_um").share, 4.7 * 0.045 / std::sqrt(tests), 0.012);
  EXPECT_LT(find("s_mm").share, find("film_um").share)
      << "what changes within every experiment is seen better";
}

TEST(LongTrace, FewExperimentsProveNothingAndSaySo) {
  TwinOptions options = campaign("coulomb", 1, "form=saturation,column=s_mm,amplitude=0.8");
  options.design = parse_design("p=500,2750;psi=1;v=5;T=20,200;points=60;validation=2",
                                twin::default_design(twin::twin_set("D")));
  const Trace t = traced(options);
  EXPECT_TRUE(t.effects.empty());
  EXPECT_THAT(trace_text(t), HasSubstr("lacks, by its residual: no effect that so few tests can"));
  EXPECT_EQ(t.least_p_value, 0.03125) << "of four tests and two to validate";
  // Twelve tests, which all show the same effect.
  options.design = parse_design("T=20,56,92,128,164,200", *options.design);
  const Trace more = traced(options);
  EXPECT_TRUE(names(more, "s_mm")) << trace_text(more); // the contact heats up as it slides
  EXPECT_EQ(more.unseen, "nested_cross_validation") << "two validation tests judge nothing";
  EXPECT_EQ(more.extended.validation.n_experiments, 2u) << "all laws are ranked on the same tests";
  EXPECT_EQ(more.after.validation.n_experiments, 14u) << "all are searched";
}

TEST(Trace, OneOrTwoExperimentsGiveLeadsAndNoEffect) {
  TwinOptions options = campaign("coulomb", 1);
  for (const char* pressures : {"p=500", "p=500,2750"}) {
    options.design = parse_design(std::string(pressures) + ";psi=1;v=5;T=20;points=60;validation=3",
                                  twin::default_design(twin::twin_set("D")));
    const Trace t = traced(options);
    EXPECT_TRUE(t.effects.empty());
    EXPECT_FALSE(t.leads.empty());
    EXPECT_THAT(trace_text(t), HasSubstr("it takes 7 that show it to add an effect"));
  }
}

// Rates over small campaigns; frictab_bench_trace has the large set and the table.
TEST(LongTraceRates, SevenOfEightPlantedEffectsAreFoundInTheNamedSet) {
  const std::pair<const char*, const char*> planted[] = {
      {"exponential", "T_tool_C"}, {"linear", "Ra_um"},
      {"logarithmic", "film_um"},  {"bump", "T_contact_C"},
      {"linear", "vib"},           {"category", "direction"},
      {"linear", "mean_sigma_n"},  {"saturation", "friction_work"}};
  int detected = 0, named = 0;
  for (const auto& [form, column] : planted) {
    TwinOptions options =
        campaign("log_coulomb", 21, fmt::format("form={},column={},strength=0.6", form, column));
    options.design->points = 10; // eight searches, each repeated twenty times
    const Trace t = traced(options);
    detected += t.verdict == Verdict::effect_added;
    named += names(t, column);
  }
  EXPECT_GE(detected, 7);
  EXPECT_GE(named, 7);
}

TEST(LongTraceRates, CampaignsThatLackNothingGiveFalseAlarmsAsRarelyAsAsked) {
  int found = 0, added = 0, flagged = 0;
  for (std::uint64_t seed = 31; seed < 41; ++seed)
    for (const char* noise : {"normal", "t4", "heteroscedastic"}) {
      TwinOptions options = campaign(seed % 2 ? "orowan" : "exp_coulomb", seed);
      options.noise = noise;
      options.more_bystanders = false;
      options.design = parse_design("psi=1,20;T=20,200;points=15", *options.design);
      const Trace t = traced(options);
      found += t.nested.offered > 0;
      added += !t.effects.empty();
      flagged += t.verdict == Verdict::unexplained_structure;
      for (const trace::Lead& lead : t.leads)
        EXPECT_LT(std::abs(lead.share), 3) << seed << noise << trace_text(t);
    }
  // Binomial, 30 at 0.02 and at 0.01: more than 3 in 0.2 %.
  EXPECT_LE(found, 3);
  EXPECT_LE(added, 2) << "what the search finds has to predict left-out tests as well";
  EXPECT_LE(flagged, 3);
}

TEST(LongTraceRates, NoneOfSixUnrecordedCausesIsBlamedOnAColumn) {
  for (const char* hidden : {"direction", "dwell_s", "film_um"})
    for (const std::uint64_t seed : {51u, 52u}) {
      TwinOptions options =
          campaign("log_coulomb", seed, fmt::format("form=linear,column={},strength=0.3", hidden));
      if (std::string(hidden) == "direction")
        options.effects = {twin::parse_effect("form=category,column=direction,strength=0.3")};
      options.hide = {hidden};
      if (std::string(hidden) == "film_um") options.hide.push_back("film2_um"); // goes with it
      const Trace t = traced(options);
      EXPECT_TRUE(t.effects.empty()) << hidden << seed << trace_text(t);
    }
}

} // namespace
} // namespace frictab::trace_test
