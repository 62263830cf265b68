// Histories that only some laws take - energy, times, means, peaks, friction power - in every
// routine with state variables: increment by increment what their definition says, in both
// precisions and unit systems, through iterations and cutbacks; and proof against small increments.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "routines/abaqus_routines.h"
#include "routines/deform_case.h"
#include "routines/fric_case.h"
#include "support/calls/usrbcc.h"
#include "support/calls/usrfrc.h"
#include "support/json.h"
#include "support/solver_scale.h"

namespace frictab::further_histories_test {

using codegen::find_exporter;
using codegen::Library;
using expr::Expr;
using table::Table;

namespace {

using test::further_histories_table;

// mu = 0.05 + 0.0001 history; the temperature now is not a state of it.
Table table_of(const char* history) {
  Table table = test::constant_table();
  table.value = {0.05};
  table.combine =
      Expr::symbol("sigma_n_MPa") * (Expr::symbol("value") + Expr(1e-4) * Expr::symbol(history));
  return table;
}

// What follows the load and the heat.
Table way_table() {
  Table table = test::constant_table();
  table.value = {0.05};
  const auto x = [](const char* name, double gain) { return Expr(gain) * Expr::symbol(name); };
  table.combine = Expr::symbol("sigma_n_MPa") *
                  (Expr::symbol("value") + x("load_ratio", 0.02) + x("load_direction", 0.01) +
                   x("slip_since_peak", 1e-3) + x("temperature_rise", 1e-4) +
                   x("temperature_lag", 5e-5) + x("flash_heating", 1e-5) +
                   x("aging_state_over_1p5mm", 1e-2) + x("slip_state_over_0p8mm", 1e-2));
  return table;
}

// Sliding at 2 mm/s for long has 0.75 s and 0.4 s.
Table slip_state_table() {
  Table table = test::constant_table();
  table.value = {0.05};
  table.combine = Expr::symbol("sigma_n_MPa") *
                  (Expr::symbol("value") + Expr(1e-2) * Expr::symbol("aging_state_over_1p5mm") +
                   Expr(1e-2) * Expr::symbol("slip_state_over_0p8mm"));
  return table;
}

struct Increment {
  double pressure, speed, time, temperature; // MPa, mm/s, s, degC
};
const std::vector<Increment> path = {{500, 2, 0.5, 20},  {800, 3, 0.25, 80},  {300, 9, 0.5, -10},
                                     {0, 5, 1, 300},     {900, 6, 0.125, 60}, {400, 1, 2, 90},
                                     {449, 1, 0.5, -40}, {451, 1, 0.5, 95}};

// The definition: integrals end before the increment, peaks include it.
class Definition {
public:
  explicit Definition(const std::string& table = "further")
      : table_(table == "way" ? way_table() : further_histories_table()) {}

  double tau(const Increment& now) const {
    const table::TableFunction function(table_);
    const auto mean = [&](double sum, double value) { return time > 0 ? sum / time : value; };
    const std::map<std::string, double> values = {
        {"sigma_n_MPa", now.pressure},
        {"energy", energy},
        {"friction_power", power},
        {"time_since_start", time},
        {"dwell", dwell},
        {"mean_sigma_n", mean(pressures, now.pressure)},
        {"mean_v_rel", mean(slip, now.speed)},
        {"mean_T_contact", mean(warmth, now.temperature)},
        {"peak_v_rel", std::max(peak_speed, now.speed)},
        {"peak_T_contact", std::max(peak_temperature, now.temperature)},
        {"load_ratio", now.pressure / std::max(peak_pressure, now.pressure)},
        {"load_direction", turned(now.pressure).first ? 1 : 0},
        {"slip_since_peak", since_peak},
        {"temperature_rise", time > 0 ? now.temperature - first_temperature : 0},
        {"temperature_lag", now.temperature - mean(warmth, now.temperature)},
        {"flash_heating", flash},
        {"aging_state_over_1p5mm", aged > 0 ? aged : 1.5 / now.speed},
        {"slip_state_over_0p8mm", slipped > 0 ? slipped : 0.8 / now.speed}};
    std::vector<double> state;
    for (const std::string& name : table_.inputs())
      state.push_back(values.at(name));
    return now.pressure > 0 ? function(state) : 0;
  }

