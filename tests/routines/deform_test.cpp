// USRBCC called as DEFORM-2D calls it, its states in COMMON blocks, with bounds checked and
// floating point traps on; and FTUPD, which keeps the histories of nodes. No test in threads:
// DEFORM itself cannot call it so, because the COMMON blocks hold one edge's state.
#include <algorithm>
#include <cmath>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "routines/deform_case.h"
#include "routines/standard_case.h"
#include "support/calls/usrbcc.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::deform_test {

using codegen::ExportRequest;
using codegen::Library;
using table::Table;
using table::TableFunction;

namespace {

using calls::Ufhcom;
using calls::Ufhcom2;
using calls::UsrbccCall;
using testing::HasSubstr;
using namespace test;
using Words = std::map<std::string, std::string>;

constexpr double bound = 1e-13; // the order of operations only
const double k = flow / std::sqrt(3.0);

const codegen::Exporter& deform() {
  return *codegen::find_exporter("deform_usrbcc");
}

ExportRequest request(const Table& table, const std::string& friction = "coulomb",
                      const Words& inputs = {}, const codegen::SolverUnits& units = {}) {
  ExportRequest out{table, units, inputs};
  out.options = {{"deform_friction", friction}};
  return out;
}

// A compiled routine and its COMMON blocks, set to 1000 MPa, 50 mm/s, psi, flow stress; TEMC is
// 100 degC in `call`.
struct SlowDeform : test::NeedsGfortran {
  void use(const std::string& key, const ExportRequest& asked) {
    library = test::compiled(key, deform(), asked, "double", test::strict_declared);
    contact = library->find<Ufhcom>("ufhcom_");
    surface = library->find<Ufhcom2>("ufhcom2_");
    *contact = {20, 20, 50, 1000};
    *surface = {psi, flow, 1};
    call = {};
    call.temperature[0] = 90, call.temperature[1] = 110;
  }
  void use_four_axes(const std::string& friction = "coulomb") {
    use("four " + friction, request(four_axis(), friction));
  }
  double run() {
    const test::FloatTraps traps;
    call.run(Library::address(library->handle(), "usrbcc_"));
    return call.variable;
  }
  static double tau(double pressure, double speed = 50, double temperature = 100,
                    double expansion = psi) {
    return four_axis_tau(pressure, speed, temperature, expansion);
  }

