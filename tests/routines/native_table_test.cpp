// Solvers' own tables: the text of each, read by hand, holds the law's coefficient at its places;
// what is held, limited, converted and refused.
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "core/error.h"
#include "core/text.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::native_table_test {

using codegen::ExportRequest;
using codegen::find_exporter;
using table::Table;

namespace {

using testing::HasSubstr;
using Inputs = std::map<std::string, std::string>;

// Nine digits in the text, half of the last one off.
constexpr double nine_digits = 5.1e-9;
const std::vector<std::string> natives = {"abaqus_table", "lsdyna_table", "ansys_table",
                                          "deform_table"};
const std::map<std::string, std::string> files = {{"abaqus_table", "frictab_friction.inp"},
                                                  {"lsdyna_table", "frictab_friction.k"},
                                                  {"ansys_table", "frictab_friction.mac"},
                                                  {"deform_table", "frictab_frcfac.key"}};

// log_coulomb over pressure, psi, speed and temperature, shear limit; tolerance as in the samples.
Table four_axes() {
  Table table = test::four_axis_table();
  table.record.tolerance_MPa = 40;
  return table;
}

std::string text_of(const std::string& target, const Table& table, const Inputs& inputs = {},
                    const codegen::SolverUnits& units = {}, const Inputs& options = {}) {
  return find_exporter(target)->generate({table, units, inputs, options}).at(files.at(target));
}

std::string refusal(const std::string& target, const Table& table, const Inputs& inputs = {},
                    const Inputs& options = {}) {
  return test::refusal([&] { text_of(target, table, inputs, "mm-t-s", options); });
}

// Lines that do not start with the comment, their cells as numbers where they are some.
std::vector<std::vector<std::string>> lines_of(const std::string& text, const std::string& comment,
                                               const std::string& separators) {
  std::vector<std::vector<std::string>> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(comment)) continue;
    for (char& c : line)
      if (separators.find(c) != separators.npos) c = ' ';
    std::istringstream cells(line);
    out.emplace_back();
    for (std::string cell; cells >> cell;)
      out.back().push_back(cell);
  }
  return out;
}

// tau_R of the four-axis table, sigma_f 480 and psi at the middle of their ranges unless given.
double tau(double p, double v, double T, double psi = std::sqrt(20.0), double sigma_f = 480) {
  static const table::TableFunction table(test::four_axis_table());
  const double typical = std::sqrt(240.0) * std::sqrt(960.0);
  const double state[] = {p, psi, v, T, sigma_f == 480 ? typical : sigma_f};
  return table(state);
}
constexpr double limit = 0.8 * 0.5773502691896258 * 480;

TEST(AbaqusTable, LinesHoldTheCoefficientOfTheirPlaceWithTheSlipRateFastest) {
  const auto lines = lines_of(text_of("abaqus_table", four_axes()), "*", ",");
  ASSERT_GT(lines.size(), 20u);
  std::vector<double> before;
  for (const auto& line : lines) {
    ASSERT_EQ(line.size(), 4u);
    const double mu = std::stod(line[0]), v = std::stod(line[1]), p = std::stod(line[2]),
                 T = std::stod(line[3]);
    EXPECT_NEAR(std::min(mu * p, limit), tau(p, v, T), nine_digits * 500);
    if (!before.empty()) {
      EXPECT_TRUE(v > before[0] || (v == 5 && p > before[1]) ||
                  (v == 5 && p == 500 && T > before[2]));
    }
    before = {v, p, T};
  }
  EXPECT_EQ(before, (std::vector<double>{500, 2750, 200}));
}

TEST(AbaqusTable, TaumaxIsTheShearLimitAtTheHeldFlowStress) {
  const std::string text = text_of("abaqus_table", four_axes(), {{"sigma_f_MPa", "constant:600"}});
  EXPECT_THAT(text, HasSubstr("*FRICTION, TAUMAX=277.128129\n"));
  EXPECT_THAT(text, HasSubstr("** held: sigma_f_MPa = 600, given (range 240 .. 960)\n"));
  EXPECT_THAT(text, HasSubstr("** held: psi = 4.47214, typical (range 1 .. 20)\n"));
}

