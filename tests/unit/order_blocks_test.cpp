// Claims: what changes in blocks along the order of tests is named. SYNTHETIC campaigns.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "core/random.h"
#include "support/gain_campaign.h"
#include "support/trace_text.h"
#include "trace/trace.h"

namespace frictab::order_blocks_test {

using data::Dataset;
using test::trace_text;
using testing::HasSubstr;
using testing::Not;
using trace::Trace;

namespace {

// Tests in the order in which they were made, each with the factor of its material and of the day.
// `days`: tests are dated only, those of a material on one day.
Trace traced(std::size_t tests, std::size_t materials, const std::vector<double>& factors,
             double drift, std::uint64_t seed, bool days = false) {
  test::GainCampaign c = test::GainCampaign::spread(tests, seed);
  c.a = c.b = c.g = 0; // the law is right
  Random random(seed, 5);
  std::vector<double> order, material;
  for (std::size_t e = 0; e < tests; ++e) {
    material.push_back(double(e * materials / tests));
    order.push_back(days ? material.back() : double(e + 1));
    const double time = double(e) / double(tests - 1) - 0.5;
    c.gain.push_back(factors[std::size_t(material.back())] * std::exp(drift * time) *
                     std::exp(0.03 * random.normal()));
  }
  Dataset data = c.data();
  if (days)
    test::add_setting(data, "date", order, {"2026-03-02", "2026-03-03", "2026-03-04"});
  else
    test::add_setting(data, "run_order", order);
  std::vector<std::string> levels = {"PA66", "POM", "PTFE", "steel"};
  levels.resize(materials);
  test::add_setting(data, "material", material, levels);
  const Dataset none = data.subset({});
  calibrate::ModelOptions models;
  models.use = {"coulomb"};
  calibrate::CalibrationOptions calibration;
  calibration.bootstrap = 100;
  const calibrate::Calibration fitted =
      calibrate::calibrate({data, data, models, calibration, calibrate::JudgedBy::leave_one_out});
  return trace::trace({data, none, fitted.fits.front(), {}, 100, 1});
}

bool names_material(const Trace& t) {
  return !t.effects.empty() && t.effects[0].columns == std::vector<std::string>{"material"};
}

bool leads_to_material(const Trace& t) {
  return std::any_of(t.leads.begin(), t.leads.end(), [](const trace::Lead& lead) {
    return lead.columns == std::vector<std::string>{"material"} && lead.significant;
  });
}

// Three materials are changed twice; that the two largest of 14 steps are just there has a
// probability of 1 in 91.
TEST(OrderBlocks, MaterialsAmongWhichFrictionStepsAreAnEffect) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Trace t = traced(15, 3, {0.4, 1, 1.6}, 0, seed);
    EXPECT_TRUE(names_material(t)) << trace_text(t);
  }
}

// One change cannot be distinguished from anything else that changed on that day.
TEST(OrderBlocks, TwoMaterialsOneAfterTheOtherAreALead) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Trace t = traced(14, 2, {1, 1.4}, 0, seed);
    EXPECT_TRUE(t.effects.empty()) << trace_text(t);
    EXPECT_TRUE(leads_to_material(t)) << trace_text(t);
    EXPECT_THAT(words::trace_in_short(t), HasSubstr("material"));
    EXPECT_THAT(trace_text(t), HasSubstr("friction against PA66: POM +"));
    EXPECT_EQ(t.order.step, "t06 and t07");
    EXPECT_NEAR(t.order.change, 0.4, 0.08);
    EXPECT_THAT(words::trace_in_short(t), HasSubstr("% between tests t06 and t07 (run_order)"));
  }
}

TEST(OrderBlocks, AMaterialOnEachDayIsALead) {
  const Trace t = traced(15, 3, {0.4, 1, 1.6}, 0, 1, true);
  EXPECT_TRUE(t.effects.empty()) << trace_text(t);
  EXPECT_TRUE(leads_to_material(t)) << trace_text(t);
}

TEST(OrderBlocks, ADriftThroughThemIsNoEffectOfMaterials) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
    for (const std::size_t materials : {2, 4}) {
      const Trace t = traced(16, materials, {1, 1, 1, 1}, 0.5, seed);
      EXPECT_TRUE(t.effects.empty()) << trace_text(t);
      EXPECT_EQ(t.order.step, "");
      EXPECT_NEAR(t.order.change, std::expm1(0.5), 0.15);
    }
}

} // namespace
} // namespace frictab::order_blocks_test
