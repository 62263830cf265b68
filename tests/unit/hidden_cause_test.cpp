// Claims: a cause that is found and not delivered does not hide another. SYNTHETIC campaigns of a
// twin disc: four conditions of the surface, two creepages, and a temperature that follows
// friction.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "calibrate/calibration.h"
#include "core/random.h"
#include "support/gain_campaign.h"
#include "support/trace_text.h"
#include "trace/judge/delivery.h"
#include "trace/trace.h"

namespace frictab::hidden_cause_test {

namespace {

data::Dataset twin_disc(std::uint64_t seed) {
  constexpr double friction[] = {0.06, 0.2, 0.33, 0.48};
  constexpr std::size_t rows = 60, dry = 3;
  Random random(seed);
  data::Dataset data;
  data.columns = {{"sigma_n_MPa", "MPa", {}, {}},
                  {"T_contact_C", "degC", {}, {}},
                  {"tau_R_MPa", "MPa", {}, {}}};
  std::vector<double> conditions, creepages;
  for (std::size_t condition = 0; condition < 4; ++condition)
    for (const double pressure : {900.0, 1500.0})
      for (const double creepage : {1.0, 3.0}) {
        const double mu = friction[condition] * (1 - std::exp(-creepage / 0.6)) *
                          std::pow(pressure / 1200, -0.12) * std::exp(0.03 * random.normal());
        for (std::size_t i = 0; i < rows; ++i) {
          const double p = pressure * (1 + 0.01 * random.normal()), time = double(i);
          const double run_in = condition == dry ? 1 - 0.35 * std::exp(-time / 6) : 1;
          data.columns[0].values.push_back(p);
          data.columns[1].values.push_back(22 +
                                           14 * (1 - std::exp(-(time + 3) / 20)) *
                                               friction[condition] * std::pow(pressure / 1000, 3) +
                                           0.1 * random.normal());
          data.columns[2].values.push_back(p * mu * run_in * (1 + 0.02 * random.normal()));
        }
        conditions.push_back(double(condition));
        creepages.push_back(creepage);
        data.experiments.push_back("t" + std::to_string(10 + conditions.size()));
        data.first_row.push_back(data.columns[0].values.size());
      }
  data.sources = {"twin disc"};
  test::add_setting(data, "condition", conditions, {"leaf", "wet", "sand", "dry"});
  test::add_setting(data, "creep_pct", creepages);
  return data;
}

struct Campaign {
  data::Dataset data, none;
  calibrate::Calibration fitted;
  trace::TraceOptions options;

  explicit Campaign(std::uint64_t seed) : data(twin_disc(seed)), none(data.subset({})) {
    calibrate::ModelOptions models;
    models.use = {"coulomb"};
    calibrate::CalibrationOptions calibration;
    calibration.bootstrap = 100;
    fitted =
        calibrate::calibrate({data, data, models, calibration, calibrate::JudgedBy::leave_one_out});
  }
  trace::TraceInput input() const { return {data, none, fitted.fits.front(), options, 100, 1}; }
};

bool is_in_law(const trace::Trace& t, const std::string& column) {
  return std::any_of(t.effects.begin(), t.effects.end(), [&](const trace::TracedEffect& effect) {
    return effect.columns == std::vector<std::string>{column};
  });
}

} // namespace

TEST(HiddenCause, IsFoundWhereAProductWithAReadingWasFoundFirst) {
  for (const std::uint64_t seed : {13}) {
    const Campaign campaign(seed);
    const trace::TraceInput in = campaign.input();
    const trace::Delivery once = trace::deliver(trace::search_effects(in));
    ASSERT_FALSE(once.against.empty());
    const trace::Trace t = trace::trace(in);
    EXPECT_TRUE(is_in_law(t, "condition") && is_in_law(t, "creep_pct")) << test::trace_text(t);
    EXPECT_LT(t.after.validation.mae_MPa, 0.8 * once.left_out_MPa);
  }
}

TEST(HiddenCause, IsSearchedWithoutTheBarredOnes) {
  const Campaign campaign(1);
  const trace::TraceInput in = campaign.input();
  const trace::Found first = trace::search_effects(in);
  ASSERT_FALSE(first.findings.empty());
  const std::vector<trace::Cause> barred = {first.findings[0].rival.causes.back()};
  for (const trace::Finding& finding : trace::search_effects(in, barred).findings)
    EXPECT_FALSE(finding.rival.causes.back() == barred[0]);
}

} // namespace frictab::hidden_cause_test