TEST(AbaqusTable, HasNoTaumaxWhereTheFlowStressIsAField) {
  Table table = four_axes();
  table.record.tolerance_MPa = 200;
  const std::string text = text_of("abaqus_table", table, {{"sigma_f_MPa", "field:1"}});
  EXPECT_THAT(text, HasSubstr("*FRICTION, DEPENDENCIES=1\n"));
  EXPECT_THAT(text, testing::Not(HasSubstr("held: sigma_f_MPa")));
  const auto lines = lines_of(text, "*", ",");
  ASSERT_EQ(lines.back().size(), 5u);
  EXPECT_EQ(lines.back()[4], "960");
  EXPECT_NEAR(std::stod(lines[0][0]) * 500, tau(500, 5, 20, std::sqrt(20.0), 240), 1e-6);
}

TEST(AbaqusTable, TakesFieldsInTheirOrderBehindTheTemperature) {
  Table table = four_axes();
  table.record.tolerance_MPa = 300;
  const auto lines = lines_of(
      text_of("abaqus_table", table, {{"psi", "field:2"}, {"sigma_f_MPa", "field:1"}}), "*", ",");
  EXPECT_EQ(lines.back()[4], "960");
  EXPECT_EQ(lines.back()[5], "20");
}

TEST(AbaqusTable, LeavesColumnsBlankOnWhichTheLawDoesNotDepend) {
  const Table table = test::constant_table();
  EXPECT_THAT(text_of("abaqus_table", table), testing::EndsWith("*FRICTION\n 0.08\n"));
}

TEST(AbaqusTable, RefusesFieldsItHasNoColumnFor) {
  const Table table = four_axes();
  EXPECT_THAT(refusal("abaqus_table", table, {{"psi", "field:5"}}),
              HasSubstr("field 5: this table has columns for 4 fields"));
  EXPECT_THAT(refusal("abaqus_table", table, {{"psi", "field:2"}}),
              HasSubstr("counts its fields from 1: 1 of 2 are used"));
  EXPECT_THAT(refusal("abaqus_table", table, {{"psi", "field:1"}, {"sigma_f_MPa", "field:1"}}),
              HasSubstr("two states are field 1"));
}

TEST(LsDynaTable, HasACurveOverPressurePerVelocityInTheOrderOfTheTable) {
  const auto lines =
      lines_of(text_of("lsdyna_table", four_axes(), {{"T_contact_C", "constant:90"}}), "$", "");
  EXPECT_EQ(lines[0][0], "*DEFINE_TABLE");
  std::vector<double> speeds;
  std::size_t at = 2;
  for (; lines[at][0] != "*DEFINE_CURVE"; ++at)
    speeds.push_back(std::stod(lines[at][0]));
  EXPECT_EQ(speeds.front(), 5);
  EXPECT_EQ(speeds.back(), 500);
  for (std::size_t s = 0; s < speeds.size(); ++s) {
    ASSERT_EQ(lines[at][0], "*DEFINE_CURVE");
    EXPECT_EQ(lines[at + 1][0], std::to_string(90001 + s));
    for (at += 2; at < lines.size() && lines[at][0][0] != '*'; ++at)
      EXPECT_NEAR(std::stod(lines[at][1]) * std::stod(lines[at][0]),
                  tau(std::stod(lines[at][0]), speeds[s], 90), nine_digits * 500);
  }
  EXPECT_EQ(at, lines.size());
}

TEST(DeformTable, HasThePressureFastestThenTemperatureThenStretch) {
  const auto lines = lines_of(text_of("deform_table", four_axes()), "*", "");
  ASSERT_EQ(lines[0].size(), 8u);
  EXPECT_EQ(lines[0][3], "2");
  EXPECT_EQ(lines[0][4], "5");
  const auto &p = lines[1], &T = lines[2], &psi = lines[3];
  EXPECT_EQ(std::to_string(p.size()), lines[0][5]);
  EXPECT_EQ(std::to_string(T.size()), lines[0][6]);
  EXPECT_EQ(std::to_string(psi.size()), lines[0][7]);
  ASSERT_EQ(lines.size(), 4 + T.size() * psi.size());
  for (std::size_t e = 0; e < psi.size(); ++e)
    for (std::size_t t = 0; t < T.size(); ++t)
      for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_NEAR(std::stod(lines[4 + e * T.size() + t].at(i)) * std::stod(p[i]),
                    tau(std::stod(p[i]), 50, std::stod(T[t]), std::stod(psi[e])),
                    nine_digits * 500);
}

