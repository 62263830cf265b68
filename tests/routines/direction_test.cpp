// A law that takes the direction of sliding: each routine whose solver gives slips as vectors
// computes the angle from them, against the account of its target; the others say that they lack
// it.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/sliding_direction.h"
#include "core/random.h"
#include "routines/fric_case.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::direction_test {

using codegen::Exporter;
using codegen::ExportRequest;
using codegen::find_exporter;
using codegen::PathFigure;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace {

table::TableAxis axis(const char* name, const char* unit, std::vector<double> nodes) {
  table::TableAxis out;
  out.name = name;
  out.unit = unit;
  out.long_name = name;
  out.nodes = std::move(nodes);
  return out;
}

// Rough in the angle: swapped components or another sign show.
table::Table table_of_angles(const std::vector<double>& angles) {
  table::Table table;
  table.model = "lay";
  table.axes = {axis("direction_deg", "deg", angles), axis("v_rel_mm_s", "mm/s", {5, 100, 500})};
  Random random(5);
  for (std::size_t i = 0; i < 3 * angles.size(); ++i)
    table.value.push_back(random.uniform(0.03, 0.3));
  table.combine = expr::Expr::symbol("value") * expr::Expr::symbol("sigma_n_MPa");
  table.record.inputs["sigma_n_MPa"] = {.low = 100, .high = 1000};
  return table;
}

const table::Table half_turn = table_of_angles({10, 40, 95, 130, 170});
const table::Table whole_turn = table_of_angles({-165, -60, 20, 45, 160});

double tau_of(double angle, double speed, double pressure) {
  const std::map<std::string, double> values = {
      {"direction_deg", angle}, {"v_rel_mm_s", speed}, {"sigma_n_MPa", pressure}};
  std::vector<double> state;
  for (const std::string& name : half_turn.inputs())
    state.push_back(values.at(name));
  return table::TableFunction(half_turn)(state);
}

struct Target {
  std::string name;
  bool in_space = false; // slips in global axes
  std::map<std::string, std::string> options = {};
};

const std::vector<Target> targets = {{"abaqus_vfric", true},
                                     {"abaqus_vfriction", true},
                                     {"abaqus_fric"},
                                     {"abaqus_fric_coef"},
                                     {"marc_ufric", false, {{"marc_dimension", "3d"}}},
                                     {"lsdyna_usrfrc", true},
                                     {"calculix_usrmu", true}};

ExportRequest request_of(const Target& target, const table::Table& table,
                         const codegen::SolverUnits& units = {}) {
  ExportRequest request = {table, units, {}};
  if (target.in_space) request.inputs = {{"direction_deg", "slip:1,2,-2"}};
  request.options = target.options;
  return request;
}

// Numbers that are not those of the account.
std::vector<std::string> wrong(const Exporter& exporter, const ExportRequest& request,
                               const codegen::SourceBundle& bundle, codegen::BuildVariant variant) {
  test::add_flags(variant, test::no_warnings);
  test::add_flags(variant, {"-fcheck=all"});
  variant.command.push_back("-O0"); // numbers are the same without contraction
  const codegen::CompiledTarget routine(exporter, request, bundle, variant);
  const auto path = routine.drive_path({.seed = 7, .increments = 240});
  if (!path) return {"not driven"};
  std::vector<std::string> out;
  for (const PathFigure& figure : path->figures)
    if (figure.of_allowed > 1)
      out.push_back(
          fmt::format("{}: {:.3g} of what is allowed", figure.quantity, figure.of_allowed));
  return out;
}

class SlowDirectionOf : public testing::TestWithParam<Target> {
protected:
  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  }
  const Exporter& exporter = *find_exporter(GetParam().name);
};

TEST_P(SlowDirectionOf, IsThatOfTheSlipOverIncrements) {
  for (const auto& [table, units] : {std::pair{&half_turn, "mm-t-s"}, {&whole_turn, "m-kg-s"}}) {
    const ExportRequest request = request_of(GetParam(), *table, units);
    const codegen::SourceBundle bundle = exporter.generate(request);
    for (const codegen::BuildVariant& variant : exporter.variants(request))
      EXPECT_THAT(wrong(exporter, request, bundle, variant), IsEmpty()) << variant.name << units;
  }
}

TEST_P(SlowDirectionOf, IsThatOfTheRowsThatASolverCanGive) {
  for (const table::Table* table : {&half_turn, &whole_turn}) {
    const ExportRequest request = request_of(GetParam(), *table);
    const test::States states(*table, 2000, 11);
    std::vector<double> tau(states.rows(), -1), law = test::expected(*table, states);
    const codegen::CompiledTarget routine(exporter, request, exporter.generate(request),
                                          exporter.variants(request).front());
    routine.drive(tau.size(), states.columns(), tau);
    std::size_t asked = 0;
    for (std::size_t i = 0; i < tau.size(); ++i) {
      if (tau[i] == -1) continue; // beyond the turn
      ++asked;
      ASSERT_NEAR(tau[i], law[i], 1e-10 * law[i]) << "row " << i;
    }
    EXPECT_GT(asked, tau.size() / 2);
  }
}