  void keep(const Increment& now) {
    if (!(now.pressure > 0)) return; // out of contact nothing is remembered
    const double before = tau(now);
    peak_pressure = std::max(peak_pressure, now.pressure);
    std::tie(rises, extreme) = turned(now.pressure);
    energy += now.pressure * now.speed * now.time;
    power = before * now.speed;
    flash = before * std::sqrt(now.speed);
    since_peak = now.pressure >= 0.95 * peak_pressure ? 0 : since_peak + now.speed * now.time;
    const double a = 1.5 / now.speed, s = 0.8 / now.speed; // steady states at this speed
    aged = a + (aged > 0 ? aged - a : 0) * std::exp(-now.time / a);
    slipped = s * std::pow(slipped > 0 ? slipped / s : 1, std::exp(-now.time / s));
    if (time == 0) first_temperature = now.temperature;
    if (now.pressure >= 0.5 * peak_pressure) dwell += now.time;
    time += now.time;
    pressures += now.pressure * now.time;
    slip += now.speed * now.time;
    warmth += now.temperature * now.time;
    peak_speed = std::max(peak_speed, now.speed);
    peak_temperature = std::max(peak_temperature, now.temperature);
  }

  // Whether the load rises at this pressure, and the extreme since it turned.
  std::pair<bool, double> turned(double pressure) const {
    if (rises && pressure < 0.95 * extreme) return {false, pressure};
    if (!rises && 0.95 * pressure > extreme) return {true, pressure};
    return {rises, rises ? std::max(extreme, pressure) : std::min(extreme, pressure)};
  }