TEST(DeformTable, WritesTheShearFactorWhereTheJobAsksForIt) {
  const auto lines = lines_of(
      text_of("deform_table", four_axes(), {}, "mm-t-s", {{"deform_friction", "shear"}}), "*", "");
  EXPECT_EQ(lines[0][3], "1");
  const double k = std::sqrt(240.0) * std::sqrt(960.0) / std::sqrt(3.0);
  EXPECT_NEAR(std::stod(lines[4][0]) * k, tau(500, 50, 20, 1), 1e-6);
  EXPECT_LE(std::stod(lines.back().back()), 0.8 + 1e-9) << "m of the shear limit";
}

TEST(DeformTable, NeedsAFlowStressForTheShearFactorOfALawWithoutOne) {
  const Table table = test::constant_table();
  EXPECT_THAT(refusal("deform_table", table, {}, {{"deform_friction", "shear"}}),
              testing::AllOf(HasSubstr("no value to hold it at is known"),
                             HasSubstr("sigma_f_MPa = \"constant:480\"")));
  EXPECT_EQ(refusal("deform_table", table, {{"sigma_f_MPa", "constant:480"}},
                    {{"deform_friction", "shear"}}),
            "accepted");
}

TEST(DeformTable, RefusesTheWordThatOnlyTheRoutineKnows) {
  EXPECT_THAT(refusal("deform_table", four_axes(), {}, {{"deform_friction", "constant"}}),
              HasSubstr("a FRCFAC table holds mu or m, not 'constant'"));
}

TEST(AnsysTable, FieldsStayActiveAndAscendWithThePressureFastest) {
  const auto lines = lines_of(text_of("ansys_table", four_axes()), "!", ",");
  EXPECT_EQ(lines[0], (std::vector<std::string>{"TB", "FRIC", "ft_mat", "ISO"}));
  std::map<std::string, double> now;
  std::size_t values = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i][0] == "TBFIELD") {
      if (lines[i][1] == "NPRES" && std::stod(lines[i][2]) != 500) {
        EXPECT_GT(std::stod(lines[i][2]), now["NPRES"]);
      }
      now[lines[i][1]] = std::stod(lines[i][2]);
    } else if (lines[i][0] == "TBDATA") {
      ++values;
      EXPECT_NEAR(std::min(std::stod(lines[i][2]) * now.at("NPRES"), limit),
                  tau(now.at("NPRES"), now.at("SLRV"), now.at("TEMP")), nine_digits * 500);
    }
  }
  EXPECT_GT(values, 20u);
  EXPECT_EQ(lines.back(), (std::vector<std::string>{"RMODIF", "ft_real", "9", "221.702503"}));
}

TEST(AnsysTable, TakesTheSlidingDistanceAndUserFields) {
  Table table = test::branching_table();
  table.record.tolerance_MPa = 40;
  const std::string text = text_of("ansys_table", table, {{"sigma_f_MPa", "constant:480"}});
  EXPECT_THAT(text, HasSubstr("TBFIELD,SLDI,40\n"));
  EXPECT_THAT(text_of("ansys_table", four_axes(), {{"psi", "field:7"}, {"v_rel_mm_s", "contact"}}),
              HasSubstr("TBFIELD,UF07,20\n"));
}

TEST(NativeTables, HoldStatesAtAValueOnlyWhereOneIsKnown) {
  for (const std::string& target : natives)
    EXPECT_THAT(refusal(target, test::branching_table()),
                testing::AllOf(HasSubstr("export.inputs.sigma_f_MPa"),
                               HasSubstr("no column for sigma_f_MPa"),
                               HasSubstr("sigma_f_MPa = \"constant:480\"")))
        << target;
}

TEST(NativeTables, RecipeAndHeldAgreeWithTheComments) {
  const Table table = four_axes();
  const std::map<std::string, std::vector<std::string>> held = {
      {"abaqus_table", {"psi", "sigma_f_MPa"}},
      {"lsdyna_table", {"T_contact_C", "psi", "sigma_f_MPa"}},
      {"ansys_table", {"psi", "sigma_f_MPa"}},
      {"deform_table", {"sigma_f_MPa", "v_rel_mm_s"}}};
  for (const std::string& target : natives) {
    const ExportRequest request{table, "mm-t-s", {}};
    const codegen::Exporter& exporter = *find_exporter(target);
    const auto recipe = test::parse_json(exporter.generate(request).at("recipe.json"));
    std::vector<std::string> names;
    for (const auto& [name, value] : exporter.fixed_states(request)) {
      names.push_back(name);
      EXPECT_EQ(recipe.at("held").at(name), value);
      EXPECT_THAT(text_of(target, table), HasSubstr("held: " + name + " = "));
    }
    EXPECT_EQ(names, held.at(target)) << target;
    EXPECT_EQ(recipe.at("held").size(), names.size());
    EXPECT_TRUE(recipe.at("grid").at("met"));
    EXPECT_FALSE(exporter.is_routine());
  }
}

