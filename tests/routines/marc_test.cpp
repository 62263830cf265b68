// UFRIC called as Marc calls it, with bounds checked and floating point traps on.
#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "routines/standard_case.h"
#include "support/calls/ufric.h"
#include "support/generated.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::marc_test {

using codegen::ExportRequest;
using codegen::Library;
using table::Table;

namespace {

using calls::UfricCall;
using testing::HasSubstr;
using namespace test;
using Options = std::map<std::string, std::string>;

constexpr double bound = 1e-13; // the order of operations only
const double k = flow / std::sqrt(3.0);

const codegen::Exporter& marc() {
  return *codegen::find_exporter("marc_ufric");
}

ExportRequest request(const Table& table, const Options& options = {},
                      const codegen::SolverUnits& units = {}) {
  ExportRequest out{table, units, {}};
  out.options = options;
  return out;
}

class SlowMarc : public test::NeedsGfortran {
protected:
  static void* routine(const std::string& key, const ExportRequest& request) {
    return Library::address(
        test::compiled(key, marc(), request, "double", test::strict_declared)->handle(), "ufric_");
  }
  static void* four_axes(const Options& options = {}, const codegen::SolverUnits& units = {}) {
    ExportRequest asked = request(four_axis(), options, units);
    asked.inputs = {{"psi", "constant:2.5"}};
    std::string key = "four " + units.text();
    for (const auto& [name, word] : options)
      key += " " + word;
    return routine(key, asked);
  }

  // 1000 MPa, 50 mm/s, 100 degC.
  static UfricCall call() {
    UfricCall c;
    c.normal = 1000;
    c.slip[0] = 50;
    c.temperature[0] = 100;
    c.flow_stress = flow;
    return c;
  }
  static double run(const UfricCall& c, void* function) {
    const test::FloatTraps traps;
    return c.run(function);
  }
};

TEST_F(SlowMarc, AgreesWithFrictabForEveryKindOfArgumentUnitAndChoice) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const test::SolverScale& scale : test::every_system())
      for (const std::string friction : {"coulomb", "shear"}) {
        if (!test::has_every_kind_of_argument(sample)) continue;
        SCOPED_TRACE(sample.name + " " + scale.name + " " + friction);
        const ExportRequest asked = request(
            sample.table, {{"marc_friction", friction}, {"marc_dimension", "3d"}}, scale.units);
        EXPECT_LE(test::worst_driven(marc(), asked, "double", test::strict_declared), bound);
      }
}

TEST_F(SlowMarc, GivesMuOrTheShearFactorAsTheJobSays) {
  EXPECT_CLOSE(run(call(), four_axes()), four_axis_tau(1000, 50, 100) / 1000, bound);
  EXPECT_CLOSE(run(call(), four_axes({{"marc_friction", "shear"}})),
               four_axis_tau(1000, 50, 100) / k, bound);
}

TEST_F(SlowMarc, ReadsOneComponentOfVRELIn2DAndTwoIn3D) {
  UfricCall c = call();
  c.slip[1] = nan;
  EXPECT_CLOSE(run(c, four_axes()), four_axis_tau(1000, 50, 100) / 1000, bound);
  c.slip[0] = -30;
  c.slip[1] = 40;
  EXPECT_CLOSE(run(c, four_axes({{"marc_dimension", "3d"}})), four_axis_tau(1000, 50, 100) / 1000,
               bound);
  EXPECT_CLOSE(run(c, four_axes()), four_axis_tau(1000, 30, 100) / 1000, bound);
}

TEST_F(SlowMarc, DoesNotRelyOnTheSignOfTheNormalStress) {
  UfricCall c = call();
  c.normal = -1000;
  EXPECT_CLOSE(run(c, four_axes()), four_axis_tau(1000, 50, 100) / 1000, bound);
}

TEST_F(SlowMarc, GivesMuOfTheLeastPressureInsteadOf0Over0) {
  const double least = four_axis_tau(1e-3, 50, 100) / 1e-3;
  for (const double pressure : {0.0, 1e-300, 1e-4, 1e-3}) {
    UfricCall c = call();
    c.normal = pressure;
    EXPECT_CLOSE(run(c, four_axes()), least, bound) << pressure;
  }
}

TEST_F(SlowMarc, GivesNoShearFactorWithoutNormalStressOrFlowStress) {
  void* function = four_axes({{"marc_friction", "shear"}});
  UfricCall c = call();
  c.normal = 0;
  EXPECT_EQ(run(c, function), 0);
  c = call();
  for (const double none : {0.0, -5.0}) {
    c.flow_stress = none;
    EXPECT_EQ(run(c, function), 0) << none;
  }
}

TEST_F(SlowMarc, GivesNaNForNaNInAnyArgumentItUses) {
  for (const std::string friction : {"coulomb", "shear"})
    for (int i = 0; i < 4; ++i) {
      UfricCall c = call();
      double* const arguments[] = {&c.normal, &c.slip[0], &c.temperature[0], &c.flow_stress};
      *arguments[i] = nan;
      EXPECT_TRUE(std::isnan(run(c, four_axes({{"marc_friction", friction}})))) << i;
    }
}

TEST_F(SlowMarc, TakesInfinitiesAsFarOutsideTheTable) {
  UfricCall c = call();
  c.normal = inf;
  EXPECT_NEAR(run(c, four_axes()), 0, 1e-20) << "the shear limit over any pressure";
  EXPECT_CLOSE(run(c, four_axes({{"marc_friction", "shear"}})), 0.8, bound);
  c = call();
  c.slip[0] = inf;
  EXPECT_CLOSE(run(c, four_axes()), four_axis_tau(1000, 1e9, 100) / 1000, bound);
  c = call();
  c.temperature[0] = -inf;
  EXPECT_CLOSE(run(c, four_axes()), four_axis_tau(1000, 50, -1e9) / 1000, bound);
}