  bool rises = true;
  double extreme = 0; // MPa
  double energy = 0, power = 0, time = 0, dwell = 0, pressures = 0, slip = 0, warmth = 0;
  double peak_speed = 0, peak_temperature = -273.15, peak_pressure = 0;
  double since_peak = 0, first_temperature = 0, flash = 0, aged = 0, slipped = 0;

private:
  Table table_;
};

// The solver's units; which table, and where its temperature comes from.
struct Units : test::SolverScale {
  Units(const test::SolverScale& scale = test::SolverScale("mm-t-s")) : SolverScale(scale) {}
  std::string table = "further";
  std::string temperature_from = {};
};

const Library& compiled(const std::string& target, const Units& units, const std::string& variant) {
  static const std::map<std::string, Table> tables = {{"further", further_histories_table()},
                                                      {"way", way_table()},
                                                      {"state", slip_state_table()},
                                                      {"mean", table_of("mean_T_contact")},
                                                      {"peak", table_of("peak_T_contact")}};
  std::map<std::string, std::string> inputs;
  if (!units.temperature_from.empty()) inputs["T_contact_C"] = units.temperature_from;
  return *test::compiled(units.table + units.name + units.temperature_from, *find_exporter(target),
                         {tables.at(units.table), units.units, inputs}, variant, test::strict);
}

// One contact point of a target: tau_R (MPa) of the next increment. An edge has four columns of
// states, which the law takes the mean of.
template <class Case> struct ForcePoint {
  using Real = typename Case::Real;
  static constexpr const char* target = Case::pairs ? "abaqus_vfric" : "abaqus_vfriction";
  explicit ForcePoint(const Units& u) : units(u) {
    c = Case::call(1, [](auto& plain) {
      plain.states = 6 + 2 * 9;
      plain.properties.clear();
      if constexpr (requires { plain.edges; }) plain.edges = true;
    });
    c.area[0] = 4;
  }
  double step(const Increment& now) {
    c.time_increment = static_cast<Real>(now.time * units.time);
    c.normal[0] = static_cast<Real>(4 * now.pressure * units.stress);
    c.slip[0] = static_cast<Real>(now.speed * now.time * units.length);
    c.temperature[0] = c.temperature_main[0] =
        static_cast<Real>(units.temperature(now.temperature));
    const Library& library = compiled(target, units, Case::single ? "single" : "double");
    const test::FloatTraps traps;
    c.run(Library::address(library.handle(), Case::pairs ? "vfric_" : "vfriction_"));
    c.previous[0] = c.tangential[0];
    return -static_cast<double>(c.tangential[0]) / 4 / units.stress;
  }
  Units units;
  typename Case::Call c;
};
template <class Real> using Vfric = ForcePoint<test::VfricCase<Real>>;
template <class Real> using Vfriction = ForcePoint<test::VfrictionCase<Real>>;

template <class Real> struct Usrfrc {
  static constexpr const char* target = "lsdyna_usrfrc";
  using Int = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;
  explicit Usrfrc(const Units& u) : units(u) {
    c.histories = 6 + 2 * 9;
    c.constants = {Real(0)};
    c.resize(1);
  }
  double step(const Increment& now) {
    const Library& library = compiled(target, units, sizeof(Real) == 4 ? "single" : "double");
    *static_cast<Int*>(Library::address(library.handle(), "thropt_")) = 999;
    c.rate = static_cast<Real>(1 / (now.time * units.time));
    c.normal[0] = -static_cast<Real>(now.pressure * units.stress);
    c.slip[1][0] = static_cast<Real>(now.speed * now.time * units.length);
    std::fill(c.temperature.begin(), c.temperature.end(),
              static_cast<Real>(units.temperature(now.temperature)));
    c.force[0][0] = 0;
    c.before[2] = Real(0x1p60);
    c.before[3] = c.before[4] = 0;
    const test::FloatTraps traps;
    c.run(Library::address(library.handle(), "usrfrc_"));
    return static_cast<double>(c.force[0][0]) / units.stress;
  }
  Units units;
  calls::UsrfrcCall<Real, Int> c;
};

// Each increment takes five iterations, of which the last one counts, after one that is cut back.
template <class Call> double iterated(Call& c, const Increment& now, auto&& set, auto&& run) {
  ++c.increment;
  for (const double off : {7.0, 0.5, 1.5, 0.9, 1.0}) {
    set(Increment{now.pressure * off, now.speed * off, off == 7.0 ? 4 * now.time : now.time,
                  now.temperature + 30 * (off - 1)});
    const test::FloatTraps traps;
    run();
  }
  return 0;
}

struct Fric {
  static constexpr const char* target = "abaqus_fric";
  static constexpr double critical = 0x1p-40;
  explicit Fric(const Units& u) : units(u) {
    c.states = 2 * (7 + 9) + 1;
    c.properties = {critical};
    c.directions = 1;
    c.increment = 0;
    c.resize();
  }
  double step(const Increment& now) {
    void* function = Library::address(compiled(target, units, "double").handle(), "fric_");
    iterated(
        c, now,
        [&](const Increment& tried) {
          c.mode = 0;
          c.pressure = tried.pressure * units.stress;
          c.time_increment = tried.time * units.time;
          c.motion[0] = tried.speed * tried.time * units.length;
          c.temperature[0] = c.temperature[1] = units.temperature(tried.temperature);
        },
        [&] { c.run(function); });
    return c.tau[0] / units.stress;
  }
  Units units;
  calls::FricCall c;
};

struct FricCoef {
  static constexpr const char* target = "abaqus_fric_coef";
  explicit FricCoef(const Units& u) : units(u) {
    c.states = 2 * (5 + 9) + 1;
    c.temperatures = true;
    c.properties = {0};
    c.increment = 0;
    c.resize(1);
  }
  double step(const Increment& now) {
    void* function = Library::address(compiled(target, units, "double").handle(), "fric_coef_");
    const double slipped = slip;
    iterated(
        c, now,
        [&](const Increment& tried) {
          c.pressure[0] = tried.pressure * units.stress;
          c.time_increment = tried.time * units.time;
          slip = slipped + tried.speed * tried.time * units.length;
          c.slip[0] = tried.speed * units.speed;
          c.slip[3] = slip;
          c.temperature[0] = units.temperature(tried.temperature);
        },
        [&] { c.run(function); });
    return c.coefficient[0] * now.pressure;
  }
  Units units;
  calls::CoefCall c;
  double slip = 0;
};

// The step that FTUPD keeps is the one that USRBCC was asked in.
struct Usrbcc {
  static constexpr const char* target = "deform_usrbcc";
  explicit Usrbcc(const Units& u) : units(u) {
    c.user_variables = 3 + 9;
    c.nodal.assign(24, 0.0);
  }
  double step(const Increment& now) {
    const Library& library = compiled(target, units, "double");
    *library.find<calls::Ufhcom>("ufhcom_") = {20, 20, -now.speed * units.speed,
                                               -now.pressure * units.stress};
    c.temperature[0] = units.temperature(now.temperature - 5);
    c.temperature[1] = units.temperature(now.temperature + 5);
    auto* node = library.find<test::Nodcom>("nodcom_");
    auto* contact = library.find<test::Nodcom2>("nodcom2_");
    const test::FloatTraps traps;
    c.run(Library::address(library.handle(), "usrbcc_"));
    const double tau = c.variable * now.pressure;
    *node = {};
    node->node = 5;
    node->temperature = units.temperature(now.temperature);
    std::copy(c.nodal.begin(), c.nodal.begin() + 12, node->before);
    *contact = {
        1, 20, -now.speed * units.speed, {tau * units.stress, -now.pressure * units.stress}, 0};
    library.find<int>("usrctl_")[1] = 1;
    *library.find<double>("sstu_") = now.time * units.time;
    library.find<void()>("ftupd_")();
    for (int i = 0; i < 24; ++i)
      c.nodal[static_cast<std::size_t>(i)] = node->after[i % 12];
    return tau;
  }
  Units units;
  calls::UsrbccCall c;
};

template <class Point> double bound() {
  return 1e-12;
}
template <> double bound<Fric>() {
  return 1e-10; // the elastic slip of the first increment
}
// Single: states, slip and force are rounded to 24 bits at each of eight increments.
template <> double bound<Vfric<float>>() {
  return 2e-5;
}
template <> double bound<Vfriction<float>>() {
  return 2e-5;
}
template <> double bound<Usrfrc<float>>() {
  return 2e-5;
}

template <class Point> class LongFurtherHistories : public test::NeedsGfortran {};

using Points = testing::Types<Vfric<double>, Vfric<float>, Vfriction<double>, Vfriction<float>,
                              Usrfrc<double>, Usrfrc<float>, Fric, FricCoef, Usrbcc>;
struct PointName {
  template <class Point> static std::string GetName(int) {
    return std::string(Point::target) + (bound<Point>() == 2e-5 ? "_single" : "_double");
  }
};
TYPED_TEST_SUITE(LongFurtherHistories, Points, PointName);

TYPED_TEST(LongFurtherHistories, FollowAPathOfIncrementsAsTheDefinitionSays) {
  for (const std::string table : {"further", "way"})
    for (Units units : test::every_system()) {
      SCOPED_TRACE(table + " " + units.name);
      units.table = table;
      TypeParam point(units);
      Definition wanted(table);
      for (const Increment& now : path) {
        const double tau = wanted.tau(now);
        EXPECT_NEAR(point.step(now), tau, tau * bound<TypeParam>());
        wanted.keep(now);
      }
      EXPECT_GT(wanted.energy, 0);
      EXPECT_LT(wanted.dwell, wanted.time) << "not all of the path is dwell";
      EXPECT_GT(wanted.since_peak, 0);
    }
}

TYPED_TEST(LongFurtherHistories, SlipStatesStartWithTheFirstIncrementThatSlides) {
  Units units;
  units.table = "state";
  TypeParam point(units);
  point.step({500, 0, 2, 20});
  point.step({800, 0, 0.5, 20});
  const double steady = 0.05 + 1e-2 * (0.75 + 0.4);
  EXPECT_NEAR(point.step({500, 2, 0.5, 20}), 500 * steady, 31 * bound<TypeParam>());
  point.step({500, 0, 3, 20}); // and age from then on
  const double rested = 0.05 + 1e-2 * (0.75 + 3 + 0.4);
  EXPECT_NEAR(point.step({500, 2, 0.5, 20}), 500 * rested, 46 * bound<TypeParam>());
}

TYPED_TEST(LongFurtherHistories, KeepNothingOfAnIncrementWhoseTemperatureIsNaN) {
  Units units;
  units.table = "mean";
  TypeParam point(units);
  const double bound = std::max(1e-10, further_histories_test::bound<TypeParam>());
  EXPECT_NEAR(point.step({500, 2, 0.5, 80}), 500 * 0.058, 29 * bound);
  TypeParam spoilt = point;
  EXPECT_TRUE(std::isnan(spoilt.step({500, 2, 0.5, test::nan})));
  if (std::string(TypeParam::target) != "deform_usrbcc") { // whose USRUPD runs once it converged
    EXPECT_NEAR(spoilt.step({500, 2, 0.5, 20}), 500 * 0.058, 29 * bound);
  }
  EXPECT_NEAR(point.step({500, 2, 0.5, 20}), 500 * 0.058, 29 * bound);
  EXPECT_NEAR(point.step({500, 2, 0.5, 20}), 500 * 0.055, 29 * bound);
}

TYPED_TEST(LongFurtherHistories, AreNumbersAfterAnInfinitePressureOrALongRest) {
  TypeParam point{Units()};
  point.step({500, 0, 0.5, 80});
  point.step({1e30, 0, 1e-30, 80});
  point.step({1e30, 2, 0.5, 80});
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(std::isnan(point.step({500, 2, 0.5, 80})));
}

TYPED_TEST(LongFurtherHistories, AreToldInTheRecipeWithTheirNumbers) {
  static const Table table = further_histories_table();
  const auto recipe = test::parse_json(
      find_exporter(TypeParam::target)->generate({table, "m-kg-s", {}}).at("recipe.json"));
  const auto& states = recipe.at("state_variables");
  std::map<std::string, std::string> unit_of;
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_EQ(states[i].at("number"), i + 1);
    unit_of[states[i].at("meaning")] = states[i].at("unit");
  }
  EXPECT_EQ(unit_of.at("pressure times slip, summed"), "Pa m");
  EXPECT_EQ(unit_of.at("friction power per area in the last increment under pressure"), "Pa m/s");
  EXPECT_EQ(unit_of.at("pressure times time under pressure"), "Pa s");
  EXPECT_EQ(unit_of.at("sliding speed times time under pressure"), "m");
  EXPECT_EQ(unit_of.at("peak temperature; 0: none yet"), "K");
  for (const auto& argument : recipe.at("arguments"))
    if (argument.at("quantity") == "energy") {
      EXPECT_THAT(argument.at("source").template get<std::string>(),
                  testing::HasSubstr("integral of sigma_N ds"));
    }
}

TEST(FurtherHistoriesOfVfric, DoNotStandStillInSinglePrecision) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  Vfric<float> point{Units()};
  const int increments = 200000;
  for (int i = 0; i < increments; ++i)
    point.step({1000, 100, 0x1p-24, 60}); // 6e-8 s: lost at 1 s without what is rounded off
  const double time = increments * 0x1p-24;
  point.step({1000, 100, 1, 60});
  for (int i = 0; i < increments; ++i)
    point.step({1000, 100, 0x1p-24, 60});
  bool found = false;
  for (const float state : point.c.state)
    found = found || std::abs(state - (1 + 2 * time)) < 1e-6;
  EXPECT_TRUE(found) << "time under pressure";
}

