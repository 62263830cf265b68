// A flow stress that a routine takes from a hardening curve of strain and temperature.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/flow_curve.h"
#include "core/error.h"
#include "expr/program.h"
#include "support/generated.h"
#include "support/sample_tables.h"
#include "table/interpolation.h"

namespace frictab::flow_curve_test {

using codegen::Exporter;
using codegen::ExportRequest;
using codegen::find_exporter;

namespace {

const char* const curve = "900*(0.002 + strain)**0.21*(1 - 0.0006*(T_contact_C - 20))";
double flow_stress(double strain, double temperature) {
  return 900 * std::pow(0.002 + strain, 0.21) * (1 - 0.0006 * (temperature - 20));
}

std::map<std::string, std::string> inputs(const std::string& formula) {
  return {{"sigma_f_MPa", "curve:" + formula}, {"strain", "field:1"}};
}

// The largest difference from the table over states whose flow stress the curve gives at some
// strain, and how many of the states were not asked.
struct Driven {
  double worst = 0;
  int left_out = 0;
};
Driven driven(const std::string& target, const std::string& variant,
              const std::map<std::string, std::string>& choices) {
  const Exporter& exporter = *find_exporter(target);
  const table::Table table = test::four_axis_table();
  const ExportRequest request{table, "mm-t-s", choices, {}};
  const test::States states(table, 4000, 7, 0.1);
  const std::vector<codegen::BuildVariant> variants = exporter.variants(request);
  const auto one = std::find_if(variants.begin(), variants.end(),
                                [&](const auto& v) { return v.name == variant; });
  const codegen::CompiledTarget built(exporter, request, exporter.generate(request), *one);
  std::vector<double> tau(states.rows(), -1);
  built.drive(states.rows(), states.columns(), tau);
  const table::TableFunction law(table);
  Driven out;
  std::vector<double> x(table.inputs().size());
  for (std::size_t row = 0; row < states.rows(); ++row) {
    for (std::size_t c = 0; c < x.size(); ++c)
      x[c] = states.columns()[c][row];
    // sigma_f_MPa is the last, T_contact_C the one before it.
    const double wanted = x[4], temperature = x[3];
    const bool reached = flow_stress(0, temperature) <= wanted &&
                         wanted <= flow_stress(codegen::most_strain, temperature);
    EXPECT_EQ(tau[row] != -1, reached) << wanted << " MPa at " << temperature << " degC";
    if (tau[row] == -1)
      ++out.left_out;
    else
      out.worst = std::max(out.worst, std::abs(tau[row] - law(x)));
  }
  return out;
}

TEST(FlowCurve, GivesTheLawItsFlowStressAtTheStrainOfTheSimulation) {
  for (const auto& [target, program] : {std::pair{"abaqus_vfric", "gfortran"},
                                        {"abaqus_fric", "gfortran"},
                                        {"calculix_usrmu", "gfortran"},
                                        {"qform_lua", "lua5.4"}}) {
    if (!have_program(program)) continue;
    SCOPED_TRACE(target);
    std::map<std::string, std::string> choices = inputs(curve);
    if (target != std::string("abaqus_vfric") && target != std::string("abaqus_fric"))
      choices.erase("strain");
    const Exporter& exporter = *find_exporter(target);
    const table::Table table = test::four_axis_table();
    const std::string variant = exporter.variants({table, "mm-t-s", choices, {}}).back().name;
    const Driven found = driven(target, variant, choices);
    EXPECT_LT(found.worst, variant == "single" ? 1e-3 : 1e-9);
    EXPECT_GT(found.left_out, 0);
    EXPECT_LT(found.left_out, 2000);
  }
}

// What generate says.
std::string said(const std::string& target, const std::map<std::string, std::string>& choices) {
  const table::Table table = test::four_axis_table();
  return test::refusal([&] { find_exporter(target)->generate({table, "mm-t-s", choices, {}}); });
}

TEST(FlowCurve, SaysWhatIsWrongWithIt) {
  using testing::HasSubstr;
  EXPECT_EQ(said("abaqus_vfric", inputs(curve)), "accepted");
  EXPECT_THAT(
      said("abaqus_vfric", inputs("700*strian")),
      HasSubstr("the curve has 'strian', which is not a state\n  hint: did you mean 'strain'?"));
  EXPECT_THAT(said("abaqus_vfric", inputs("700 - T_contact_C")),
              HasSubstr("the curve does not depend on strain"));
  EXPECT_THAT(said("abaqus_vfric", inputs("700*(strain")),
              HasSubstr("export.inputs.sigma_f_MPa:1:"));
  EXPECT_THAT(said("abaqus_vfric", inputs("1e9*(0.002 + strain)**0.2")),
              HasSubstr("the law was made for 240 .. 960 MPa"));
  EXPECT_THAT(said("marc_ufric", inputs(curve)), HasSubstr("the solver gives this state itself"));
  EXPECT_THAT(said("abaqus_table", inputs(curve)), HasSubstr("is not a source of a state"));
}

TEST(FlowCurve, HasTheRangeOfStrainsOverWhichTheLawWasTested) {
  table::Table table = test::four_axis_table();
  const ExportRequest request{table, "mm-t-s", inputs("200 + 400*strain"), {}};
  const codegen::CurvedRequest curved(request, {});
  const auto range = curved.get().table.range("strain");
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->first, 0.1, 0.025);  // 240 MPa
  EXPECT_NEAR(range->second, 1.9, 0.025); // 960 MPa
}

// mu = 0.08 times the factor, also where a limit follows.
TEST(FrictionZones, ScaleTheLawsValueAheadOfItsLimit) {
  table::Table table = test::constant_table();
  table.combine = minimum(table.combine, expr::Expr(40));
  const std::map<std::string, std::string> choices = {{"zone_factor", "field:2"}};
  const codegen::CurvedRequest zoned({table, "mm-t-s", choices, {}}, {});
  const table::TableFunction tau(zoned.get().table);
  EXPECT_EQ(tau.inputs(), (std::vector<std::string>{"sigma_n_MPa", "zone_factor"}));
  EXPECT_DOUBLE_EQ(tau(std::vector{100.0, 1.0}), 8);
  EXPECT_DOUBLE_EQ(tau(std::vector{100.0, 1.5}), 12);
  EXPECT_DOUBLE_EQ(tau(std::vector{1000.0, 1.5}), 40);
}

TEST(FrictionZones, ReachEveryRoutineThatHasFieldsOrProperties) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const table::Table table = test::history_table();
  for (const auto& [target, source] :
       std::map<std::string, std::string>{{"abaqus_vfric", "field:2"},
                                          {"abaqus_vfriction", "field:1"},
                                          {"abaqus_vfric_coef", "field:1"},
                                          {"abaqus_fric", "field:3"},
                                          {"abaqus_fric_coef", "field:1"},
                                          {"deform_usrbcc", "field:9"},
                                          {"lsdyna_usrfrc", "property"}}) {
    SCOPED_TRACE(target);
    const Exporter& exporter = *find_exporter(target);
    std::map<std::string, std::string> choices = test::sample_inputs(exporter);
    choices["zone_factor"] = source;
    const ExportRequest request{table, "mm-t-s", choices, {}};
    const codegen::CompiledTarget routine(exporter, request, exporter.generate(request),
                                          exporter.variants(request).front());
    // The account takes the factor from the field or the property.
    const auto path = routine.drive_path({});
    ASSERT_TRUE(path);
    EXPECT_TRUE(path->passed());
    // Without one it is 1.
    const test::States states(table, 500, 7, 0.0);
    std::vector<double> answers(states.rows(), -1);
    routine.drive(states.rows(), states.columns(), answers);
    const table::TableFunction law(table);
    std::size_t asked = 0;
    for (std::size_t row = 0; row < states.rows(); ++row) {
      if (answers[row] == -1) continue;
      std::vector<double> x;
      for (const double* column : states.columns())
        x.push_back(column[row]);
      EXPECT_NEAR(answers[row], law(x), 1e-9 * law(x));
      ++asked;
    }
    EXPECT_GT(asked, 20u);
  }
}

TEST(FrictionZones, AreFieldsOrProperties) {
  EXPECT_THAT(said("abaqus_vfric", {{"zone_factor", "constant:0.8"}}),
              testing::HasSubstr("a factor by zones is a field or a property"));
  EXPECT_THAT(said("marc_ufric", {{"zone_factor", "field:1"}}),
              testing::HasSubstr("'field:1' is not a source of a state"));
}

} // namespace

} // namespace frictab::flow_curve_test