// Both are seen, since friction at an angle differs from that at its negative and its complement.
TEST_P(SlowDirectionOf, IsNoticedIfItsComponentsAreSwappedOrItsSignIsAnother) {
  const ExportRequest request = request_of(GetParam(), half_turn);
  const std::string right = "atan2(across, along)";
  for (const char* edit : {"atan2(along, across)", "atan2(-across, along)"}) {
    codegen::SourceBundle bundle = exporter.generate(request);
    bool edited = false;
    for (auto& [file, text] : bundle) {
      const std::size_t at = text.find(right);
      if (at == std::string::npos) continue;
      text.replace(at, right.size(), edit);
      edited = true;
    }
    ASSERT_TRUE(edited);
    EXPECT_THAT(wrong(exporter, request, bundle, exporter.variants(request).front()),
                Not(IsEmpty()))
        << edit;
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, SlowDirectionOf, testing::ValuesIn(targets),
                         [](const auto& given) { return given.param.name; });

class DirectionInFric : public test::FricCase {};

TEST_F(DirectionInFric, CountsFromTheFirstLocalDirectionTowardsTheSecond) {
  void* const fric = routine("half turn", {half_turn, "mm-t-s", {}});
  const auto stress = [&](double angle) {
    calls::FricCall c = call();
    c.properties = {90, test::critical};
    move(c, 100, angle);
    run(c, fric);
    return size(c.tau);
  };
  EXPECT_CLOSE(stress(60), tau_of(60, 100, 1000), 1e-12);
  EXPECT_CLOSE(stress(120), tau_of(120, 100, 1000), 1e-12);
  EXPECT_CLOSE(stress(-60), tau_of(120, 100, 1000), 1e-12) << "backwards along the same line";
  EXPECT_CLOSE(stress(-120), tau_of(60, 100, 1000), 1e-12);
}

// Whole sources of the target.
std::string text_of(const codegen::SourceBundle& bundle) {
  std::string all;
  for (const auto& [file, text] : bundle)
    all += text;
  return all;
}

TEST(Direction, IsComputedWhereSlipsHaveTwoComponentsAndSaidToBeLackingElsewhere) {
  for (const Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.is_routine() || exporter.name == "c" || exporter.name == "fortran" ||
        exporter.name == "toy")
      continue;
    const bool turns = std::any_of(targets.begin(), targets.end(), [&](const Target& target) {
      return target.name == exporter.name && target.options.empty();
    });
    const std::string text = text_of(exporter.generate({half_turn, "mm-t-s", {}}));
    EXPECT_EQ(text.find("function ftfold") != std::string::npos, turns) << exporter.name;
    EXPECT_EQ(text.find("for all slips: their direction is not given") != std::string::npos, !turns)
        << exporter.name;
    EXPECT_THAT(text_of(exporter.generate({test::history_table(), "mm-t-s", {}})),
                Not(HasSubstr("ftfold")));
  }
}

TEST(Direction, IsExplainedWithItsReferenceAndItsTurn) {
  EXPECT_THAT(find_exporter("abaqus_fric")->generate({half_turn, "mm-t-s", {}}).at("README.md"),
              HasSubstr("angle of the slip, in degrees, from local direction 1 towards 2; from 0 "
                        "to 180, 0 at rest; property 1 where NFDIR = 1"));
  const ExportRequest across = {half_turn, "mm-t-s", {{"direction_deg", "slip:0,3,4"}}};
  EXPECT_THAT(find_exporter("lsdyna_usrfrc")->generate(across).at("README.md"),
              HasSubstr("from the direction (0, 0.6, 0.8) of the model, laid on the surface"));
}

TEST(Direction, IsWhatTheJobWants) {
  const auto vfric = [](const char* choice) {
    return text_of(find_exporter("abaqus_vfric")
                       ->generate({half_turn, "mm-t-s", {{"direction_deg", choice}}}));
  };
  EXPECT_THAT(vfric("constant:45"), Not(HasSubstr("ftfold")));
  EXPECT_THAT(vfric("field:1"), Not(HasSubstr("ftfold")));
  EXPECT_EQ(vfric("slip"), vfric("slip:1,0,0"));
  const auto refusal = [](const char* target, const char* choice) {
    const ExportRequest request = {half_turn, "mm-t-s", {{"direction_deg", choice}}};
    return test::refusal([&] { find_exporter(target)->generate(request); });
  };
  for (const char* choice : {"slip:0,0,0", "slip:1,0", "slip:a,b,c", "slip:1,0,0,0", "slip:"})
    EXPECT_THAT(refusal("abaqus_vfric", choice),
                HasSubstr("is not a direction in the model's axes\n  hint: slip:0,1,0"))
        << choice;
  EXPECT_THAT(refusal("abaqus_fric", "slip:0,1,0"), HasSubstr("is not a source of a state"));
  EXPECT_THAT(refusal("abaqus_vfric_coef", "slip"), HasSubstr("is not a source of a state"));
}

TEST(Direction, LivesInTheTurnAroundTheTestedRange) {
  const auto turn = [](std::vector<double> angles) {
    return codegen::turn_of(table_of_angles(std::move(angles)));
  };
  EXPECT_EQ(turn({0, 30, 60, 90, 180}).low, 0);
  EXPECT_EQ(turn({0, 30, 45, 60, 90}).low, -45);
  EXPECT_EQ(turn({0, 30, 45, 60, 90}).high(), 135);
  EXPECT_EQ(turn({0, 30, 45, 60, 270}).period, 360);
  EXPECT_EQ(turn({0, 30, 45, 60, 270}).low, -45);
}

} // namespace
} // namespace frictab::direction_test