  const Library* library = nullptr;
  Ufhcom* contact = nullptr;
  Ufhcom2* surface = nullptr;
  UsrbccCall call;
};

using LongDeform = SlowDeform;

TEST_F(LongDeform, AgreesWithFrictabForEveryKindOfArgumentAndFrictionType) {
  std::vector<std::pair<const char*, codegen::SolverUnits>> choices = {{"coulomb", {}},
                                                                       {"shear", {}}};
  for (const test::SolverScale& scale : test::every_system())
    choices.emplace_back("constant", scale.units);
  for (const test::NamedTable& sample : test::sample_tables())
    for (const auto& [friction, units] : choices) {
      if (!test::has_every_kind_of_argument(sample)) continue;
      SCOPED_TRACE(sample.name + " " + units.text() + " " + friction);
      const ExportRequest asked = request(sample.table, friction, {}, units);
      EXPECT_LE(test::worst_driven(deform(), asked, "double", test::strict_declared), bound);
    }
}

TEST_F(SlowDeform, ActsOnlyForTheFrictionOfADeformation) {
  use_four_axes();
  for (const int mode : {0, 1, 2, 3})
    for (const int type : {0, 1, 2, 3, 4}) {
      call.mode = mode, call.type = type, call.variable = 777;
      const bool friction = mode == 1 && type == 2;
      EXPECT_EQ(run() == 777, !friction) << mode << " " << type;
    }
}

TEST_F(SlowDeform, GivesMuShearFactorOrStressAsTheJobSays) {
  use_four_axes("coulomb");
  EXPECT_CLOSE(run(), tau(1000) / 1000, bound);
  use_four_axes("shear");
  EXPECT_CLOSE(run(), tau(1000) / k, bound);
  use_four_axes("constant");
  EXPECT_CLOSE(run(), tau(1000), bound);
}

TEST_F(SlowDeform, TakesTwoAndThreeFreedomsPerNodeAndEveryModelNumber) {
  use_four_axes();
  for (const int freedoms : {2, 3}) {
    call.freedoms = freedoms, call.model = freedoms;
    EXPECT_CLOSE(run(), tau(1000) / 1000, bound);
  }
}

TEST_F(SlowDeform, TakesStatesFromTheCOMMONBlocksAndNotTheirSigns) {
  use_four_axes();
  contact->sliding_speed = -20, contact->pressure = -800, surface->stretch = 5;
  EXPECT_CLOSE(run(), tau(800, 20, 100, 5) / 800, bound);
}

TEST_F(SlowDeform, GivesMuOfTheLeastPressureInsteadOf0Over0AndNoOtherFrictionWithoutPressure) {
  for (const double pressure : {0.0, 1e-300, 1e-3}) {
    use_four_axes("coulomb");
    contact->pressure = pressure;
    EXPECT_CLOSE(run(), tau(1e-3) / 1e-3, bound) << pressure;
  }
  for (const char* friction : {"shear", "constant"}) {
    use_four_axes(friction);
    contact->pressure = 0;
    EXPECT_EQ(run(), 0) << friction;
  }
}

TEST_F(SlowDeform, GivesNoShearFactorWithoutFlowStress) {
  use_four_axes("shear");
  surface->effective_stress = 0;
  EXPECT_EQ(run(), 0);
}

TEST_F(SlowDeform, GivesNaNForNaNInAnyStateItUses) {
  for (const char* friction : {"coulomb", "shear", "constant"})
    for (int i = 0; i < 6; ++i) {
      use_four_axes(friction);
      double* const states[] = {&contact->pressure,   &contact->sliding_speed,
                                &surface->stretch,    &surface->effective_stress,
                                &call.temperature[0], &call.temperature[1]};
      *states[i] = nan;
      EXPECT_TRUE(std::isnan(run())) << friction << " " << i;
    }
}

TEST_F(SlowDeform, TakesInfinitiesAsFarOutsideTheTable) {
  use_four_axes("constant");
  contact->pressure = inf;
  EXPECT_CLOSE(run(), 0.8 * k, bound);
  use_four_axes("coulomb");
  contact->pressure = inf;
  EXPECT_NEAR(run(), 0, 1e-20) << "the shear limit over any pressure";
  use_four_axes();
  contact->sliding_speed = inf;
  EXPECT_CLOSE(run(), tau(1000, 1e9) / 1000, bound);
  use_four_axes();
  call.temperature[1] = -inf;
  EXPECT_CLOSE(run(), tau(1000, 50, -1e9) / 1000, bound);
}

TEST_F(SlowDeform, UsesTheNearestEdgeOutsideEachSideOfEachAxis) {
  const double states[][3] = {{100, 50, 100},    {4000, 50, 100}, {1000, 1, 100},
                              {1000, 2000, 100}, {1000, 50, -40}, {1000, 50, 900}};
  for (const auto& [p, v, T] : states) {
    use_four_axes();
    contact->pressure = p, contact->sliding_speed = v;
    call.temperature[0] = call.temperature[1] = T;
    EXPECT_CLOSE(run(), tau(p, v, T) / p, bound);
  }
}

TEST_F(SlowDeform, TakesTheMeanOfBothNodesHistoriesAnd0WithoutThem) {
  static const Table table = test::branching_table();
  static const TableFunction function(table);
  use("branching", request(table));
  call.first = 3, call.second = 1;
  call.user_variables = 4;
  call.nodal = {8, 0, 0, 0, nan, nan, nan, nan, 14, 0, 0, 0}; // node 2 is not of this edge
  contact->sliding_speed = 20;
  const double at_11[] = {1000, 20, 11, flow}, at_0[] = {1000, 20, 0, flow};
  EXPECT_CLOSE(run(), function(at_11) / 1000, bound);
  call.user_variables = 0;
  EXPECT_CLOSE(run(), function(at_0) / 1000, bound);
  call.user_variables = 4;
  call.nodal[8] = nan;
  EXPECT_TRUE(std::isnan(run()));
}

TEST_F(SlowDeform, TakesStatesFromUserVariablesOfNodesAndConstantsAsTheJobSays) {
  use("fields",
      request(four_axis(), "shear",
              {{"psi", "field:2"}, {"sigma_f_MPa", "field:1"}, {"T_contact_C", "constant:60"}},
              "m-kg-s"));
  contact->pressure = 1000e6, contact->sliding_speed = 0.05;
  call.user_variables = 2;
  call.nodal = {200e6, 3, 400e6, 5};
  surface->effective_stress = nan; // not asked for
  EXPECT_CLOSE(run(), four_axis_tau(1000, 50, 60, 4, 300) / (300 / std::sqrt(3.0)), bound)
      << "k of the law's own flow stress";
  call.user_variables = 1; // field 2 is not there: the middle of the axis
  call.nodal = {200e6, 400e6};
  EXPECT_CLOSE(run(), four_axis_tau(1000, 50, 60, std::sqrt(20.0), 300) / (300 / std::sqrt(3.0)),
               bound);
}

TEST_F(SlowDeform, IsNotAskedForAPeakBelowThePresentPressure) {
  const Table table = test::history_table();
  const ExportRequest asked = request(table);
  const double p[] = {700, 700, 700}, work[] = {200, 200, 200}, peak[] = {900, 600, nan};
  const std::vector<const double*> columns = {p, work, peak};
  std::vector<double> result(3, -1);
  codegen::CompiledTarget(deform(), asked, deform().generate(asked), deform().variants(asked)[0])
      .drive(3, columns, result);
  const double state[] = {700, 200, 900};
  EXPECT_CLOSE(result[0], TableFunction(table)(state), bound);
  EXPECT_EQ(result[1], -1);
  EXPECT_TRUE(std::isnan(result[2]));
}

TEST_F(SlowDeform, RefusesAFieldThatHoldsAHistory) {
  const Table table = test::traced_table();
  const auto refusal = [&](const std::string& field) {
    return test::refusal([&] { deform().generate(request(table, "coulomb", {{"psi", field}})); });
  };
  EXPECT_THAT(refusal("field:3"), HasSubstr("USRNOD(3) holds a history"));
  EXPECT_EQ(refusal("field:4"), "accepted");
}

TEST_F(SlowDeform, ReadsNoFileAndNoTextWhileItRuns) {
  const std::regex input("\n *(read|open|inquire)\\b|iusr", std::regex::icase);
  for (const test::NamedTable& sample : test::sample_tables())
    for (const auto& [path, text] : deform().generate(request(sample.table))) {
      if (!path.ends_with(".f")) continue;
      EXPECT_FALSE(std::regex_search(text, input)) << path;
    }
}

TEST_F(SlowDeform, TakesWorkAndPeakPressureOfTheNodesInTheSolversUnits) {
  const Table table = test::history_table();
  const TableFunction function(table);
  for (const test::SolverScale& scale : test::every_system()) {
    const double stress = scale.stress, work = scale.stress * scale.length;
    use("histories " + scale.name, request(table, "coulomb", {}, scale.units));
    call.user_variables = 3;
    contact->pressure = 700 * stress;
    call.nodal = {0, 100 * work, 800 * stress, 0, 300 * work, 1000 * stress};
    const double state[] = {700, 200, 900}, risen[] = {1200, 200, 1200};
    EXPECT_CLOSE(run(), function(state) / 700, bound);
    contact->pressure = 1200 * stress; // above the peak of the last step
    EXPECT_CLOSE(run(), function(risen) / 1200, bound);
    contact->pressure = nan;
    EXPECT_TRUE(std::isnan(run()));
  }
}

TEST_F(SlowDeform, StopsWithAnErrorCodeBeyondAnErrorSideAndNamesStateAndValue) {
  const Table table = test::sides_table();
  const ExportRequest asked = request(table);
  codegen::BuildVariant variant{
      "double",
      {"gfortran", "-shared", "-fPIC", "-std=legacy", "-o", "@{out}", "@{dir}/frictab_usrbcc.f"},
      {},
      0};
  const frictab::TemporaryDirectory work;
  const Library own(codegen::compile_library(deform().generate(asked), variant, work.path()));
  void* function = Library::address(own.handle(), "usrbcc_");
  *own.find<Ufhcom>("ufhcom_") = {20, 20, 50, 1000};
  *own.find<Ufhcom2>("ufhcom2_") = {psi, flow, 1};
  call.temperature[0] = call.temperature[1] = 100;
  call.run(function);
  EXPECT_GT(call.variable, 0);
  own.find<Ufhcom>("ufhcom_")->sliding_speed = 600;
  EXPECT_EXIT(
      {
        dup2(2, 1); // the matcher reads the standard error
        call.run(function);
      },
      testing::ExitedWithCode(1), "6.000000E.02 is outside the range: v_rel_mm_s above 500");
}

TEST_F(SlowDeform, NamesTheKeywordOfItsFrictionType) {
  const std::pair<const char*, const char*> keywords[] = {
      {"shear", "FRCFAC <workpiece>, <die>, 1, -1, 0\n"},
      {"coulomb", "FRCFAC <workpiece>, <die>, 2, -1, 0\n"},
      {"constant", "FRCFAC <workpiece>, <die>, 3, -1, 0\n"}};
  for (const auto& [friction, keyword] : keywords) {
    const auto recipe =
        test::parse_json(deform().generate(request(four_axis(), friction)).at("recipe.json"));
    EXPECT_EQ(recipe["input_deck"], keyword);
  }
}

struct DeformUpdate : SlowDeform {
  void SetUp() override {
    SlowDeform::SetUp();
    if (IsSkipped()) return;
    static const Table table = test::branching_table();
    use("branching", request(table));
    node = library->find<Nodcom>("nodcom_");
    contact_of_node = library->find<Nodcom2>("nodcom2_");
    control = library->find<int>("usrctl_");
    *node = {};
    *contact_of_node = {1, 20, -40, {70, -900}, 0};
    control[1] = 1; // ISTATUS: end of a converged step
    node->node = 5;
    *library->find<double>("sstu_") = 0.25;
    node->before[0] = 3, node->before[1] = 100, node->before[2] = 500;
    std::fill(node->after, node->after + 1500, 777);
  }
  void update() {
    const test::FloatTraps traps;
    library->find<void()>("ftupd_")();
  }

