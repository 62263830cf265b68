// USRMU called as the lines put into CalculiX call it, with bounds checked and floating point traps
// on. examples/06_calculix runs it inside CalculiX.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/entry_arguments.h"
#include "support/generated.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::calculix_test {

using expr::Expr;
using table::Table;

namespace {

using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double bound = 1e-13; // the order of operations only
constexpr double psi = 2.5, flow = 480;

// A contact point that slides by 0.05 mm in 1 ms, at 1000 MPa and 100 degC, 2 mm from its start.
struct Spring {
  double pressure = 1000, temperature = 100, time = 1e-3;
  double displacement[3] = {0.03, 0.04, 7}, normal[3] = {0, 0, 1}, along_normal = 7;
  double tangential[3] = {1.2, -1.6, 0};
  double coefficient = 0.1; // of *FRICTION

  double run(const codegen::Library& library) const {
    using Usrmu = void(double*, const double*, const double*, const double*, const double*,
                       const double*, const double*);
    double um = coefficient;
    const test::FloatTraps traps;
    library.find<void(const double*)>("usrmu_time_")(&time);
    library.find<Usrmu>("usrmu_")(&um, &pressure, displacement, normal, &along_normal, tangential,
                                  &temperature);
    return um;
  }
};

class Calculix : public test::NeedsGfortran {
protected:
  static const codegen::Exporter& target() { return *codegen::find_exporter("calculix_usrmu"); }
  static codegen::ExportRequest request(const Table& table) {
    return {table, "mm-t-s", {{"psi", "constant:2.5"}, {"sigma_f_MPa", "constant:480"}}};
  }
  // Over pressure, surface expansion, speed and temperature.
  static const Table& table() {
    static const Table four = test::four_axis_table();
    return four;
  }
  static const codegen::Library& routine() {
    return *test::compiled("four", target(), request(table()), "double", test::strict_declared);
  }
  static double mu(double pressure, double speed, double temperature) {
    static const table::TableFunction tau(table());
    const double state[] = {pressure, psi, speed, temperature, flow};
    return tau(state) / pressure;
  }
};

using SlowCalculix = Calculix;

TEST_F(SlowCalculix, AgreesWithFrictabForEveryTableAndUnit) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const test::SolverScale& scale : test::every_system()) {
      if (scale.name != "mm-t-s" && !test::has_every_kind_of_argument(sample)) continue;
      SCOPED_TRACE(sample.name + " " + scale.name);
      const test::SampleRequest sampled(target(), sample.table, scale.units);
      EXPECT_LE(test::worst_driven(target(), sampled.get(), "double", test::strict_declared),
                bound);
    }
}

TEST_F(Calculix, TakesTheSpeedOfTheTangentialDisplacementOverTheIncrement) {
  EXPECT_CLOSE(Spring().run(routine()), mu(1000, 50, 100), bound);
  Spring faster;
  faster.time = 0.5e-3;
  EXPECT_CLOSE(faster.run(routine()), mu(1000, 100, 100), bound);
  Spring no_time;
  no_time.time = 0;
  EXPECT_CLOSE(no_time.run(routine()), mu(1000, 0, 100), bound);
}

TEST_F(Calculix, TakesTheTangentialDisplacementAsTheSlidingDistance) {
  Table slides = test::constant_table();
  slides.combine = Expr::symbol("sigma_n_MPa") * Expr::symbol("s_mm");
  const codegen::Library& library =
      *test::compiled("slides", target(), {slides, "mm-t-s", {}}, "double", test::strict_declared);
  EXPECT_CLOSE(Spring().run(library), 2.0, bound);
}

TEST_F(Calculix, TakesTheConstantTemperatureWhereTheDeckHasNone) {
  Spring cold;
  cold.temperature = 0;
  EXPECT_CLOSE(cold.run(routine()), mu(1000, 50, *codegen::typical_value(table(), "T_contact_C")),
               bound);
}

TEST_F(Calculix, IsNotAskedForATemperatureOf0WhichStandsForNone) {
  Table warm = table();
  warm.axes[3].nodes.front() = 0;
  const codegen::ExportRequest asked = request(warm);
  const test::States states(warm, 2, 5, 0, {{"psi", 2.5}, {"sigma_f_MPa", 480}});
  std::vector<const double*> columns = states.columns();
  const std::vector<double> temperature = {0, 50};
  columns[3] = temperature.data();
  std::vector<double> tau(2, -1);
  codegen::CompiledTarget(target(), asked, target().generate(asked), target().variants(asked)[0])
      .drive(2, columns, tau);
  EXPECT_EQ(tau[0], -1);
  EXPECT_GT(tau[1], 0);
}

TEST_F(Calculix, LeavesTheCoefficientOfFRICTIONWithoutContact) {
  for (const double pressure : {0.0, -5.0}) {
    Spring open;
    open.pressure = pressure;
    EXPECT_EQ(open.run(routine()), 0.1);
  }
}

TEST_F(Calculix, GivesNaNForNaNInAnyArgumentItUses) {
  std::vector<Spring> springs(4);
  springs[0].pressure = nan;
  springs[1].temperature = nan;
  springs[2].displacement[0] = nan;
  springs[3].along_normal = nan;
  for (const Spring& spring : springs)
    EXPECT_TRUE(std::isnan(spring.run(routine())));
}

TEST_F(Calculix, ShipsTheScriptThatPutsItsCallsIntoTheSource) {
  const codegen::SourceBundle bundle = target().generate(request(table()));
  EXPECT_THAT(bundle.at("frictab_hook.sh"), HasSubstr("call usrmu(um,dfnl/springarea(1)"));
  EXPECT_THAT(bundle.at("recipe.json"), HasSubstr("frictab_hook.sh"));
}

} // namespace
} // namespace frictab::calculix_test
