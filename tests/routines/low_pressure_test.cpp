// Below every contact normal stress that was tested, where most contact points of a forming process
// begin: every target follows the law there, down to no pressure.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/coefficient.h"
#include "codegen/compile.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "table/direct.h"
#include "verify/verify.h"

namespace frictab::low_pressure_test {

using models::AssembledLaw;
using models::Model;
using table::Outside;
using table::Table;
using verify::DriftRecord;

namespace {

constexpr double tolerance_MPa = 0.5;

struct Case {
  Model model;
  data::Dataset data;
  Table table, direct;

  explicit Case(const char* law, const table::TableOptions& options = {})
      : model(test::plausible_model(*models::find_law(law))), data(test::sample_data(model)),
        table(table::build_table(AssembledLaw(model),
                                 table::state_ranges(AssembledLaw(model), data, options),
                                 options)) {
    table.record.tolerance_MPa = tolerance_MPa;
    direct = table::direct_form(AssembledLaw(model), table);
  }

  codegen::ExportRequest request(const codegen::Exporter& exporter) const {
    return {exporter.is_routine() ? table : direct, "mm-t-s", test::sample_inputs(exporter)};
  }

  std::vector<DriftRecord> verified(const codegen::Exporter& exporter) const {
    return verify::verify({AssembledLaw(model), table, "table", &data, tolerance_MPa, 2000},
                          {{&exporter, request(exporter), exporter.generate(request(exporter))}});
  }
};

const table::TableAxis* pressure_of(const Table& table) {
  return table::find_axis(table, "sigma_n_MPa");
}

TEST(LowPressure, IsTheLawsByDefaultAndTheJobsWhereItSaysSo) {
  const Case usual("wanheim_bay");
  ASSERT_TRUE(pressure_of(usual.table));
  EXPECT_EQ(pressure_of(usual.table)->below, Outside::law);
  EXPECT_EQ(pressure_of(usual.table)->above, Outside::clamp);
  for (const table::TableAxis& axis : usual.table.axes)
    EXPECT_EQ(axis.below, axis.name == "sigma_n_MPa" ? Outside::law : Outside::clamp) << axis.name;
  table::TableOptions nodes, clamped;
  nodes.axes["sigma_n_MPa"].nodes = 30; // says nothing about what lies beyond
  EXPECT_EQ(pressure_of(Case("wanheim_bay", nodes).table)->below, Outside::law);
  clamped.axes["sigma_n_MPa"].outside = {"clamp"};
  EXPECT_EQ(pressure_of(Case("wanheim_bay", clamped).table)->below, Outside::clamp);
}

TEST(LowPressure, ShearStressFallsToNothingWithThePressure) {
  const Case c("wanheim_bay");
  const table::TableFunction tau(c.table);
  const double flow = 480;
  std::vector<double> state;
  for (const std::string& name : c.table.inputs())
    state.push_back(name == "sigma_f_MPa" ? flow : 0);
  const auto at = [&](double p) {
    for (std::size_t i = 0; i < state.size(); ++i)
      if (c.table.inputs()[i] == "sigma_n_MPa") state[i] = p;
    return tau(state);
  };
  EXPECT_EQ(at(0), 0);
  EXPECT_NEAR(at(0.001) / 0.001, at(50) / 50, 1e-9) << "the law is a line there";
}

TEST(LowPressure, VerifyHasItsOwnFigureAndFailsWhereTheLawIsNotFollowed) {
  const Case c("wanheim_bay");
  const AssembledLaw law(c.model);
  const auto record = [&](const Table& table) {
    return verify::verify({law, table, "table", &c.data, tolerance_MPa, 2000}, {})[0];
  };
  const DriftRecord good = record(c.table);
  ASSERT_TRUE(good.below);
  EXPECT_EQ(good.below->outside, "law");
  EXPECT_NEAR(good.below->low_MPa, 0.1 * good.below->high_MPa, 1e-9);
  EXPECT_EQ(good.below->high_MPa, pressure_of(c.table)->nodes.front());
  EXPECT_GT(good.below->n_points, 1000U);
  EXPECT_LT(good.below->max_abs_MPa, 1e-9);
  EXPECT_TRUE(good.passed);

  Table wrong = c.table;
  wrong.extension = *wrong.extension + expr::Expr(1.0);
  EXPECT_GT(record(wrong).below->max_abs_MPa, 0.9);
  EXPECT_FALSE(record(wrong).passed);

  Table clamped = c.table;
  for (table::TableAxis& axis : clamped.axes)
    axis.below = Outside::clamp;
  EXPECT_GT(record(clamped).below->max_abs_MPa, 5);
  EXPECT_EQ(record(clamped).below->outside, "clamp");
  EXPECT_TRUE(record(clamped).passed) << "as the job asked";

  verify::Verification all;
  all.records = {good};
  const auto again = verify::parse_verification(verify::verification_json(all), "verify.json");
  EXPECT_EQ(again.records[0].below->max_abs_MPa, good.below->max_abs_MPa);
  EXPECT_EQ(again.records[0].below->n_points, good.below->n_points);
}

class LongLowPressure : public testing::TestWithParam<const char*> {};

TEST_P(LongLowPressure, EveryTargetFollowsTheLawThere) {
  table::TableOptions options; // parameters without a covariance would be followed nowhere
  options.axes["sigma_n_MPa"].outside = {"law"};
  const Case c(GetParam(), options);
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    const std::vector<DriftRecord> records = c.verified(exporter);
    for (const DriftRecord& record : records) {
      if (!record.ran) continue; // its compiler is missing; the others' own tests skip by name
      ASSERT_TRUE(record.below) << record.subject;
      // A closed form is as far off there as its files state.
      const double most = exporter.is_routine() ? 1e-3 : tolerance_MPa;
      EXPECT_LE(record.below->max_abs_MPa, most + 1.02 * record.stated_loss_MPa.value_or(0))
          << record.subject;
      EXPECT_TRUE(record.passed) << record.subject;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, LongLowPressure,
                         testing::Values("orowan", "wanheim_bay", "log_coulomb"),
                         [](const auto& law) { return std::string(law.param); });

// A law whose stress does not fall with the pressure asks for any coefficient.
TEST(SlowLargestCoefficient, IsWhatEverySolverGetsOfALawThatAsksForMore) {
  const Case c("shear");
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    const codegen::ExportRequest request = c.request(exporter);
    if (!exporter.gives_mu(request)) continue;
    for (const auto& [file, text] : exporter.generate(request))
      if (file.ends_with(".f")) {
        EXPECT_THAT(text, testing::AnyOf(testing::HasSubstr("t most 10.0D0"),
                                         testing::HasSubstr("t most 10.")))
            << exporter.name;
      }
    for (const DriftRecord& record : c.verified(exporter))
      EXPECT_TRUE(!record.ran || record.passed) << record.subject;
  }
}

} // namespace

} // namespace frictab::low_pressure_test