TEST(FurtherHistoriesOfFric, HaveTheDerivativesOfTheStress) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const auto systems = test::every_system();
  std::vector<Units> all(systems.begin(), systems.end());
  for (Units units : test::every_system()) {
    units.table = "way";
    all.push_back(units);
  }
  for (const Units& units : all) {
    SCOPED_TRACE(units.table + " " + units.name);
    Fric point(units);
    for (const Increment& now : path) {
      if (now.pressure > 0) {
        Fric at = point;
        ++at.c.increment;
        at.c.mode = 0;
        at.c.pressure = now.pressure * units.stress;
        at.c.time_increment = 1e-3 * units.time;
        at.c.motion[0] = now.speed * 1e-3 * units.length;
        at.c.temperature[0] = at.c.temperature[1] = units.temperature(now.temperature);
        test::expect_tangents(
            at.c, Library::address(compiled("abaqus_fric", units, "double").handle(), "fric_"),
            "path");
      }
      point.step(now);
    }
  }
}

TEST(FurtherHistoriesOfFric, AreNothingSoFarWithFewerStateVariables) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  Fric point{Units()};
  point.c.states = 15;
  point.c.resize();
  const Definition nothing;
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(point.step(path[1]), nothing.tau(path[1]), 1e-10 * nothing.tau(path[1]));
  EXPECT_THAT(point.c.state, testing::Each(0));
}

