// The noise floor: from repeated tests, from the twin's own truth, from scatter within experiments.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "calibrate/metrics.h"
#include "calibrate/noise_floor.h"
#include "calibrate/replicates.h"
#include "core/random.h"
#include "twin/twin.h"

namespace frictab::noise_floor_test {

using calibrate::oracle_floor;
using calibrate::replicate_floor;
using calibrate::replicate_groups;
using data::Dataset;
using twin::Twin;

namespace {

Twin campaign(const std::string& design, std::uint64_t seed) {
  twin::TwinOptions options;
  options.seed = seed;
  options.bystanders = false; // tests with other tools are not repeats
  options.design = twin::parse_design(design, twin::default_design(twin::twin_set("D")));
  Twin twin = twin::make_twin(options);
  twin.training.data.oracle_MPa = twin.training.oracle_MPa;
  return twin;
}

// Experiments of equal states whose tau is `level` of the experiment in every row.
Dataset levels(const std::vector<double>& tau, const std::vector<double>& sigma) {
  Dataset data;
  data.columns = {{"sigma_n_MPa", "MPa", {}, {}},
                  {"psi", "1", {}, {}},
                  {"s_mm", "mm", {}, {}},
                  {"tau_R_MPa", "MPa", {}, {}}};
  for (std::size_t e = 0; e < tau.size(); ++e) {
    for (int i = 0; i < 20; ++i) {
      data.columns[0].values.push_back(sigma[e]);
      data.columns[1].values.push_back(1 + 0.125 * i); // exact, so that halfway is halfway
      data.columns[2].values.push_back(i);
      data.columns[3].values.push_back(tau[e]);
    }
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.first_row.back() + 20);
  }
  return data;
}

TEST(Replicates, AreTheExperimentsOfOneLevelOfTheTwinAndNoOthers) {
  const Twin twin = campaign("psi=1,20;points=30;replicates=3", 3);
  const auto groups = replicate_groups(twin.training.data);
  ASSERT_EQ(groups.size(), 54u);
  for (const auto& group : groups) {
    ASSERT_EQ(group.size(), 3u);
    EXPECT_EQ(group[1], group[0] + 54);
    EXPECT_EQ(group[2], group[0] + 108);
  }
  EXPECT_TRUE(replicate_groups(twin.validation.data).empty()) << "random states";
}

TEST(Replicates, MayDifferByOnePercentOfTheRangeButNotByTwo) {
  // ln 500 .. ln 2000 is the range: 1 % of it is a factor of 1.014.
  EXPECT_EQ(replicate_groups(levels({1, 2, 3, 4}, {500, 506, 1000, 2000})).size(), 1u);
  EXPECT_EQ(replicate_groups(levels({1, 2, 3, 4}, {500, 515, 1000, 2000})).size(), 0u);
}

// Four loads and one speed, three tests each, as a rig holds and reads them.
TEST(Replicates, AreSeenWhereStatesAreHeldWithScatter) {
  Random random(5, 0);
  const auto campaign = [&](const std::vector<double>& loads) {
    std::vector<double> tau, sigma;
    for (const double load : loads)
      for (int again = 0; again < 3; ++again) {
        tau.push_back(load / 10);
        sigma.push_back(load * (1 + 0.01 * random.normal())); // as set
      }
    Dataset data = levels(tau, sigma);
    data.columns.push_back({"v_rel_mm_s", "mm/s", {}, {}});
    for (double& value : data.columns[0].values) {
      value *= 1 + 0.01 * random.normal(); // as read
      data.columns.back().values.push_back(50 + 0.5 * random.normal());
    }
    return data;
  };
  const auto groups = replicate_groups(campaign({4, 12, 40, 90}));
  ASSERT_EQ(groups.size(), 4u);
  for (const auto& group : groups)
    EXPECT_EQ(group.size(), 3u);
  std::vector<double> apart;
  for (int i = 0; i < 12; ++i)
    apart.push_back(4 * std::pow(1.2, i));
  for (const auto& group : replicate_groups(campaign(apart)))
    EXPECT_EQ(group.front() / 3, group.back() / 3) << "loads a fifth apart are no repeats";
}

TEST(Replicates, DifferInAReadingOfTheAirThatMovesALittle) {
  Random random(6, 0);
  Dataset data = levels({1, 2, 3, 4, 5, 6}, {500, 500, 500, 1000, 1000, 1000});
  data.columns.push_back({"humidity", "%", {}, {}});
  data.columns.back().role = data::Role::setting;
  for (std::size_t i = 0; i < data.rows(); ++i)
    data.columns.back().values.push_back((i / 20 % 3 == 2 ? 60 : 30) + 0.1 * random.normal());
  const auto groups = replicate_groups(data);
  ASSERT_EQ(groups.size(), 2u);
  for (const auto& group : groups)
    EXPECT_EQ(group.size(), 2u);
}

TEST(Replicates, AreNotClaimedWhereNothingTellsExperimentsApart) {
  Dataset data = levels({1, 2, 3}, {500, 500, 500});
  std::erase_if(data.columns, [](const data::Column& c) { return c.name == "psi"; });
  EXPECT_TRUE(replicate_groups(data).empty());
}

TEST(NoiseFloor, IsNotAboveWhatTheBestLawErrs) {
  calibrate::Calibration calibration;
  calibration.judged_by = calibrate::JudgedBy::leave_one_out;
  calibration.fits.resize(2);
  calibration.fits[0].validation.mae_MPa = 0.03;
  calibration.fits[0].validation.rmse_MPa = 0.04;
  calibration.fits[1].validation.mae_MPa = 0.9;
  for (const char* method : {"oracle", "replicates"}) {
    calibrate::NoiseFloor floor;
    floor.method = method;
    floor.mae_MPa = 0.059;
    floor.rmse_MPa = 0.07;
    floor.mae_interval = {0.05, 0.07};
    floor.n_experiments = 22;
    floor.n_groups = 2;
    calibration.noise_floors.push_back(floor);
  }
  calibrate::lower_noise_floors(calibration);
  calibrate::lower_noise_floors(calibration); // traced laws were added
  EXPECT_EQ(calibration.noise_floors[0].mae_MPa, 0.059) << "the twin's own truth is known";
  const calibrate::NoiseFloor& lowered = calibration.noise_floors[1];
  EXPECT_EQ(lowered.mae_MPa, 0.03);
  EXPECT_EQ(lowered.rmse_MPa, 0.04);
  EXPECT_EQ(lowered.measured_MPa, 0.059);
  EXPECT_EQ(lowered.mae_interval.high, 0.03);
  EXPECT_EQ(calibrate::noise_floor_name(lowered),
            "22 repeated tests in 2 groups (0.059 MPa, more than the best law errs)");
  calibration.noise_floors.erase(calibration.noise_floors.begin());
  EXPECT_EQ(calibrate::noise_floor_sentence(calibration, 3),
            "noise floor below 0.030 MPa: 22 repeated tests in 2 groups (0.059 MPa, more than the "
            "best law errs)");
  EXPECT_EQ(calibrate::noise_floor_advice(calibration),
            "the repeated tests differ in something that no column records");
  calibration.noise_floors[0].mae_interval.low = 0.02;
  EXPECT_EQ(calibrate::noise_floor_advice(calibration), "") << "it may be chance";
}

TEST(NoiseFloor, OfThreeReplicatesIsTheirStandardDeviation) {
  const auto floor = replicate_floor(levels({10, 13, 19, 50}, {500, 500, 500, 2000}), 100, 1);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->rmse_MPa, std::sqrt((16.0 + 1 + 25) / 2), 1e-12) << "n - 1 in the denominator";
  EXPECT_EQ(floor->n_groups, 1u);
  EXPECT_EQ(floor->n_experiments, 3u);
  EXPECT_EQ(floor->n_rows, 60u);
}

