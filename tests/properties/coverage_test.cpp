// 95 % intervals cover the truth as often as they say, with the experiment as the statistical unit.
#include <cmath>

#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "calibrate/law_problem.h"
#include "core/parallel.h"
#include "core/random.h"
#include "support/sample_data.h"

namespace frictab::coverage_test {

using calibrate::Loss;

namespace {

constexpr std::size_t replicates = 200;
constexpr std::size_t experiments = 30;
constexpr double t_975_of_29 = 2.0452; // Student's t with experiments - 1 degrees of freedom

// A campaign as tribometers give it: every experiment has its own states and a gain of its own
// (coating, residue), and the noise along it is AR(1) with a memory of ten rows.
data::Dataset campaign(const models::Model& truth, std::uint64_t replicate) {
  data::Dataset data =
      test::sample_data(truth, {.experiments = experiments, .rows = 40, .seed = 1000 + replicate});
  std::vector<double> tau = calibrate::predict(truth, data);
  Random random(replicate, 0x636f766572);
  for (std::size_t e = 0; e < experiments; ++e) {
    const double gain = 1 + 0.08 * random.normal();
    double drift = random.normal();
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      drift = 0.9 * drift + std::sqrt(1 - 0.81) * random.normal();
      tau[i] = tau[i] * gain + 4 * drift + 3 * random.normal();
    }
  }
  test::column(data, "tau_R_MPa").values = tau;
  return data;
}

class SlowCoverage : public testing::TestWithParam<std::tuple<const char*, Loss>> {};

TEST_P(SlowCoverage, Of95PercentIntervalsIs90To98PercentIn200Campaigns) {
  const Loss loss = std::get<Loss>(GetParam());
  const models::Model truth =
      test::plausible_model(*models::find_law(std::get<const char*>(GetParam())));
  const std::size_t size = truth.parameters.size();
  std::vector<char> covered(replicates * size, 0);
  parallel_for(replicates, [&](std::size_t r) {
    const data::Dataset data = campaign(truth, r);
    const calibrate::LawProblem problem(*truth.law, {}, data);
    calibrate::LawFit fit = problem.fit(loss, 10);
    problem.add_uncertainty(fit, loss, 10, data);
    for (std::size_t p = 0; p < size; ++p)
      covered[r * size + p] = std::abs(fit.result.parameters[p] - truth.parameters[p]) <=
                              t_975_of_29 * fit.uncertainty.std_error[p];
  });
  for (std::size_t p = 0; p < size; ++p) {
    std::size_t count = 0;
    for (std::size_t r = 0; r < replicates; ++r)
      count += covered[r * size + p] != 0;
    const double percent = 100.0 * static_cast<double>(count) / replicates;
    EXPECT_GE(percent, 90) << truth.law->parameters[p].name;
    EXPECT_LE(percent, 98) << truth.law->parameters[p].name;
    RecordProperty(truth.law->parameters[p].name, std::to_string(percent));
  }
}

INSTANTIATE_TEST_SUITE_P(Sandwich, SlowCoverage,
                         testing::Combine(testing::Values("coulomb", "orowan", "log_coulomb"),
                                          testing::Values(Loss::l2, Loss::l1)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) == Loss::l2 ? "_L2" : "_L1");
                         });

} // namespace
} // namespace frictab::coverage_test
