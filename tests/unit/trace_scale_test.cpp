// Tracing many tests: the work grows with them and no faster, and what stands for all of them says
// what all of them would.
#include <cmath>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "core/parallel.h"
#include "core/random.h"
#include "stats/gram.h"
#include "stats/noise_fit.h"
#include "support/blocks.h"
#include "trace/judge/nested_errors.h"
#include "trace/search/selection.h"
#include "trace/trace.h"
#include "trace/trace_file.h"
#include "trace/tuning.h"

namespace frictab::trace_scale_test {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::Contains;

stats::Blocks tests_of(std::size_t tests, std::size_t rows) {
  return test::blocks_of(std::vector<std::size_t>(tests, rows));
}

TEST(TraceScale, BlocksOfManyTestsShareABudget) {
  EXPECT_EQ(tests_of(200, 550).count(), 200 * 40U);
  EXPECT_LE(tests_of(405, 550).count(), 200 * 40U);
  EXPECT_EQ(tests_of(10000, 550).count(), 10000 * 8U);
  EXPECT_EQ(tests_of(10000, 5).count(), 10000 * 5U) << "a block for each of few rows";
}

TEST(TraceScale, OneOfEachRunOfNeighboursIsSelected) {
  std::vector<std::size_t> rows;
  for (std::size_t e = 0; e < 1000; ++e)
    rows.push_back(1 + e % 7);
  const stats::Blocks all = test::blocks_of(rows);
  trace::Candidates candidates;
  VectorXd number(static_cast<Index>(all.count()));
  for (std::size_t e = 0; e < 1000; ++e)
    for (std::size_t b = all.first[e]; b < all.first[e + 1]; ++b)
      number(static_cast<Index>(b)) = static_cast<double>(e);
  candidates.by_symbol["number"] = number;
  const auto some = trace::select_tests(all, candidates, 1);
  ASSERT_EQ(some->blocks.experiments(), trace::tuning::selected_tests);
  ASSERT_EQ(some->blocks.count(), some->rows.size());
  const VectorXd& of = some->candidates.by_symbol.at("number");
  std::set<int> remainders;
  for (std::size_t i = 0; i < trace::tuning::selected_tests; ++i) {
    const std::size_t begin = some->blocks.first[i], end = some->blocks.first[i + 1];
    const auto test = static_cast<std::size_t>(of(static_cast<Index>(begin)));
    EXPECT_EQ(test / 5, i);
    EXPECT_EQ(end - begin, rows[test]);
    EXPECT_EQ(of(static_cast<Index>(end - 1)), static_cast<double>(test));
    remainders.insert(static_cast<int>(test % 5));
  }
  EXPECT_EQ(remainders.size(), 5U) << "not at equal steps";
  EXPECT_EQ(trace::select_tests(all, candidates, 1)->rows, some->rows);
  EXPECT_EQ(trace::select_tests(tests_of(200, 5), candidates, 1), nullptr);
}

TEST(TraceScale, SymmetricSumsAreTheMatrixProduct) {
  for (const Index rows : {1, 7, 512, 1300})
    for (const Index columns : {0, 1, 3, 6, 41}) {
      MatrixXd j(rows, columns + 1);
      for (Index i = 0; i < j.size(); ++i)
        j(i) = std::sin(1.3 * static_cast<double>(i));
      const auto part = j.rightCols(columns);
      const MatrixXd product = part.transpose() * part, sums = stats::gram(part);
      ASSERT_EQ(sums.rows(), columns);
      if (columns == 0) continue;
      EXPECT_EQ(sums, sums.transpose());
      EXPECT_LT((sums - product).cwiseAbs().maxCoeff(), 1e-12 * static_cast<double>(rows + 1));
    }
}

// Not the twin's noise, nor the model's: gains and slopes are uniform, slow noise is a moving mean
// of exponential draws.
MatrixXd foreign_residual(const stats::Blocks& blocks, std::uint64_t seed) {
  constexpr int memory = 3;
  Random random(seed, 5);
  const auto uniform = [&] { return std::sqrt(12.0) * (random.uniform() - 0.5); };
  MatrixXd residual(static_cast<Index>(blocks.count()), 1);
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    const double gain = 4 * uniform(), slope = 6 * uniform();
    std::vector<double> drawn;
    for (std::size_t i = 0; i < blocks.first[e + 1] - blocks.first[e] + memory; ++i)
      drawn.push_back(-std::log(std::max(random.uniform(), 1e-12)) - 1);
    for (std::size_t b = blocks.first[e]; b < blocks.first[e + 1]; ++b) {
      const auto at = drawn.begin() + static_cast<long>(b - blocks.first[e]);
      const double slow = std::accumulate(at, at + memory, 0.0) / std::sqrt(memory);
      const auto row = static_cast<Index>(b);
      residual(row, 0) = gain + slope * blocks.position(row) + 3 * slow + 2 * random.normal();
    }
  }
  return residual;
}

// Standard deviations that a noise model gives to the mean of a test of 12 blocks, and to a block
// about that mean. (Gain and slow noise alone share what is slow: the data leave their shares
// open.)
struct Deviations {
  double mean, within;
};
Deviations deviations_of(const stats::NoiseModel& n) {
  constexpr int blocks = 12;
  double alike = 0, squares = 0;
  for (int i = 0; i < blocks; ++i) {
    squares += std::pow((i + 0.5) / blocks - 0.5, 2) / blocks;
    for (int j = 0; j < blocks; ++j)
      alike += std::exp(-std::abs(i - j) / (blocks * n.length)) / (blocks * blocks);
  }
  const double slow = n.slow * n.slow, white = n.white * n.white;
  return {
      std::sqrt(n.gain * n.gain + slow * alike + white / blocks),
      std::sqrt(n.slope * n.slope * squares + slow * (1 - alike) + white * (blocks - 1) / blocks)};
}