TEST_F(SlowMarc, UsesTheNearestEdgeOutsideEachSideOfEachAxis) {
  const double states[][3] = {{100, 50, 100},    {4000, 50, 100}, {1000, 1, 100},
                              {1000, 2000, 100}, {1000, 50, -40}, {1000, 50, 900}};
  for (const auto& [p, v, T] : states) {
    UfricCall c = call();
    c.normal = p, c.slip[0] = v, c.temperature[0] = T;
    EXPECT_CLOSE(run(c, four_axes()), four_axis_tau(p, v, T) / p, bound);
  }
}

TEST_F(SlowMarc, ConvertsUnitsOfMetreKilogramSecond) {
  UfricCall c = call();
  c.normal = 1000e6, c.slip[0] = 0.05, c.flow_stress = flow * 1e6;
  EXPECT_CLOSE(run(c, four_axes({}, "m-kg-s")), four_axis_tau(1000, 50, 100) / 1000, bound);
}

TEST_F(SlowMarc, KeepsWhatMarcDoesNotGiveAsConstantsOfTheSource) {
  ExportRequest asked = request(four_axis());
  asked.inputs = {{"psi", "constant:7"}, {"sigma_f_MPa", "constant:300"}};
  EXPECT_CLOSE(run(call(), routine("constants", asked)),
               four_axis_tau(1000, 50, 100, 7, 300) / 1000, bound);
  EXPECT_THAT(marc().generate(asked).at("recipe.json"), HasSubstr("\"constant\": 7.0"));
}

TEST_F(SlowMarc, RefusesAForceWhereTheCoefficientDependsOnThePressure) {
  const auto refusal = [](const Table& table, const std::string& friction) {
    return test::refusal([&] {
      marc().generate(request(table, {{"marc_normal", "force"}, {"marc_friction", friction}}));
    });
  };
  Table limited = test::constant_table();
  limited.combine = minimum(limited.combine, expr::Expr::symbol("sigma_f_MPa") / 2);
  for (const char* friction : {"coulomb", "shear"})
    EXPECT_THAT(refusal(limited, friction), HasSubstr("UFRIC gives no area"));
  EXPECT_THAT(refusal(four_axis(), "coulomb"), HasSubstr("marc_normal = \"stress\""));
  EXPECT_THAT(refusal(test::one_axis_table(), "coulomb"), HasSubstr("depends on the pressure"));
  EXPECT_EQ(refusal(test::one_axis_table(), "shear"), "accepted");
  EXPECT_EQ(refusal(test::constant_table(), "coulomb"), "accepted");
}

TEST_F(SlowMarc, GivesTheSameMuForEveryForceWhereTheLawHasNoShearLimit) {
  static const Table table = test::constant_table();
  void* function = routine("force", request(table, {{"marc_normal", "force"}}));
  for (const double force : {0.0, 1e-9, 5.0, 1e9, inf}) {
    UfricCall c = call();
    c.normal = force;
    EXPECT_CLOSE(run(c, function), 0.08, bound);
  }
  UfricCall c = call();
  c.normal = nan;
  EXPECT_TRUE(std::isnan(run(c, function)));
}

TEST_F(SlowMarc, EndsTheAnalysisThroughQUITBeyondAnErrorSideAndNamesStateAndValue) {
  const Table table = test::sides_table();
  const ExportRequest asked = request(table);
  codegen::BuildVariant variant{"double",
                                {"gfortran", "-shared", "-fPIC", "-std=legacy", "-fcheck=all", "-o",
                                 "@{out}", "@{dir}/frictab_ufric.f", "@{dir}/quit.f"},
                                {{"quit.f", "      subroutine quit(number)\n"
                                            "      integer number, seen\n"
                                            "      common /told/ seen\n"
                                            "      seen = number\n"
                                            "      end\n"}},
                                0};
  const TemporaryDirectory work;
  const Library library(codegen::compile_library(marc().generate(asked), variant, work.path()));
  const int* seen = library.find<int>("told_");
  void* function = Library::address(library.handle(), "ufric_");
  UfricCall c = call();
  EXPECT_FALSE(std::isnan(run(c, function)));
  EXPECT_EQ(*seen, 0);
  c.slip[0] = 600;
  testing::internal::CaptureStdout();
  EXPECT_TRUE(std::isnan(run(c, function))) << "where QUIT comes back";
  EXPECT_THAT(testing::internal::GetCapturedStdout(),
              HasSubstr("6.000000E+02 is outside the range: v_rel_mm_s above 500"));
  EXPECT_EQ(*seen, 1234);
}

TEST_F(SlowMarc, MayRunInThreadsAtOnce) {
  // Not with -fcheck=recursion: its own flag is shared by all threads.
  const Library* library = test::compiled("threads", marc(), request(four_axis()), "double");
  void* function = Library::address(library->handle(), "ufric_");
  const auto all = [&](int times) {
    std::vector<double> mu;
    for (int t = 0; t < times; ++t) {
      mu.clear();
      for (int i = 0; i < 200; ++i) {
        UfricCall c = call();
        c.normal = 600 + 10 * i;
        mu.push_back(c.run(function));
      }
    }
    return mu;
  };
  const std::vector<double> serial = all(1);
  std::vector<std::vector<double>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results)
    threads.emplace_back([&] { result = all(100); });
  for (std::thread& thread : threads)
    thread.join();
  for (const auto& result : results)
    EXPECT_EQ(result, serial);
}

} // namespace
} // namespace frictab::marc_test
