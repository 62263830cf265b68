// Beyond the ends of a table's axes: each policy on each side, in C++, C and Fortran, and what is
// counted and said there.
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/calls/vfric.h"
#include "support/error_routine.h"
#include "support/generated.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "table/direct.h"
#include "table/drift.h"
#include "table/tolerance.h"

namespace frictab::outside_agreement_test {

using codegen::Library;
using expr::Expr;
using table::Outside;
using table::outside_name;
using table::Table;
using table::TableFunction;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

using Entry = double(double, double, double, double, double, double);
using Bits = unsigned(double, double, double, double, double, double);
using Array = const double*;
using Count = void(std::size_t, Array, Array, Array, Array, Array, Array, unsigned long*);

// One axis, temperature 20 .. 200 degC, that holds T^2/100 while the law says 0.03 T.
Table temperature_table(Outside below, Outside above) {
  Table table;
  table.model = "temperature";
  table.quantity = models::PieceQuantity::tau_R;
  table::TableAxis axis;
  axis.name = "T_contact_C";
  axis.unit = "degC";
  axis.nodes = {20, 200};
  axis.below = below;
  axis.above = above;
  table.axes = {axis};
  table.value = {4, 400};
  table.extension = 0.03 * Expr::symbol("T_contact_C");
  table.combine = Expr::symbol("value") + Expr::symbol("sigma_n_MPa");
  return table;
}

double beyond(Outside outside, double at_end, double x) {
  if (outside == Outside::error) return std::nan("");
  return outside == Outside::law ? 0.03 * x : at_end;
}

// tau_R by every target in double precision, or by one of each language, at these pressures and
// temperatures.
void expect_everywhere(const Table& table, const std::vector<double>& pressure,
                       const std::vector<double>& temperature, const std::vector<double>& wanted,
                       bool by_language = false) {
  const std::vector<const double*> columns = {pressure.data(), temperature.data()};
  std::vector<double> tau(wanted.size());
  TableFunction(table).evaluate(tau.size(), columns, tau);
  EXPECT_EQ(test::worst_relative(tau, wanted), 0) << "C++";
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.is_routine())
      continue; // a solver's own table has no rule of ours beyond its ends
    if (by_language && !test::stands_for_its_language(exporter)) continue;
    const codegen::ExportRequest request{table, "mm-t-s", {}};
    const codegen::BuildVariant variant = exporter.variants(request)[0];
    if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is missing";
    codegen::CompiledTarget(exporter, request, exporter.generate(request), variant)
        .drive(tau.size(), columns, tau);
    EXPECT_LE(test::worst_relative(tau, wanted), 1e-14) << exporter.name;
  }
}

constexpr Outside kinds[] = {Outside::clamp, Outside::error, Outside::law};

TEST(LongOutsideTheRange, EveryPolicyOnEachSideIsTheSameInCppCAndFortran) {
  const std::vector<double> p = {500, 500, 700, 700, 900}, T = {-30, 19.5, 200.5, 1000, 110};
  // Sides are written by the core, which targets of one language share. They know nothing of each
  // other: each policy on each side in every target.
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t other = 0; other < 3; ++other) {
      const Outside below = kinds[k], above = kinds[other];
      SCOPED_TRACE(std::string(outside_name(below)) + ", " + outside_name(above));
      std::vector<double> wanted;
      for (std::size_t i = 0; i < T.size(); ++i)
        wanted.push_back(p[i] + (T[i] < 20    ? beyond(below, 4, T[i])
                                 : T[i] > 200 ? beyond(above, 400, T[i])
                                              : 4 + 396 * (T[i] - 20) / 180));
      expect_everywhere(temperature_table(below, above), p, T, wanted, other != (k + 1) % 3);
    }
}

// What a target does where the core refuses is the same for both forms: in each language.
TEST(LongOutsideTheRange, TheDirectFormKeepsThePoliciesOfItsTable) {
  const std::vector<double> p = {500, 500, 700, 700, 900}, T = {-30, 19.5, 200.5, 1000, 110};
  // Each on either side: the sides know nothing of each other.
  for (std::size_t k = 0; k < 3; ++k) {
    const Outside below = kinds[k], above = kinds[(k + 1) % 3];
    SCOPED_TRACE(std::string(outside_name(below)) + ", " + outside_name(above));
    Table direct = temperature_table(below, above);
    direct.interpolation = table::Interpolation::none;
    direct.value.clear();
    std::vector<double> wanted;
    for (std::size_t i = 0; i < T.size(); ++i)
      wanted.push_back(p[i] + (T[i] < 20    ? beyond(below, 0.6, T[i])
                               : T[i] > 200 ? beyond(above, 6, T[i])
                                            : 0.03 * T[i]));
    expect_everywhere(direct, p, T, wanted, true);
  }
}