TEST(FurtherHistoriesOfFric, CountTheStressThatASticksPointHas) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  Fric point{Units()};
  point.c.properties = {1}; // mm: all of the motion is elastic
  const double tau = point.step({800, 0.02, 0.5, 60});
  EXPECT_GT(tau, 0);
  EXPECT_LT(tau, 0.02 * Definition().tau({800, 0.02, 0.5, 60}));
  const auto power = std::find_if(point.c.state.begin(), point.c.state.begin() + 16,
                                  [&](double s) { return std::abs(s - tau * 0.02) < 1e-12; });
  EXPECT_NE(power, point.c.state.begin() + 16);
}

TEST(FurtherHistoriesOfDeform, TakeTheTemperatureThatTheJobSays) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  Units units;
  units.table = "mean";
  units.temperature_from = "constant:90";
  Usrbcc fixed(units);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(fixed.step({500, 2, 0.5, 20}), 500 * 0.059, 1e-10);
  units.temperature_from = "field:9";
  Usrbcc field(units);
  field.c.nodal[8] = field.c.nodal[12 + 8] = 150;
  EXPECT_NEAR(field.step({500, 2, 0.5, 20}), 500 * 0.065, 1e-10);
  field.c.nodal[8] = field.c.nodal[12 + 8] = 20; // USRUPD writes it, now the mean counts
  EXPECT_NEAR(field.step({500, 2, 0.5, 20}), 500 * 0.065, 1e-10);
}

