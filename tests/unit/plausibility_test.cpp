// Mistakes of units and columns, each made once in a campaign without any; and campaigns without
// any.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "data/plausibility.h"
#include "twin/twin.h"

namespace frictab::plausibility_test {

using data::Dataset;
using data::Implausible;
using testing::HasSubstr;

namespace {

Dataset campaign(std::uint64_t seed = 1, const std::string& profile = "constant",
                 const std::string& noise = "normal") {
  twin::TwinOptions options;
  options.seed = seed;
  options.profile = profile;
  options.noise = noise;
  options.design =
      twin::parse_design("points=60;validation=1", twin::default_design(twin::twin_set("D")));
  return twin::make_twin(options).training.data;
}

std::vector<double>& values(Dataset& data, const std::string& name) {
  for (data::Column& column : data.columns)
    if (column.name == name) return column.values;
  throw std::logic_error(name);
}

void scale(Dataset& data, const std::string& name, double factor) {
  for (double& value : values(data, name))
    value *= factor;
}

// What is found after this mistake, with the first of them.
std::string found_after(const std::function<void(Dataset&)>& mistake) {
  Dataset data = campaign();
  mistake(data);
  const std::vector<Implausible> found = data::find_implausible(data);
  return found.empty() ? "nothing"
                       : found.front().check + (found.front().most() ? "! " : ": ") +
                             found.front().what + "; " + found.front().hint;
}

TEST(Plausibility, FindsNothingInCampaignsWithoutMistakes) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    for (const Implausible& one : data::find_implausible(campaign(seed)))
      ADD_FAILURE() << seed << " " << one.check << ": " << one.what;
}

TEST(SlowPlausibility, RaisesNoFalseAlarmInAHundredCampaigns) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed)
    for (const char* profile : {"constant", "varied"})
      for (const char* noise : {"t4", "heteroscedastic"})
        for (const Implausible& one : data::find_implausible(campaign(seed, profile, noise)))
          EXPECT_LT(one.rows, one.of / 100 + 1)
              << seed << " " << profile << " " << noise << " " << one.check << ": " << one.what;
}

TEST(Plausibility, FindsUnitsOfStressesByTheCoefficient) {
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "sigma_n_MPa", 1e6); }),
              HasSubstr("pressure! sigma_n_MPa is above 20,000; contact normal stress in Pa"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "sigma_n_MPa", 1e-3); }),
              HasSubstr("friction_coefficient! tau_R_MPa/sigma_n_MPa is outside 0.001 to 1"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "tau_R_MPa", 1e-3); }),
              HasSubstr("shear stress in GPa?"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "tau_R_MPa", 1e6); }),
              HasSubstr("shear stress in Pa or kPa?"));
}

TEST(Plausibility, FindsACoefficientInPercentAndForcesTakenForEachOther) {
  const auto swap = [](Dataset& d) {
    std::vector<double>&tau = values(d, "tau_R_MPa"), &sigma = values(d, "sigma_n_MPa");
    for (std::size_t i = 0; i < tau.size(); ++i)
      tau[i] = sigma[i] * sigma[i] / tau[i];
  };
  EXPECT_THAT(found_after([](Dataset& d) {
                std::erase_if(d.columns, [](const auto& c) { return c.name == "F_R_N"; });
                scale(d, "tau_R_MPa", 100);
              }),
              HasSubstr("a coefficient in percent?"));
  EXPECT_THAT(found_after([&](Dataset& d) {
                swap(d);
                for (const char* name : {"F_R_N", "F_N_N"})
                  if (!d.has(name)) d.columns.push_back({name, "N", values(d, "tau_R_MPa"), {}});
              }),
              HasSubstr("F_R_N and F_N_N taken for each other?"));
}

TEST(Plausibility, FindsStressesAboveTheShearYieldStress) {
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "sigma_f_MPa", 1e-3); }),
              HasSubstr("shear_yield! tau_R_MPa is above the shear yield stress"));
}

TEST(Plausibility, FindsTemperaturesInKelvinSpeedsInMetresAndExpansionInPercent) {
  EXPECT_THAT(found_after([](Dataset& d) {
                for (double& value : values(d, "T_contact_C"))
                  value += 273.15;
              }),
              HasSubstr("temperature! T_contact_C is"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "v_rel_mm_s", 1e-3); }),
              HasSubstr("speed! s_mm grows 1e+03 times as fast as v_rel_mm_s says"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "psi", 100); }),
              HasSubstr("surface_expansion! psi is above 100"));
}

TEST(Plausibility, NotesAStuckChannelAndATestApartWithTheirNames) {
  const std::string stuck = found_after([](Dataset& d) {
    std::vector<double>& tau = values(d, "tau_R_MPa");
    for (std::size_t i = d.first_row[3] + 10; i < d.first_row[3] + 40; ++i) {
      tau[i] = 99;
      values(d, "sigma_n_MPa")[i] += 0.1 * double(i % 2);
    }
    if (d.has("F_R_N")) std::erase_if(d.columns, [](const auto& c) { return c.name == "F_R_N"; });
  });
  EXPECT_THAT(stuck, HasSubstr("stuck_channel: the same value 20 times in a row or more, while "
                               "load or speed change: tau_R_MPa "
                               "in test '" +
                               campaign().experiments[3] + "'"));
  EXPECT_THAT(found_after([](Dataset& d) {
                std::vector<double>& tau = values(d, "tau_R_MPa");
                for (std::size_t i = d.first_row[5]; i < d.first_row[6]; ++i)
                  tau[i] *= 0.05;
              }),
              HasSubstr("test_apart: test '" + campaign().experiments[5] + "' stands apart"));
}

TEST(Plausibility, TakesAStressThatNothingChangesForNoStuckChannel) {
  Dataset data = campaign();
  for (const char* name : {"tau_R_MPa", "sigma_n_MPa", "v_rel_mm_s"})
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
        values(data, name)[i] = values(data, name)[data.first_row[e]];
  std::erase_if(data.columns, [](const auto& c) { return c.name == "F_R_N" || c.name == "F_N_N"; });
  for (const Implausible& one : data::find_implausible(data))
    EXPECT_NE(one.check, "stuck_channel") << "a twin without noise";
}

TEST(Plausibility, WhatMostRowsFailIsAnErrorUnlessItIsAllowed) {
  Dataset data = campaign();
  scale(data, "psi", 100);
  try {
    FaultList faults;
    data::check_plausibility(data, {}, {"job.toml", 2, 1}, faults);
    faults.throw_if_any();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("job.toml:2:1: error: psi is above 100 ("));
    EXPECT_THAT(error.what(),
                HasSubstr("if it is right: data.allow_implausible = [\"surface_expansion\"]"));
  }
  FaultList faults;
  data::check_plausibility(data, {"surface_expansion"}, {}, faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_THAT(data.implausible, testing::ElementsAre(HasSubstr("psi is above 100 (")));
}

} // namespace

} // namespace frictab::plausibility_test