TEST(LongOutsideTheRange, AxesThatClampAreHeldWhereAnotherGoesOnByTheLaw) {
  const Table table = test::sides_table(); // sigma_n below: law, v below: clamp
  const TableFunction function(table);
  Table reference = test::direct_table();
  for (table::TableAxis& axis : reference.axes)
    axis.below = axis.above = Outside::law;
  const TableFunction law(reference);
  unsigned bits = 0;
  const double outside[] = {300, 1, 100, 480}, held[] = {300, 5, 100, 480};
  EXPECT_DOUBLE_EQ(function(outside, &bits), law(held));
  EXPECT_EQ(bits, 3U);
}

TEST(LongOutsideTheRange, TheLawsGradientHoldsBeyondItsSideAndIsZeroByHeldAxes) {
  const TableFunction function(test::sides_table());
  const double state[] = {300, 1, 250, 480}; // law, clamp, law; combine takes sigma_n as it is
  double by[4];
  function.gradient(state, by);
  for (std::size_t d = 0; d < 4; ++d) {
    double up[4], down[4];
    std::copy(state, state + 4, up), std::copy(state, state + 4, down);
    const double step = 1e-5 * state[d];
    up[d] += step, down[d] -= step;
    EXPECT_NEAR(by[d], (function(up) - function(down)) / (2 * step), 1e-7) << d;
  }
  EXPECT_EQ(by[1], 0);
  EXPECT_NE(by[2], 0);
}

TEST(LongOutsideTheRange, ALawThatGoesOnLeavesTheEdgeByNoMoreThanTheDrift) {
  for (const char* name : {"log_coulomb", "exp_coulomb", "wzl", "wanheim_bay"}) {
    const models::Model model = test::plausible_model(*models::find_law(name));
    const data::Dataset data = test::sample_data(model);
    table::TableOptions options;
    for (const char* state : {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "sigma_f_MPa"})
      options.axes[state].outside = {"law"};
    const auto ranges = table::state_ranges(models::AssembledLaw(model), data, options);
    const TableFunction table(table::build_table(models::AssembledLaw(model), ranges, options));
    const table::LawFunction law(models::AssembledLaw(model), table.inputs());
    Random random(4);
    for (int i = 0; i < 200; ++i) {
      std::vector<double> at;
      for (const table::StateRange& range : ranges)
        at.push_back(random.uniform(range.low, range.high));
      const std::size_t d = random.below(ranges.size());
      const bool up = random.below(2) == 1;
      at[d] = up ? ranges[d].high : ranges[d].low;
      auto out = at;
      out[d] = std::nextafter(at[d], up ? inf : -inf);
      EXPECT_NEAR(table(at), table(out), table::usual_tolerance_MPa)
          << name << " " << ranges[d].name;
      out[d] = up ? 1.5 * at[d] : 0.7 * at[d]; // and beyond it is the law, to the bit of a sum
      const bool maybe_no_axis = ranges[d].name == "sigma_f_MPa";
      EXPECT_NEAR(table(out), law(out), maybe_no_axis ? table::usual_tolerance_MPa : 1e-10)
          << name << " " << ranges[d].name;
    }
  }
}

const Library& sides_in_c(bool direct) {
  static const Table table = test::sides_table(), law = test::direct_table();
  const codegen::ExportRequest request{direct ? law : table, "mm-t-s", {}};
  return *test::compiled(direct ? "direct" : "sides", *codegen::find_exporter("c"), request, "c99");
}

TEST(LongOutsideTheRange, CTellsBitsAndCountsByAxisAndSideIntoTheCallersOwnCounts) {
  for (const bool direct : {false, true}) {
    const auto bits = sides_in_c(direct).find<Bits>("frictab_outside");
    EXPECT_EQ(bits(1000, 0, 50, 100, 0, 480), 0U);
    EXPECT_EQ(bits(499, 0, 50, 100, 0, 480), 1U);
    EXPECT_EQ(bits(1000, 0, 501, 100, 0, 480), 2U);
    EXPECT_EQ(bits(2751, 0, 1, 19, 0, 480), 7U);
    const double p[] = {400, 3000, 3001, 1000}, v[] = {50, 50, 600, 1}, T[] = {100, 100, 100, 300};
    unsigned long counts[6] = {10, 0, 0, 0, 0, 0};
    sides_in_c(direct).find<Count>("frictab_count_outside")(4, p, nullptr, v, T, nullptr, nullptr,
                                                            counts);
    const unsigned long wanted[6] = {11, 2, 1, 1, 0, 1};
    for (int i = 0; i < 6; ++i)
      EXPECT_EQ(counts[i], wanted[i]) << i;
  }
}

