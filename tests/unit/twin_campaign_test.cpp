// Claims about campaigns that residual tracing is scored on: stress profiles, noise levels,
// bystanders.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/twin_fault.h"
#include "twin/twin.h"
#include "twin/twin_effect.h"

namespace frictab::twin_campaign_test {

using twin::make_twin;
using twin::parse_scatter;
using twin::Twin;
using twin::TwinOptions;

namespace {

using test::fault_of;
using testing::HasSubstr;

TwinOptions small(const std::string& design = "v=5,500;points=110;validation=6") {
  TwinOptions options;
  options.seed = 1;
  options.design = twin::parse_design(design, twin::default_design(twin::twin_set("D")));
  return options;
}

std::span<const double> column(const twin::TwinPart& part, const char* name) {
  return part.data.values(name);
}

TEST(TwinProfiles, VariedOnesTellHighestFromMeanAndMomentaryStress) {
  TwinOptions options = small();
  options.profile = "varied";
  const Twin twin = make_twin(options);
  const auto sigma = column(twin.training, "sigma_n_MPa");
  const auto& first = twin.training.data.first_row;
  std::set<std::size_t> places; // of the highest stress: start, middle and end of the stroke
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    const auto rows = sigma.subspan(first[e], first[e + 1] - first[e]);
    const auto peak = std::max_element(rows.begin(), rows.end()) - rows.begin();
    places.insert(static_cast<std::size_t>(3 * peak) / rows.size());
    for (const double s : rows) {
      ASSERT_GE(s, 0.3 * 500);
      ASSERT_LE(s, 1.05 * 2005);
    }
  }
  EXPECT_EQ(places.size(), 3u);
}

TEST(TwinProfiles, ReplicatesDiffer) {
  TwinOptions options = small("p=1725;psi=20;v=50;T=20;replicates=12;points=50;validation=0");
  options.profile = "varied";
  const Twin twin = make_twin(options);
  std::set<double> last;
  for (std::size_t e = 1; e <= 12; ++e)
    last.insert(column(twin.training, "sigma_n_MPa")[50 * e - 1]);
  EXPECT_GE(last.size(), 3u);
}

TEST(TwinProfiles, UnknownOneIsNamed) {
  TwinOptions options = small();
  options.profile = "variid";
  EXPECT_THAT(fault_of(options), HasSubstr("unknown profile 'variid'\n  hint: did you mean"));
}

// Standard deviation of the mean logarithm of noise per test, about the mean of all.
double between_tests(const Twin& twin) {
  const auto tau = column(twin.training, "tau_R_MPa");
  const auto& first = twin.training.data.first_row;
  std::vector<double> means;
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    double sum = 0;
    for (std::size_t i = first[e]; i < first[e + 1]; ++i)
      sum += std::log(tau[i] / twin.training.oracle_MPa[i]);
    means.push_back(sum / static_cast<double>(first[e + 1] - first[e]));
  }
  const double mean = twin::mean_of(means);
  double square = 0;
  for (const double m : means)
    square += (m - mean) * (m - mean);
  return std::sqrt(square / static_cast<double>(means.size() - 1));
}

TEST(TwinScatter, LevelsAreThoseAskedFor) {
  TwinOptions options = small("v=5,50,500;replicates=3;points=110;validation=0");
  options.scatter = parse_scatter("test=0.04, slow=0, white=0");
  EXPECT_NEAR(between_tests(make_twin(options)), 0.04, 0.006); // 243 tests: 0.0018
  options.scatter = parse_scatter("test=0,slow=0,white=0.012");
  const Twin white = make_twin(options);
  const auto tau = column(white.training, "tau_R_MPa");
  double square = 0;
  for (std::size_t i = 0; i < tau.size(); ++i)
    square += std::pow(std::log(tau[i] / white.training.oracle_MPa[i]), 2);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(tau.size())), 0.012, 2e-4);
}

TEST(TwinScatter, SlowNoiseHasTheCorrelationAskedFor) {
  TwinOptions options = small("v=5,50,500;points=550;validation=0");
  options.scatter = parse_scatter("test=0,slow=0.04,rho=0.8,white=0");
  const Twin twin = make_twin(options);
  const auto tau = column(twin.training, "tau_R_MPa");
  double next = 0, own = 0;
  double before = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const double noise = std::log(tau[i] / twin.training.oracle_MPa[i]);
    if (i % 550 > 0) next += noise * before;
    if (i % 550 > 0) own += before * before;
    before = noise;
  }
  EXPECT_NEAR(next / own, 0.8, 0.01);
}