TEST(NoiseFloor, ComparesRowsAtTheSameSlidingDistance) {
  // tau rises by 1 MPa per step of 0.125 mm; the second test was 4 MPa higher and sampled every
  // second step. Row by row they would be 100 MPa apart in the mean.
  Dataset data;
  data.columns = {
      {"sigma_n_MPa", "MPa", {}, {}}, {"s_mm", "mm", {}, {}}, {"tau_R_MPa", "MPa", {}, {}}};
  for (int e = 0; e < 3; ++e) {
    const int step = e == 1 ? 2 : 1;
    for (int i = 0; i < 400; i += step) {
      data.columns[0].values.push_back(e == 2 ? 2000 : 500);
      data.columns[1].values.push_back(0.125 * i); // exact, so that halfway is halfway
      data.columns[2].values.push_back(i + (e == 1 ? 4 : 0));
    }
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.columns[0].values.size());
  }
  const auto floor = replicate_floor(data, 0, 1);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->n_rows, 600u);
  // Every second step has no partner of its own and takes the next one.
  EXPECT_NEAR(floor->mae_MPa, (400 * 4 + 199 * 5 + 3) / 600.0 / std::sqrt(2.0), 1e-9);
}

TEST(NoiseFloor, OfReplicatesHoldsTheKnownNoiseInItsInterval) {
  // The same levels with many more replicates give the expectation.
  const Twin many = campaign("psi=1,20;v=5,500;points=40;replicates=40", 8);
  const auto truth = oracle_floor(many.training.data, 0, 1);
  const Twin twin = campaign("psi=1,20;v=5,500;points=40;replicates=3", 3);
  const auto floor = replicate_floor(twin.training.data, 999, 1);
  ASSERT_TRUE(truth && floor);
  EXPECT_LT(floor->mae_interval.low, truth->mae_MPa);
  EXPECT_GT(floor->mae_interval.high, truth->mae_MPa);
  EXPECT_LT(floor->rmse_interval.low, truth->rmse_MPa);
  EXPECT_GT(floor->rmse_interval.high, truth->rmse_MPa);
  EXPECT_LT(floor->mae_interval.high - floor->mae_interval.low, 0.7 * truth->mae_MPa)
      << "an interval that holds everything says nothing";
}