  Nodcom* node = nullptr;
  Nodcom2* contact_of_node = nullptr;
  int* control = nullptr;
};

TEST_F(DeformUpdate, AddsSlipAndWorkAndKeepsThePeakOnceAConvergedStep) {
  update();
  EXPECT_EQ(node->after[0], 3 + 40 * 0.25);
  EXPECT_EQ(node->after[1], 100 + 70 * 40 * 0.25);
  EXPECT_EQ(node->after[2], 900);
  EXPECT_EQ(node->after[3], 777) << "the others are USRUPD's own business";
  EXPECT_EQ(node->before[0], 3);
}

TEST_F(DeformUpdate, KeepsTheHistoryWithoutPressureAndALowerPeak) {
  contact_of_node->traction[1] = 0;
  update();
  for (const int i : {0, 1, 2})
    EXPECT_EQ(node->after[i], node->before[i]);
  contact_of_node->traction[1] = 400;
  update();
  EXPECT_EQ(node->after[2], 500);
}

TEST_F(DeformUpdate, DoesNothingAtTheStartOfAStepAndForElements) {
  control[1] = 0;
  update();
  EXPECT_EQ(node->after[0], 777);
  control[1] = 1;
  node->node = 0;
  update();
  EXPECT_EQ(node->after[0], 777);
}

TEST_F(DeformUpdate, KeepsNaN) {
  contact_of_node->traction[1] = nan;
  update();
  for (const int i : {0, 1, 2})
    EXPECT_TRUE(std::isnan(node->after[i]));
}

} // namespace
} // namespace frictab::deform_test