TEST(TwinScatter, GivenAsInTheSetLeavesEveryBit) {
  TwinOptions options = small();
  const Twin plain = make_twin(options);
  options.scatter = parse_scatter("white=0.025,rho=0.97");
  EXPECT_EQ(plain.training.data.find("tau_R_MPa")->values,
            make_twin(options).training.data.find("tau_R_MPa")->values);
}

TEST(TwinScatter, FaultsAreNamed) {
  const auto fault = [](const char* text) -> std::string {
    try {
      parse_scatter(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  };
  EXPECT_THAT(fault("tests=0.04"), HasSubstr("unknown key 'tests'\n  hint: did you mean 'test'?"));
  EXPECT_THAT(fault("rho=1"), HasSubstr("rho = 1 is outside 0 to 0.9999\n  hint: "));
  EXPECT_THAT(fault("white=4 %"), HasSubstr("is not a finite number"));
}

double correlation(std::span<const double> x, std::span<const double> y) {
  const double n = static_cast<double>(x.size());
  double sx = 0, sy = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    xx += x[i] * x[i];
    yy += y[i] * y[i];
    xy += x[i] * y[i];
  }
  return (xy - sx * sy / n) / std::sqrt((xx - sx * sx / n) * (yy - sy * sy / n));
}

TwinOptions many_tests() {
  TwinOptions options = small("v=5,50,500;replicates=3;points=20;validation=30");
  options.more_bystanders = true;
  return options;
}

TEST(TwinBystanders, MoreOfThemAreWhatTheySay) {
  const Twin twin = make_twin(many_tests());
  const twin::TwinPart& part = twin.training;
  EXPECT_NEAR(correlation(column(part, "film_um"), column(part, "film2_um")), 0.9, 0.04);
  EXPECT_GT(correlation(column(part, "run_order"), column(part, "lab_T_C")), 0.9);
  EXPECT_NEAR(correlation(column(part, "vib"), column(part, "tau_R_MPa")), 0, 0.05);
  const auto dwell = column(part, "dwell_s");
  EXPECT_GE(*std::min_element(dwell.begin(), dwell.end()), 1);
  EXPECT_LE(*std::max_element(dwell.begin(), dwell.end()), 100);
  EXPECT_EQ(part.data.find("direction")->levels, (std::vector<std::string>{"across", "along"}));
}

TEST(TwinBystanders, BatchesAreContiguousInTheOrderOfTests) {
  const Twin twin = make_twin(many_tests());
  std::map<double, std::set<double>> batches; // places by batch, both parts
  for (const twin::TwinPart* part : {&twin.training, &twin.validation})
    for (std::size_t i = 0; i < part->data.rows(); ++i)
      batches[column(*part, "batch")[i]].insert(column(*part, "run_order")[i]);
  EXPECT_EQ(batches.size(), 6u);
  for (const auto& [batch, places] : batches)
    EXPECT_EQ(*places.rbegin() - *places.begin() + 1, static_cast<double>(places.size()));
}

TEST(TwinBystanders, MoreOfThemLeaveTheOthersAndTheMeasurement) {
  const Twin plain = make_twin(small());
  TwinOptions options = small();
  options.more_bystanders = true;
  const Twin more = make_twin(options);
  EXPECT_EQ(more.training.data.columns.size(), plain.training.data.columns.size() + 6);
  for (const data::Column& c : plain.training.data.columns)
    EXPECT_EQ(c.values, more.training.data.find(c.name)->values) << c.name;
}

TEST(TwinBystanders, EffectsActOnAddedOnes) {
  for (const char* effect :
       {"form=power,column=dwell_s", "form=category,column=direction", "form=category,column=batch",
        "form=linear,column=vib", "form=linear,column=lab_T_C", "form=hinge,column=film2_um"}) {
    TwinOptions options = small();
    options.more_bystanders = true;
    options.effects = {twin::parse_effect(effect + std::string(",strength=0.1"))};
    EXPECT_NEAR(make_twin(options).effects[0].strength, 0.1, 1e-6) << effect;
  }
}

TEST(TwinBystanders, NoneAndMoreContradictEachOther) {
  TwinOptions options = small();
  options.more_bystanders = true;
  options.bystanders = false;
  EXPECT_THAT(fault_of(options), HasSubstr("contradicts --no-bystanders\n  hint: "));
}

} // namespace
} // namespace frictab::twin_campaign_test