TEST(FurtherHistoriesOfDeform, DoNotForgetAPeakBesideANodeThatWasNeverInContact) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  Units units;
  units.table = "peak";
  Usrbcc point(units);
  point.step({500, 2, 0.5, 200});
  std::fill(point.c.nodal.begin() + 12, point.c.nodal.end(), 0.0);
  EXPECT_NEAR(point.step({500, 2, 0.5, 30}), 500 * (0.05 + 1e-4 * 0.5 * (200 + 30)), 1e-10);
}

TEST(FurtherHistoriesOfDeform, KeepAFieldFromTheirPlaces) {
  Table table = further_histories_table();
  table.combine = table.combine * Expr::symbol("humidity_pct");
  table.record.inputs["humidity_pct"] = {.low = 30, .high = 60};
  EXPECT_THAT(
      [&] {
        find_exporter("deform_usrbcc")->generate({table, "mm-t-s", {{"humidity_pct", "field:12"}}});
      },
      testing::ThrowsMessage<std::exception>(testing::HasSubstr("field:13 or higher")));
  EXPECT_NO_THROW(
      find_exporter("deform_usrbcc")->generate({table, "mm-t-s", {{"humidity_pct", "field:13"}}}));
}

TEST(FurtherHistoriesOfMarc, AreConstantsThatTheSourceNames) {
  static const Table table = further_histories_table();
  const std::string source =
      find_exporter("marc_ufric")->generate({table, "mm-t-s", {}}).at("frictab_ufric.f");
  EXPECT_THAT(source, testing::HasSubstr("dwell: constant 550"));
  EXPECT_THAT(source, testing::Not(testing::HasSubstr("ftpast")));
}

} // namespace
} // namespace frictab::further_histories_test
