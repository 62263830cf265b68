// Mistakes of units and columns, each made once in a campaign without any; and campaigns without
// any.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "data/plausibility.h"
#include "support/run_command.h"
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

// Forces of the stresses over 2 mm2, without load and friction but for noise in the first 15 rows.
void add_forces(Dataset& data) {
  std::vector<double> normal, friction;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      const bool contact = i >= data.first_row[e] + 15;
      const double noise = 0.5 * std::sin(12.9898 * double(i));
      normal.push_back(contact ? 2 * data.values("sigma_n_MPa")[i] : 1 + noise);
      friction.push_back(contact ? 2 * data.values("tau_R_MPa")[i] : 0.1 * noise);
    }
  std::erase_if(data.columns, [](const auto& c) { return c.name == "F_R_N" || c.name == "F_N_N"; });
  data.columns.push_back({"F_N_N", "N", normal, {}});
  data.columns.push_back({"F_R_N", "N", friction, {}});
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

TEST(SlowPlausibility, FindsNoZeroPointInAHundredCampaignsThatStartWithoutLoad) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed)
    for (const char* profile : {"constant", "varied"})
      for (const char* noise : {"t4", "heteroscedastic"}) {
        Dataset data = campaign(seed, profile, noise);
        add_forces(data);
        for (const Implausible& one : data::find_implausible(data))
          EXPECT_NE(one.check, "force_offset")
              << seed << " " << profile << " " << noise << " " << one.what;
      }
}

// The examples' jobs over the files as their rigs wrote them.
TEST(Plausibility, FindsNothingInMeasuredCampaigns) {
  namespace fs = std::filesystem;
  const char* set = std::getenv("FRICTAB_MEASURED");
  const fs::path source = FRICTAB_SOURCE_DIR;
  const fs::path measured = set ? fs::path(set) : source.parent_path() / "shared" / "measured";
  if (!fs::is_directory(measured)) GTEST_SKIP() << "no measured files here; set FRICTAB_MEASURED";
  for (const auto& [example, files] : {std::pair("02_rock_velocity_steps", "rock_velocity_steps"),
                                       {"03_ptfe_pin_on_disc", "pps_ptfe_pin_on_disc"},
                                       {"08_composite_filler", "al10cu_composites"}}) {
    const test::TemporaryDirectory directory;
    fs::copy(source / "examples" / example, directory.path());
    fs::create_directory_symlink(fs::canonical(measured / files / "data"), directory.path("data"));
    const auto result = test::run_frictab({"data", directory.path("job.toml"), "-q"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, testing::Not(HasSubstr("implausible"))) << example;
  }
}

TEST(Plausibility, FindsUnitsOfStressesByTheCoefficient) {
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "sigma_n_MPa", 1e6); }),
              HasSubstr("pressure! sigma_n_MPa is above 20,000; contact normal stress in Pa"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "sigma_n_MPa", 1e-3); }),
              HasSubstr("friction_coefficient! tau_R_MPa/sigma_n_MPa is outside 0.001 to 3.6"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "tau_R_MPa", 1e-3); }),
              HasSubstr("shear stress in GPa?"));
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "tau_R_MPa", 1e6); }),
              HasSubstr("shear stress in Pa or kPa?"));
}

TEST(Plausibility, RemarksCoefficientsOfRubberAndOfAMeanThatIsNone) {
  const auto told = [](const std::function<void(Dataset&)>& change) {
    Dataset data = campaign();
    change(data);
    FaultList faults;
    data::check_plausibility(data, {"shear_yield"}, {}, faults);
    std::string text;
    for (const Fault& fault : faults.all())
      text += "ERROR " + fault.what;
    for (const std::string& one : data.implausible)
      text += one + "\n";
    return text;
  };
  const auto coefficient = [](double mu) {
    return [mu](Dataset& d) {
      const std::vector<double> sigma = values(d, "sigma_n_MPa");
      for (std::size_t i = 0; i < sigma.size(); ++i)
        values(d, "tau_R_MPa")[i] = mu * sigma[i] * (1 + 1e-3 * static_cast<double>(i % 7));
    };
  };
  EXPECT_THAT(told(coefficient(0.9)), testing::Not(HasSubstr("is above 1")));
  EXPECT_THAT(told(coefficient(2)), HasSubstr("is above 1, 2.01 in the middle of these rows"));
  EXPECT_THAT(told(coefficient(2)), testing::Not(HasSubstr("ERROR")));
  EXPECT_THAT(told(coefficient(3.7)), HasSubstr("ERROR tau_R_MPa/sigma_n_MPa is outside 0.001"));
  EXPECT_THAT(told(coefficient(-0.1)),
              HasSubstr("the mean of tau_R_MPa/sigma_n_MPa is -0.1 in test '"));
  EXPECT_THAT(told(coefficient(-0.1)), testing::Not(HasSubstr("ERROR")));
}