// A standard deviation of 200 tests is off by 5 % (of normal ones; of uniform ones less).
TEST(LongTraceScale, NoiseOfSelectedTestsAgreesWithThatOfAll) {
  const stats::Blocks all = tests_of(1600, 12);
  const auto some = trace::select_tests(all, {}, 1);
  const auto count = static_cast<Index>(all.count());
  const MatrixXd none(count, 0), fitted = VectorXd::Constant(count, 100);
  const VectorXd tau = fitted.col(0);
  constexpr int campaigns = 4;
  const double error = 1 / std::sqrt(2.0 * static_cast<double>(trace::tuning::selected_tests));
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= campaigns; ++seed) {
    const VectorXd residual = foreign_residual(all, seed).col(0);
    const Deviations whole =
        deviations_of(stats::fit_noise({residual, tau, all, fitted, none}).noise);
    const VectorXd part = residual(some->rows), part_tau = tau(some->rows);
    const MatrixXd part_fitted = fitted(some->rows, Eigen::all), part_none(part.size(), 0);
    const Deviations selected = deviations_of(
        stats::fit_noise({part, part_tau, some->blocks, part_fitted, part_none}).noise);
    const double mean = std::log(selected.mean / whole.mean) / error;
    const double within = std::log(selected.within / whole.within) / error;
    EXPECT_LT(std::abs(mean), 3) << "standard errors: " << selected.mean << " " << whole.mean;
    EXPECT_LT(std::abs(within), 3) << "standard errors: " << selected.within << " " << whole.within;
    squares += (mean * mean + within * within) / (2 * campaigns);
  }
  EXPECT_LT(std::sqrt(squares), 1.5) << "standard errors";
}

// SYNTHETIC: mu falls with the speed as log_coulomb has it; humidity acts between tests, a run-in
// within them; tests scatter by 5 %.
data::Dataset campaign(std::size_t tests, std::uint64_t seed) {
  constexpr std::size_t rows = 12;
  data::Dataset data;
  std::vector<double> sigma, speed, time, slid, humidity, noise_column, tau;
  Random random(seed, 7);
  for (std::size_t e = 0; e < tests; ++e) {
    data.experiments.push_back("E" + std::to_string(100000 + e));
    data.first_row.push_back((e + 1) * rows);
    const double pressure = 500 + 1500 * random.uniform(), v = 5 * std::exp(4 * random.uniform());
    const double humid = 30 + 40 * random.uniform(), other = random.normal();
    const double gain = 1 + 0.05 * random.normal();
    for (std::size_t i = 0; i < rows; ++i) {
      const double s = 2.0 * static_cast<double>(i);
      const double mu = 0.08 * std::pow(pressure / 1000, -0.1) * std::pow(v / 100, -0.05);
      const double factor = std::pow(humid / 50, 0.2) * (1 + 0.1 * (1 - std::exp(-s / 6)));
      sigma.push_back(pressure);
      speed.push_back(v);
      time.push_back(s / v);
      slid.push_back(s);
      humidity.push_back(humid);
      noise_column.push_back(other);
      tau.push_back(mu * pressure * factor * gain * (1 + 0.02 * random.normal()));
    }
  }
  const std::vector<double> room(sigma.size(), 20), flow(sigma.size(), 600);
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& values) {
    data.columns.push_back({name, unit, values, {}});
  };
  add("time_s", "s", time);
  add("sigma_n_MPa", "MPa", sigma);
  add("v_rel_mm_s", "mm/s", speed);
  add("s_mm", "mm", slid);
  add("T_contact_C", "degC", room);
  add("T_tool_C", "degC", room);
  add("psi", "", room);
  add("sigma_f_MPa", "MPa", flow);
  add("humidity_pct", "", humidity);
  add("other", "", noise_column);
  add("tau_R_MPa", "MPa", tau);
  return data;
}

TEST(LongTraceScale, FindsWhatWasPlantedInAThousandTestsWithTheSameBytesOnAnyThreads) {
  const data::Dataset training = campaign(1000, 1), validation = campaign(60, 2);
  calibrate::ModelOptions models;
  models.use = {"log_coulomb"};
  calibrate::CalibrationOptions how;
  how.bootstrap = 100;
  const calibrate::Calibration calibrated =
      calibrate::calibrate({training, validation, models, how});
  const trace::TraceOptions options;
  std::string first;
  for (const unsigned threads : {1U, 4U}) {
    set_threads(threads);
    const trace::Trace found =
        trace::trace({training, validation, calibrated.fits.front(), options, 100, 1});
    std::vector<std::string> columns;
    for (const trace::TracedEffect& effect : found.effects)
      columns.push_back(effect.placed.inputs[0].column);
    EXPECT_THAT(columns, Contains("humidity_pct"));
    EXPECT_THAT(columns,
                Contains(testing::AnyOf("s_mm", "sliding_distance", "time_s", "friction_work")));
    EXPECT_THAT(columns, testing::Not(Contains("other")));
    EXPECT_NEAR(found.scatter_between, 0.05, 0.005);
    if (threads == 1) first = trace::trace_json({found}, true);
    EXPECT_EQ(trace::trace_json({found}, true), first) << threads << " threads";
  }
  set_threads(0);
}

} // namespace
} // namespace frictab::trace_scale_test