TEST(LongOutsideTheRange, CCountsInThreadsWithoutAnyStateOfItsOwn) {
  const auto count = sides_in_c(false).find<Count>("frictab_count_outside");
  const std::vector<double> p(50000, 400), v(50000, 50), T(50000, 300);
  std::vector<std::vector<unsigned long>> counts(4, std::vector<unsigned long>(6));
  std::vector<std::thread> threads;
  for (auto& own : counts)
    threads.emplace_back(
        [&] { count(50000, p.data(), nullptr, v.data(), T.data(), nullptr, nullptr, own.data()); });
  for (std::thread& thread : threads)
    thread.join();
  for (const auto& own : counts)
    EXPECT_EQ(own, (std::vector<unsigned long>{50000, 0, 0, 0, 0, 50000}));
}

TEST(LongOutsideTheRange, CGivesNaNBeyondAnErrorSideAndTheEdgeWithinRounding) {
  for (const bool direct : {false, true}) {
    const auto entry = sides_in_c(direct).find<Entry>("frictab_tau_R");
    const double at_end = entry(1000, 0, 500, 100, 0, 480);
    EXPECT_TRUE(std::isnan(entry(1000, 0, 500.01, 100, 0, 480)));
    EXPECT_TRUE(std::isnan(entry(1000, 0, inf, 100, 0, 480)));
    EXPECT_TRUE(std::isnan(entry(1000, 0, 50, 19.99, 0, 480)));
    EXPECT_EQ(entry(1000, 0, 500.0001, 100, 0, 480), at_end) << "what single precision misses";
    EXPECT_GT(at_end, 0);
  }
}

template <class Real> class Stopping : public testing::Test {
protected:
  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
    const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_vfric");
    const codegen::ExportRequest request{table, "mm-t-s", {}};
    codegen::BuildVariant variant = exporter.variants(request)[sizeof(Real) == 4 ? 1 : 0];
    test::keep_what_is_told(variant);
    test::add_flags(variant, test::run_checks);
    library = std::make_unique<Library>(
        codegen::compile_library(exporter.generate(request), variant, work.path()));
    told = &test::told(*library);
  }

  // At a pressure of 1000 MPa; temperature may leave its range below only by stopping.
  calls::VfricCall<Real> call(const std::vector<double>& speed,
                              const std::vector<double>& temperature) {
    calls::VfricCall<Real> c;
    c.temperatures = true;
    c.states = 4;
    c.time_increment = Real(0x1p-20);
    c.properties = {Real(100), Real(480)};
    c.resize(static_cast<int>(speed.size()), static_cast<int>(speed.size()));
    for (std::size_t k = 0; k < speed.size(); ++k) {
      c.normal[k] = Real(1000);
      c.slip[3 * k] = static_cast<Real>(speed[k]) * c.time_increment;
      c.temperature[k] = c.temperature_main[k] = static_cast<Real>(temperature[k]);
    }
    const test::FloatTraps traps;
    c.run(Library::address(library->handle(), "vfric_"));
    return c;
  }

  const Table table = test::sides_table();
  TemporaryDirectory work;
  std::unique_ptr<Library> library;
  test::Told* told = nullptr;
};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(Stopping, Precisions);

TYPED_TEST(Stopping, EndsTheAnalysisBeyondAnErrorSideAndNamesStateAndValue) {
  const auto c = this->call({50, 600}, {100, 100});
  EXPECT_EQ(this->told->calls, 1);
  EXPECT_EQ(this->told->kind, -3) << "the solver's code for: stop at once";
  const std::string said = this->told->said();
  EXPECT_NE(said.find("6.0000"), std::string::npos) << said;
  EXPECT_NE(said.find("E+02 is outside the range: v_rel_mm_s above 500"), std::string::npos)
      << said;
  EXPECT_FALSE(std::isnan(c.tangential[0]));
  EXPECT_TRUE(std::isnan(c.tangential[2])) << "where the solver's routine comes back";
}

TYPED_TEST(Stopping, NamesTheLowerSideToo) {
  this->call({50}, {10.5});
  const std::string said = this->told->said();
  EXPECT_NE(said.find("1.0500"), std::string::npos) << said;
  EXPECT_NE(said.find("T_contact_C below 20"), std::string::npos) << said;
}

TYPED_TEST(Stopping, NeverStopsInsideNorAtTheEndsNorBeyondSidesThatDoNotRefuse) {
  this->call({5, 500, 1, 50}, {20, 200, 100, 900});
  EXPECT_EQ(this->told->calls, 0);
}

TYPED_TEST(Stopping, CountsIncrementsOutsideTheRangePerNode) {
  auto c = this->call({50, 1, 50}, {100, 100, 250});
  const test::FloatTraps traps;
  for (int increment = 0; increment < 2; ++increment)
    c.run(Library::address(this->library->handle(), "vfric_"));
  EXPECT_EQ(c.state[3], 0);
  EXPECT_EQ(c.state[4 + 3], 3);
  EXPECT_EQ(c.state[8 + 3], 3);
}

} // namespace
} // namespace frictab::outside_agreement_test