TEST(NoiseFloor, OfReplicatesIsUnbiasedForAnyNumberOfThem) {
  for (const char* replicates : {"2", "5"}) {
    const Twin twin =
        campaign(std::string("psi=1,20;points=20;replicates=") + replicates + "0", 21);
    // 20 and 50 experiments per level, cut into groups of 2 and 5 by what they are called.
    const Dataset& data = twin.training.data;
    const auto truth = oracle_floor(data, 0, 1);
    const std::size_t n = static_cast<std::size_t>(replicates[0] - '0');
    double square = 0, absolute = 0;
    for (std::size_t part = 0; part < 10; ++part) {
      std::vector<std::size_t> keep;
      for (std::size_t e = part * n * 54; e < (part + 1) * n * 54; ++e)
        keep.push_back(e);
      const auto floor = replicate_floor(data.subset(keep), 0, 1);
      ASSERT_TRUE(floor);
      EXPECT_EQ(floor->n_groups, 54u);
      square += floor->rmse_MPa * floor->rmse_MPa / 10;
      absolute += floor->mae_MPa / 10;
    }
    EXPECT_NEAR(std::sqrt(square), truth->rmse_MPa, 0.05 * truth->rmse_MPa) << replicates;
    EXPECT_NEAR(absolute, truth->mae_MPa, 0.05 * truth->mae_MPa) << replicates;
  }
}

TEST(NoiseFloor, OfTheOracleIsTheOraclesError) {
  const Twin twin = campaign("psi=1,20;points=30", 3);
  const Dataset& data = twin.training.data;
  const auto floor = oracle_floor(data, 100, 1);
  const calibrate::Metrics m = calibrate::metrics(data.values("tau_R_MPa"),
                                                  twin.training.oracle_MPa, data.first_row, 100, 1);
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->mae_MPa, m.mae_MPa);
  EXPECT_EQ(floor->rmse_MPa, m.rmse_MPa);
  EXPECT_FALSE(oracle_floor(twin.validation.data, 100, 1)) << "no oracle given";
}

TEST(NoiseFloor, WithinExperimentsIsTheWhiteNoiseAndNotTheOffsetsBetweenThem) {
  Random random(2);
  std::vector<double> offsets;
  for (int e = 0; e < 20; ++e)
    offsets.push_back(100 + 30 * random.normal());
  Dataset data = levels(offsets, std::vector<double>(20, 800.0));
  // 200 rows each, on a bow.
  for (data::Column& column : data.columns)
    column.values.resize(20 * 200, 1.0);
  for (std::size_t i = 0; i < 4000; ++i)
    data.columns[3].values[i] =
        offsets[i / 200] + 20 * std::sin(0.01 * static_cast<double>(i % 200)) + 5 * random.normal();
  for (std::size_t e = 0; e <= 20; ++e)
    data.first_row[e] = 200 * e;
  const auto floor = calibrate::within_floor(calibrate::scatter_in_tests(data), 100, 1);
  ASSERT_TRUE(floor);
  EXPECT_TRUE(floor->lower_bound);
  EXPECT_NEAR(floor->rmse_MPa, 5, 0.2);
  EXPECT_NEAR(floor->mae_MPa, 5 * std::sqrt(2 / M_PI), 0.15);
}

TEST(NoiseFloor, IsTakenFromTheMostTrustworthySourceAndSaidAsWhatItIs) {
  Twin twin = campaign("psi=1,20;points=30;replicates=2;validation=6", 3);
  Dataset &training = twin.training.data, &validation = twin.validation.data;
  const auto floors = [&] {
    calibrate::Calibration calibration;
    calibrate::CalibrationInput input{training, validation, {}, {}};
    calibrate::add_noise_floors(calibration, input);
    return calibration;
  };
  calibrate::Calibration c = floors();
  EXPECT_EQ(c.noise_floors.front().method, "oracle");
  EXPECT_EQ(c.noise_floors.front().part, "training");
  training.oracle_MPa.clear();
  c = floors();
  ASSERT_EQ(c.noise_floors.size(), 3u);
  EXPECT_EQ(c.noise_floors[0].method, "replicates");
  EXPECT_EQ(calibrate::noise_floor_sentence(c, 2),
            fmt::format("noise floor {:.2f} MPa: 108 repeated tests in 54 groups, of the training "
                        "data",
                        c.noise_floors[0].mae_MPa));
  EXPECT_EQ(calibrate::noise_floor_advice(c), "");
  c.noise_floors.erase(c.noise_floors.begin());
  EXPECT_EQ(calibrate::noise_floor_sentence(c, 2),
            fmt::format("noise floor above {:.2f} MPa: scatter within experiments only, scatter "
                        "between experiments not included",
                        c.noise_floors[0].mae_MPa));
  EXPECT_EQ(calibrate::noise_floor_advice(c), "repeat any one test twice, unchanged");
  c.noise_floors.clear();
  EXPECT_EQ(calibrate::noise_floor_sentence(c, 2),
            "noise floor unknown: no repeated tests, and experiments "
            "too short to see their scatter");
}

} // namespace
} // namespace frictab::noise_floor_test