// tau_R by the target's driver from this text.
std::vector<double> driven(const std::string& target, const ExportRequest& request,
                           const std::string& text, const test::States& states) {
  const codegen::Exporter& exporter = *find_exporter(target);
  codegen::SourceBundle bundle;
  bundle[files.at(target)] = text;
  std::vector<double> out(states.rows());
  codegen::CompiledTarget(exporter, request, bundle, exporter.variants(request)[0])
      .drive(states.rows(), states.columns(), out);
  return out;
}

TEST(NativeTables, InEveryUnitSystemAreTheSameFriction) {
  const Table table = four_axes();
  const test::States states(table, 5000, 5, 0.1, {{"sigma_f_MPa", 480}});
  for (const std::string& target : natives) {
    const std::string usual = text_of(target, table);
    for (const test::SolverScale& scale : test::all_units()) {
      if (scale.name == "mm-t-s") continue;
      SCOPED_TRACE(target + " " + scale.name);
      const std::string other = text_of(target, table, {}, scale.units);
      EXPECT_NE(usual, other);
      // Nodes have six digits, of 293.15 K others than of 20 degC.
      EXPECT_LE(test::worst_relative(driven(target, {table, "mm-t-s", {}}, usual, states),
                                     driven(target, {table, scale.units, {}}, other, states)),
                scale.units.kelvin() ? 1e-4 : 1e-6);
    }
  }
}

TEST(NativeTables, DriverReadsTheFileAndNothingElse) {
  const Table table = four_axes();
  const ExportRequest request{table, "mm-t-s", {}};
  const test::States states(table, 20000, 5, 0.0, {{"sigma_f_MPa", 480}});
  for (const std::string& target : natives) {
    const std::string text = text_of(target, table);
    const std::vector<double> before = driven(target, request, text, states);
    // The last digit of a coefficient, and a line lost.
    const std::size_t number = text.find("0.", text.find("500", text.rfind("Source: ")));
    std::string changed = text;
    changed[number + 2] = changed[number + 2] == '9' ? '1' : '9';
    EXPECT_TRUE(driven(target, request, changed, states) != before) << target;
    std::string cut = text.substr(0, text.size() / 2);
    cut = cut.substr(0, cut.rfind('\n') + 1);
    EXPECT_THROW(driven(target, request, cut, states), std::runtime_error) << target;
    const std::size_t digit = text.find_first_of("0123456789", text.size() / 2);
    std::string spoilt = text;
    spoilt[digit] = 'x';
    EXPECT_THROW(driven(target, request, spoilt, states), std::runtime_error) << target;
  }
}

TEST(NativeTables, NaNInAColumnGivesNaN) {
  const Table table = four_axes();
  const ExportRequest request{table, "mm-t-s", {}};
  test::States states(table, 4, 5, 0.0, {{"sigma_f_MPa", 480}});
  states.column(0)[1] = std::nan("");
  for (const std::string& target : natives) {
    const std::vector<double> out = driven(target, request, text_of(target, table), states);
    EXPECT_FALSE(std::isnan(out[0])) << target;
    EXPECT_TRUE(std::isnan(out[1])) << target;
  }
}

TEST(NativeTables, SayByHowMuchTheyMissATolerance) {
  Table table = test::four_axis_table(); // rough values: 0.5 MPa needs millions of lines
  table.record.tolerance_MPa = 0.5;
  const codegen::SourceBundle bundle =
      find_exporter("abaqus_table")->generate({table, "mm-t-s", {}});
  const auto recipe = test::parse_json(bundle.at("recipe.json"));
  EXPECT_FALSE(recipe["grid"]["met"]);
  EXPECT_LE(recipe["grid"]["values"].get<int>(), 30000);
  EXPECT_GT(recipe["grid"]["found_MPa"].get<double>(), 0.5);
  EXPECT_THAT(bundle.at("frictab_friction.inp"), HasSubstr("MORE than the"));
}

} // namespace
} // namespace frictab::native_table_test
