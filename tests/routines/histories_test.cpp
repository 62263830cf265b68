// Histories as axes of a table: slip, friction work and peak pressure from the state variables of
// VFRIC and VFRICTION, increment by increment, in both precisions and unit systems.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "codegen/solver_inputs.h"
#include "data/derived.h"
#include "routines/abaqus_routines.h"
#include "support/solver_scale.h"

namespace frictab::histories_test {

using expr::Expr;
using table::Table;

namespace {

// mu over sliding distance, friction work and peak pressure, as a traced law has them.
Table history_table() {
  Table table;
  table.model = "traced histories";
  for (const auto& [name, high] :
       {std::pair{"sliding_distance", 40.0}, {"friction_work", 3000.0}, {"peak_sigma_n", 2000.0}}) {
    table::TableAxis axis;
    axis.name = name;
    axis.unit = data::find_derived(name)->unit;
    axis.nodes = {0, 0.3 * high, high};
    table.axes.push_back(axis);
  }
  for (int i = 0; i < 27; ++i)
    table.value.push_back(0.05 + 0.01 * ((i * 11) % 27));
  table.combine = Expr::symbol("value") * Expr::symbol("sigma_n_MPa");
  return table;
}

// The order of states below.
TEST(HistoryTable, AsksForPressureWorkPeakAndSlip) {
  EXPECT_EQ(history_table().inputs(),
            (std::vector<std::string>{"sigma_n_MPa", "friction_work", "peak_sigma_n",
                                      "sliding_distance"}));
}

struct Contact {
  double pressure, slip; // MPa, mm: of one increment
};
const std::vector<Contact> path = {{500, 2}, {800, 3}, {300, 4}, {0, 5}, {900, 6}, {400, 1}};

// One contact point of either routine; units are the solver's.
template <class Case> class SlowHistories : public test::NeedsGfortran, protected Case {
protected:
  using Call = typename Case::Call;
  // Single: force, state and slip are rounded to 24 bits at each of six increments.
  using Case::bound;

  static Call call(unsigned states = 6) {
    Call c = Case::call(1, [states](Call& plain) { plain.states = static_cast<int>(states); });
    c.temperatures = false;
    c.properties.clear();
    c.time_increment = typename Case::Real(0.125);
    c.area[0] = 4;
    return c;
  }

  static void run(Call& c, void* function) {
    const test::FloatTraps traps;
    c.run(function);
    c.previous[0] = c.tangential[0]; // as the solver hands it back
  }
};
TYPED_TEST_SUITE(SlowHistories, test::ForceCases, test::RoutineName);

TYPED_TEST(SlowHistories, FollowAPathOfIncrementsAsTheDefinitionSays) {
  using Number = typename TypeParam::Real;
  static const Table table = history_table();
  static const table::TableFunction function(table);
  for (const test::SolverScale& scale : test::every_system()) {
    const double stress = scale.stress, length = scale.length;
    void* routine = this->routine("path" + scale.name, table, {}, scale.units);
    auto c = this->call();
    double slip = 0, work = 0, peak = 0, before = 0;
    for (const Contact& contact : path) {
      c.normal[0] = static_cast<Number>(4 * contact.pressure * stress);
      c.slip[0] = static_cast<Number>(contact.slip * length);
      this->run(c, routine);
      double tau = 0;
      if (contact.pressure > 0) { // out of contact nothing slides and nothing is remembered
        slip += contact.slip;
        peak = std::max(peak, contact.pressure);
        const double state[] = {contact.pressure, work, peak, slip};
        tau = function(state);
        work += 0.5 * (before + tau) * contact.slip;
      }
      before = tau;
      EXPECT_NEAR(c.tangential[0], -4 * tau * stress, 4 * tau * stress * TestFixture::bound);
      EXPECT_NEAR(c.state[0], slip * length, slip * length * TestFixture::bound);
      EXPECT_NEAR(c.state[1], work * stress * length, work * stress * length * TestFixture::bound);
      EXPECT_NEAR(c.state[2], peak * stress, peak * stress * TestFixture::bound);
      EXPECT_EQ(c.state[3], 0);
    }
    EXPECT_EQ(c.state[0], static_cast<Number>(16 * length)) << "and the path was walked once";
  }
}

TYPED_TEST(SlowHistories, WithoutStateVariablesAreThoseOfTheIncrementAlone) {
  static const Table table = history_table();
  static const table::TableFunction function(table);
  auto c = this->call(0);
  for (int increment = 0; increment < 2; ++increment) {
    c.normal[0] = 4 * 500;
    c.slip[0] = 2;
    this->run(c, this->routine("path", table));
    const double state[] = {500, 0, 500, 2};
    EXPECT_NEAR(c.tangential[0], -4 * function(state), 4 * function(state) * TestFixture::bound);
  }
}

TYPED_TEST(SlowHistories, AreNotSpoiltByAForceBeforeThatIsNaN) {
  static const Table table = history_table();
  void* routine = this->routine("path", table);
  auto c = this->call();
  c.normal[0] = 4 * 500;
  c.slip[0] = 2;
  c.previous[0] = std::numeric_limits<typename TypeParam::Real>::quiet_NaN();
  this->run(c, routine);
  EXPECT_LT(c.tangential[0], 0) << "this force does not depend on the one before";
  EXPECT_NEAR(double(c.state[1]), -double(c.tangential[0]) / 4 * 2, 1e-3);
  this->run(c, routine);
  EXPECT_LT(c.tangential[0], 0);
  EXPECT_EQ(c.state[0], 4);
}

TYPED_TEST(SlowHistories, ThatAreNaNGiveNaNWhereTheLawAsksForThem) {
  static const Table table = history_table();
  for (std::size_t spoilt = 0; spoilt < 6; ++spoilt) {
    auto c = this->call();
    c.normal[0] = 4 * 500;
    c.slip[0] = 2;
    c.state[spoilt] = std::numeric_limits<typename TypeParam::Real>::quiet_NaN();
    this->run(c, this->routine("path", table));
    EXPECT_EQ(std::isnan(c.tangential[0]), spoilt != 3) << "4 is a count: " << spoilt;
  }
}

TYPED_TEST(SlowHistories, OfSmallIncrementsDoNotStandStillInSinglePrecision) {
  using Number = typename TypeParam::Real;
  static const Table table = test::constant_table();
  void* routine = this->routine("constant", table);
  auto with = this->call(6), without = this->call(4);
  for (auto* c : {&with, &without}) {
    c->state[0] = 40;
    c->normal[0] = 4000;
    c->slip[0] = Number(1e-6);
    for (int increment = 0; increment < 100000; ++increment)
      c->run(routine);
  }
  const double slipped = 100000 * static_cast<double>(Number(1e-6));
  // Half a unit in the last place of 40: once in single precision, per increment in double.
  EXPECT_NEAR(with.state[0], 40 + slipped, sizeof(Number) == 4 ? 2e-6 : 4e-10);
  if (sizeof(Number) == 4) {
    EXPECT_EQ(without.state[0], 40) << "what a sum without its remainder does";
  }
}

TYPED_TEST(SlowHistories, DriversPoseThemAndLeaveOutWhatCannotBe) {
  static const Table table = history_table();
  static const table::TableFunction function(table);
  const std::vector<double> slip = {5, 20, 30, 12}, work = {100, 2000, 700, 5};
  const std::vector<double> peak = {900, 1500, 400, 600}, pressure = {700, 1500, 500, 600};
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_" + this->entry);
  for (const test::SolverScale& scale : test::every_system()) {
    const codegen::ExportRequest request{table, scale.units, {}};
    const codegen::BuildVariant variant = exporter.variants(request)[TestFixture::single ? 1 : 0];
    std::vector<double> tau(4, -1);
    codegen::CompiledTarget(exporter, request, exporter.generate(request), variant)
        .drive(4,
               std::vector<const double*>{pressure.data(), work.data(), peak.data(), slip.data()},
               tau);
    for (std::size_t i : {0u, 1u, 3u}) {
      const double state[] = {pressure[i], work[i], peak[i], slip[i]};
      EXPECT_NEAR(tau[i], function(state), function(state) * TestFixture::bound) << scale.name;
    }
    EXPECT_EQ(tau[2], -1) << "a peak below the present pressure is not a state";
  }
}

} // namespace

} // namespace frictab::histories_test