TEST(Plausibility, FindsALoadChannelThatIsDeadOrDropsOut) {
  EXPECT_THAT(found_after([](Dataset& d) { scale(d, "sigma_n_MPa", 0); }),
              HasSubstr("no_load! sigma_n_MPa is 0 where tau_R_MPa is not"));
  EXPECT_THAT(found_after([](Dataset& d) {
                std::vector<double>& pressure = values(d, "sigma_n_MPa");
                for (std::size_t i = 0; i < pressure.size(); i += 6)
                  pressure[i] = 0;
              }),
              HasSubstr("no_load: sigma_n_MPa is 0 where tau_R_MPa is not"));
  EXPECT_EQ(found_after([](Dataset& d) { // before contact there is noise
              std::erase_if(d.columns, [](const auto& c) { return c.name.starts_with("F_"); });
              for (std::size_t e = 0; e < d.experiments.size(); ++e) {
                values(d, "sigma_n_MPa")[d.first_row[e]] = 0;
                values(d, "tau_R_MPa")[d.first_row[e]] = 0.3;
              }
            }),
            "nothing");
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

TEST(Plausibility, NamesATestThatIsACopyOfAnother) {
  const std::size_t e3 = campaign().first_row[3], rows = campaign().first_row[4] - e3;
  ASSERT_EQ(campaign().first_row[6] - campaign().first_row[5], rows);
  const auto copy = [&](Dataset& d) {
    for (data::Column& column : d.columns)
      std::copy_n(column.values.begin() + std::ptrdiff_t(e3), rows,
                  column.values.begin() + std::ptrdiff_t(d.first_row[5]));
  };
  const std::string said = fmt::format("copied_test: test '{}' has the rows of test '{}', value by "
                                       "value",
                                       campaign().experiments[5], campaign().experiments[3]);
  EXPECT_THAT(found_after(copy), HasSubstr(said));
  EXPECT_THAT(found_after([&](Dataset& d) {
                copy(d);
                values(d, "tau_R_MPa")[d.first_row[5] + 7] += 1e-9;
              }),
              testing::Not(HasSubstr("copied_test")));
}

TEST(Plausibility, NamesATestThatIsTheBeginningOfAnother) {
  const std::size_t e3 = campaign().first_row[3], first = campaign().first_row[5];
  for (const std::size_t rows : {25, 6}) { // few rows may be alike by chance
    const std::string found = found_after([&](Dataset& d) {
      for (data::Column& column : d.columns) {
        std::copy_n(column.values.begin() + std::ptrdiff_t(e3), rows,
                    column.values.begin() + std::ptrdiff_t(first));
        column.values.erase(column.values.begin() + std::ptrdiff_t(first + rows),
                            column.values.begin() + std::ptrdiff_t(d.first_row[6]));
      }
      const std::size_t gone = d.first_row[6] - first - rows;
      for (std::size_t e = 6; e < d.first_row.size(); ++e)
        d.first_row[e] -= gone;
    });
    const std::string said =
        fmt::format("copied_test: test '{}' has the first 25 rows of test '{}', "
                    "value by value",
                    campaign().experiments[5], campaign().experiments[3]);
    EXPECT_EQ(found.find(said) != found.npos, rows == 25) << found;
  }
}

TEST(Plausibility, TakesACoarseChannelForNoStuckOneAndANoisyPathForNoWrongSpeed) {
  const std::string coarse = found_after([](Dataset& d) {
    std::vector<double>& tau = values(d, "tau_R_MPa");
    for (std::size_t i = 0; i < tau.size(); ++i) {
      tau[i] = 5 * std::round(tau[i] / 5);
      values(d, "sigma_n_MPa")[i] += 0.1 * double(i % 2);
    }
  });
  EXPECT_THAT(coarse, testing::Not(HasSubstr("stuck_channel")));
  const auto shake = [](Dataset& d) {
    Random random(7);
    std::vector<double>& path = values(d, "s_mm");
    const double step = std::abs(path[1] - path[0]);
    for (double& s : path)
      s += 3 * step * random.normal();
  };
  EXPECT_THAT(found_after(shake), testing::Not(HasSubstr("s_mm grows")));
  EXPECT_THAT(found_after([&](Dataset& d) {
                shake(d);
                scale(d, "v_rel_mm_s", 1e-3);
              }),
              HasSubstr("speed! s_mm grows"));
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

void shift(Dataset& data, const std::string& name, double by, std::size_t tests) {
  for (std::size_t i = 0; i < data.first_row[tests]; ++i)
    values(data, name)[i] += by;
}

TEST(Plausibility, FindsZeroPointsThatWereNotSet) {
  EXPECT_EQ(found_after(add_forces), "nothing") << "zeros";
  const std::string friction = found_after([](Dataset& d) {
    add_forces(d);
    shift(d, "F_R_N", 60, d.experiments.size());
  });
  EXPECT_THAT(friction,
              testing::StartsWith("force_offset! F_R_N is 60 N before contact in test '"));
  EXPECT_THAT(friction, HasSubstr("', not 0 (and 80 more tests); a zero point that was not set?"));
  EXPECT_THAT(found_after([](Dataset& d) {
                add_forces(d);
                shift(d, "F_R_N", -60, 2);
              }),
              testing::StartsWith("force_offset: F_R_N is -60 N before contact in test '"));
  EXPECT_THAT(found_after([](Dataset& d) {
                add_forces(d);
                shift(d, "F_N_N", 400, d.experiments.size());
              }),
              testing::StartsWith("force_offset! F_N_N is 401 N before contact in test '"));
}

// In contact by eq. 1, as where a rig records no stress.
void follow_forces(Dataset& data) {
  for (std::size_t i = 0; i < data.rows(); ++i)
    if (data.values("v_rel_mm_s")[i] > 0)
      values(data, "tau_R_MPa")[i] =
          data.values("F_R_N")[i] / data.values("F_N_N")[i] * data.values("sigma_n_MPa")[i];
}

TEST(Plausibility, TakesALoadAtRestOrOnItsWayForNoOffset) {
  EXPECT_EQ(found_after([](Dataset& d) { // pressed before it slides
              add_forces(d);
              shift(d, "F_N_N", 400, d.experiments.size());
              for (std::size_t e = 0; e < d.experiments.size(); ++e)
                for (std::size_t i = d.first_row[e]; i < d.first_row[e] + 15; ++i)
                  values(d, "v_rel_mm_s")[i] = 0;
              follow_forces(d);
            }),
            "nothing");
  EXPECT_EQ(found_after([](Dataset& d) { // a slow ramp, with the higher coefficient of low loads
              add_forces(d);
              for (std::size_t e = 0; e < d.experiments.size(); ++e)
                for (std::size_t k = 0; k < 15; ++k) {
                  const std::size_t i = d.first_row[e] + k;
                  values(d, "F_N_N")[i] = 4.0 * double(k + 1);
                  values(d, "F_R_N")[i] = 2.0 * double(k + 1);
                }
            }),
            "nothing");
}

// At most (or least) this value: the end of an amplifier.
void clip(Dataset& data, const std::string& name, double share, std::size_t tests) {
  std::vector<double> sorted = values(data, name);
  std::sort(sorted.begin(), sorted.end());
  const double end = sorted[std::size_t(share * double(sorted.size()))];
  for (std::size_t i = 0; i < data.first_row[tests]; ++i)
    values(data, name)[i] = std::min(values(data, name)[i], end);
  for (std::size_t i = data.first_row[tests]; i < data.rows(); ++i)
    if (values(data, name)[i] >= end) values(data, name)[i] = 0.9 * end;
}

TEST(Plausibility, FindsAChannelAtTheEndOfItsAmplifier) {
  const auto clipped = [](Dataset& d) {
    std::erase_if(d.columns, [](const auto& c) { return c.name == "F_R_N" || c.name == "F_N_N"; });
    clip(d, "tau_R_MPa", 0.75, d.experiments.size());
  };
  const std::string found = found_after(clipped);
  EXPECT_THAT(found, testing::StartsWith("clipped_channel: tau_R_MPa stays at "));
  EXPECT_THAT(found, HasSubstr("an amplifier at the end of its range?"));
  Dataset data = campaign();
  clipped(data);
  for (const Implausible& one : data::find_implausible(data))
    EXPECT_NE(one.check, "stuck_channel") << "told once";
}

TEST(Plausibility, TakesNominalLoadsPlateausAndCoarseChannelsForNoEndOfAnAmplifier) {
  const auto fine = [](const char* what, const std::function<void(Dataset&)>& change) {
    Dataset data = campaign();
    change(data);
    for (const Implausible& one : data::find_implausible(data))
      EXPECT_NE(one.check, "clipped_channel") << what << ": " << one.what;
  };
  const auto each_row = [](Dataset& d, const std::function<double(std::size_t, double)>& value) {
    for (std::size_t e = 0; e < d.experiments.size(); ++e)
      for (std::size_t i = d.first_row[e]; i < d.first_row[e + 1]; ++i)
        values(d, "sigma_n_MPa")[i] = value(i - d.first_row[e], values(d, "sigma_n_MPa")[i]);
  };
  fine("one load", [&](Dataset& d) { each_row(d, [](std::size_t, double) { return 900.; }); });
  fine("a ramp and a hold, as set", [&](Dataset& d) {
    each_row(d, [](std::size_t i, double) { return std::min(900., 30. * double(i + 1)); });
  });
  fine("a plateau that is measured", [&](Dataset& d) {
    each_row(d, [](std::size_t i, double) {
      return std::min(900., 30. * double(i + 1)) + std::sin(12.9898 * double(i));
    });
  });
  fine("a coarse channel", [](Dataset& d) {
    for (double& value : values(d, "tau_R_MPa"))
      value = 50 * std::round(value / 50);
  });
  fine("no friction at first", [](Dataset& d) {
    for (std::size_t e = 0; e < d.experiments.size(); ++e)
      for (std::size_t i = d.first_row[e]; i < d.first_row[e] + 15; ++i)
        values(d, "tau_R_MPa")[i] = 0;
  });
}

TEST(Plausibility, ACoefficientThatIsRoundedAtRestContradictsNoForces) {
  EXPECT_THAT(found_after([](Dataset& d) {
                add_forces(d);
                for (std::size_t e = 0; e < d.experiments.size(); ++e)
                  for (std::size_t i = d.first_row[e + 1] - 8; i < d.first_row[e + 1]; ++i) {
                    values(d, "F_R_N")[i] *= 0.01;
                    values(d, "tau_R_MPa")[i] *= i % 2 == 0 ? 0.02 : 0.005;
                  }
              }),
              testing::Not(HasSubstr("contradict")));
}

TEST(Plausibility, FindsAStressThatContradictsItsForces) {
  EXPECT_THAT(found_after([](Dataset& d) {
                add_forces(d);
                scale(d, "F_R_N", 2);
              }),
              testing::StartsWith("forces! F_R_N/F_N_N is 2 times tau_R_MPa/sigma_n_MPa in the "
                                  "middle: they contradict each other; "));
  EXPECT_EQ(found_after([](Dataset& d) { // as a display rounds them
              add_forces(d);
              for (const char* force : {"F_R_N", "F_N_N"})
                for (double& value : values(d, force))
                  value = std::round(value);
            }),
            "nothing");
}

TEST(Plausibility, FindsAPathThatRunsBackwardsAndTakesNoNoiseForOne) {
  const auto reverse = [](Dataset& d, std::size_t tests) {
    for (std::size_t e = 0; e < tests; ++e)
      std::reverse(values(d, "s_mm").begin() + long(d.first_row[e]),
                   values(d, "s_mm").begin() + long(d.first_row[e + 1]));
  };
  EXPECT_THAT(found_after([&](Dataset& d) { reverse(d, d.experiments.size()); }),
              testing::StartsWith("path! s_mm runs backwards in test '"));
  EXPECT_THAT(found_after([&](Dataset& d) { reverse(d, 2); }),
              testing::StartsWith("path: s_mm runs backwards in test '" +
                                  campaign().experiments[0] + "' (and 1 more test); a position"));
  EXPECT_THAT(found_after([](Dataset& d) { values(d, "s_mm")[30] = 0; }),
              testing::StartsWith("path: s_mm runs backwards in test '"))
      << "a single row";
  EXPECT_EQ(found_after([](Dataset& d) {
              Random random(7);
              for (double& s : values(d, "s_mm"))
                s += random.normal() * 0.3; // 1 step
            }),
            "nothing");
}

TEST(Plausibility, SaysInItsOwnWordsThatNothingWasMeasured) {
  Dataset data = campaign();
  std::erase_if(data.columns, [](const auto& c) { return c.name == "F_R_N" || c.name == "F_N_N"; });
  for (double& value : values(data, "tau_R_MPa"))
    value = 0;
  const std::vector<Implausible> found = data::find_implausible(data);
  ASSERT_EQ(found.size(), 1u) << found.back().what;
  EXPECT_EQ(found[0].check, "no_friction");
  EXPECT_TRUE(found[0].most());
  EXPECT_EQ(found[0].what, "tau_R_MPa is 0 in every row: nothing was measured");
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
