// The routines of Abaqus that answer for a block of contact points, each called through its own
// argument list: what their tests have in common.
#pragma once

#include <cmath>
#include <string>
#include <thread>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "routines/standard_case.h"
#include "support/calls/fric_coef.h"
#include "support/calls/vfric.h"
#include "support/calls/vfric_coef.h"
#include "support/calls/vfriction.h"
#include "support/generated.h"

namespace frictab::test {

inline double branching_tau(double pressure, double speed, double slip) {
  static const table::TableFunction table(branching_table());
  const double state[] = {pressure, speed, slip, flow};
  return table(state);
}

// Four threads that call at once get what one call alone gets. `function` is not compiled with
// -fcheck=recursion, whose own flag all threads share.
template <class Call, class Outputs>
void expect_the_same_in_threads(const Call& reference, void* function, const Outputs& outputs) {
  Call serial = reference;
  serial.run(function);
  std::vector<Call> calls(4, reference);
  std::vector<std::thread> threads;
  for (Call& c : calls)
    threads.emplace_back([&c, &reference, function] {
      for (int i = 0; i < 200; ++i) {
        c = reference;
        c.run(function);
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  for (const Call& c : calls)
    EXPECT_EQ(outputs(c), outputs(serial));
}

// Plain calls give 1000 MPa, 50 mm/s and 100 degC at every point, with the properties of the
// four-axis table: psi, a temperature for models without one, the flow stress.
template <class Real> struct RoutineCase {
  static constexpr bool single = sizeof(Real) == 4;
  // Double: the order of operations only. Single: see agreement_test.cpp.
  static constexpr double bound = single ? 2e-5 : 1e-13;
  static constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();

  std::string entry; // "vfric"
  std::map<std::string, std::string> options = {};

  void* routine(const std::string& key, const table::Table& table,
                const std::map<std::string, std::string>& inputs = {},
                const codegen::SolverUnits& units = {},
                const std::vector<std::string>& flags = strict) const {
    std::string name = key;
    for (const auto& [option, choice] : options)
      name += choice;
    return codegen::Library::address(compiled(name, *codegen::find_exporter("abaqus_" + entry),
                                              {table, units, inputs, options},
                                              single ? "single" : "double", flags)
                                         ->handle(),
                                     (entry + "_").c_str());
  }
  static double tau(double pressure, double speed, double temperature) {
    return four_axis_tau(pressure, speed, temperature);
  }
  void* four_axes() const { return routine("four_axes", four_axis()); }
  void* branching() const { return routine("branching", branching_table()); }
};

// VFRIC and VFRICTION.
template <template <class> class CallOf, class Number> struct ForceCase : RoutineCase<Number> {
  using Real = Number;
  using Call = CallOf<Real>;
  using Base = RoutineCase<Real>;
  static constexpr bool pairs = std::is_same_v<Call, calls::VfricCall<Real>>;
  static constexpr bool gives_coefficient = false;

  ForceCase() : Base{pairs ? "vfric" : "vfriction"} {}

  // `change` is made before the arrays get their sizes.
  template <class Change> static Call call(int points, const Change& change) {
    Call c;
    c.temperatures = true;
    c.time_increment = Real(0x1p-20);
    c.properties = {Real(psi), Real(60), Real(flow)};
    change(c);
    resize(c, points);
    return c;
  }
  static Call call(int points) {
    return call(points, [](Call&) {});
  }
  static void resize(Call& c, int points) {
    if constexpr (pairs)
      c.resize(points, points);
    else
      c.resize(points);
    for (std::size_t k = 0; k < c.normal.size(); ++k)
      set(c, k, 1000, 50, 100);
  }
  static void set(Call& c, std::size_t k, double pressure, double speed, double temperature) {
    std::size_t at = k;
    if constexpr (pairs) at = static_cast<std::size_t>(c.node[k]) - 1;
    c.normal[k] = static_cast<Real>(pressure) * c.area[at];
    c.slip[k * static_cast<std::size_t>(c.directions)] =
        static_cast<Real>(speed) * c.time_increment;
    c.temperature[k] = static_cast<Real>(temperature);
    if (!c.rigid) c.temperature_main[k] = static_cast<Real>(temperature);
  }
  static void run(Call& c, void* function) {
    std::fill(c.tangential.begin(), c.tangential.end(), Real(777));
    const FloatTraps traps;
    c.run(function);
  }
  static double answer(const Call& c, std::size_t k = 0) {
    return c.tangential[k * static_cast<std::size_t>(c.directions - 1)];
  }
  static double stress(const Call& c, std::size_t k = 0) { return -answer(c, k); } // on 1 mm2

  static auto outputs(const Call& c) { return std::tie(c.tangential, c.state); }
  static void forget_temperatures(Call& c) {
    c.temperatures = false;
    std::fill(c.temperature.begin(), c.temperature.end(), Base::not_a_number);
    std::fill(c.temperature_main.begin(), c.temperature_main.end(), Base::not_a_number);
  }
  // What spoils point 1 of a call, by the argument's name; global ones spoil all.
  static auto spoils() {
    using Spoil = void (*)(Call&);
    static constexpr Real bad = Base::not_a_number;
    return std::vector<std::pair<std::string, Spoil>>{
        {"normal", [](Call& c) { c.normal[1] = bad; }},
        {"area", [](Call& c) { c.area[1] = bad; }},
        {"stick", [](Call& c) { c.stick[1] = bad; }},
        {"slip", [](Call& c) { c.slip[4] = bad; }},
        {"temperature", [](Call& c) { c.temperature[1] = bad; }},
        {"main temperature", [](Call& c) { c.temperature_main[1] = bad; }},
        {"global: time", [](Call& c) { c.time_increment = bad; }},
        {"global: props", [](Call& c) { c.properties[2] = bad; }}};
  }
  static void expect_kept(const Call& c, const std::string& name) { // point 1
    EXPECT_EQ(c.tangential[3], 0) << name;
    const auto states = static_cast<std::size_t>(c.states);
    for (std::size_t i = 0; i < states; ++i)
      EXPECT_EQ(c.state[states + i], 0) << name;
  }
  // Two points, the first `count` of the fields temperature and psi: 60 and 4, 100 and 7.
  static Call call_with_fields(int count) {
    Call c = call(2, [count](Call& plain) {
      plain.properties.clear();
      fields_of(plain) = count;
    });
    for (std::size_t k = 0; k < 2; ++k)
      set(c, k, 1000, 50, 0);
    c.field = {80, 90}, c.field_main = {40, 110};
    if (count == 2 && pairs) c.field = {80, 90, 3, 5}, c.field_main = {40, 110, 5, 9};
    if (count == 2 && !pairs) c.field = {80, 3, 90, 5}, c.field_main = {40, 5, 110, 9};
    return c;
  }
  static int& fields_of(Call& c) {
    if constexpr (pairs)
      return c.predefined;
    else
      return c.fields;
  }
};

template <class Real> using VfricCase = ForceCase<calls::VfricCall, Real>;
template <class Real> using VfrictionCase = ForceCase<calls::VfrictionCall, Real>;
using ForceCases = testing::Types<VfricCase<double>, VfricCase<float>, VfrictionCase<double>,
                                  VfrictionCase<float>>;

// VFRIC_COEF and FRIC_COEF.
template <class CallType>
struct CoefficientCase
    : RoutineCase<typename std::remove_cvref_t<decltype(CallType{}.pressure)>::value_type> {
  using Call = CallType;
  using Real = typename std::remove_cvref_t<decltype(Call{}.pressure)>::value_type;
  using Base = RoutineCase<Real>;
  static constexpr bool is_explicit = !std::is_same_v<Call, calls::CoefCall>;
  static constexpr bool gives_coefficient = true;

  explicit CoefficientCase(const std::string& release = "2024")
      : Base{is_explicit ? "vfric_coef" : "fric_coef"} {
    if (!is_explicit) this->options = {{"abaqus_release", release}};
  }

  bool is_newer() const { return !is_explicit && this->options.at("abaqus_release") == "2024"; }
  Call call(int points, int fields = 0) const {
    Call c;
    if constexpr (!is_explicit) c.release_2024 = is_newer();
    c.temperatures = true;
    c.properties = {Real(psi), Real(60), Real(flow)};
    c.fields = fields;
    c.resize(points);
    for (std::size_t k = 0; k < static_cast<std::size_t>(points); ++k)
      set(c, k, 1000, 50, 100);
    return c;
  }
  static std::vector<Real>& speed(Call& c) {
    if constexpr (is_explicit)
      return c.slip_rate;
    else
      return c.slip;
  }
  static void set(Call& c, std::size_t k, double pressure, double velocity, double temperature) {
    c.pressure[k] = static_cast<Real>(pressure);
    speed(c)[k] = static_cast<Real>(velocity);
    c.temperature[k] = static_cast<Real>(temperature);
  }
  static void run(Call& c, void* function) {
    std::fill(c.coefficient.begin(), c.coefficient.end(), Real(777));
    std::fill(c.derivative.begin(), c.derivative.end(), Real(777));
    const FloatTraps traps;
    c.run(function);
  }
  static double answer(const Call& c, std::size_t k = 0) { return c.coefficient[k]; }
  static double stress(const Call& c, std::size_t k = 0) {
    return answer(c, k) * double(c.pressure[k]);
  }
  // i from 1: slip rate, pressure, temperature, and with the newer list equivalent slip as 6.
  static double by(const Call& c, std::size_t i, std::size_t k = 0) {
    return c.derivative[(i - 1) * static_cast<std::size_t>(c.points) + k];
  }

  static auto outputs(const Call& c) { return std::tie(c.coefficient, c.derivative); }
  static void forget_temperatures(Call& c) {
    c.temperatures = false;
    std::fill(c.temperature.begin(), c.temperature.end(), Base::not_a_number);
  }
  static auto spoils() {
    using Spoil = void (*)(Call&);
    static constexpr Real bad = Base::not_a_number;
    return std::vector<std::pair<std::string, Spoil>>{
        {"pressure", [](Call& c) { c.pressure[1] = bad; }},
        {"slip rate", [](Call& c) { speed(c)[1] = bad; }},
        {"tempAvg", [](Call& c) { c.temperature[1] = bad; }},
        {"global: props", [](Call& c) { c.properties[2] = bad; }}};
  }
  static void expect_kept(const Call& c, const std::string& name) {
    for (std::size_t i = 1; i <= 3; ++i)
      EXPECT_EQ(by(c, i, 1), 0) << name;
  }
  Call call_with_fields(int count) const {
    Call c = call(2, count);
    c.properties.clear();
    for (std::size_t k = 0; k < 2; ++k)
      set(c, k, 1000, 50, nan);
    c.field = {60, 100};
    if (count == 2) c.field = {60, 100, 4, 7};
    return c;
  }
};

// "vfric_single", "fric_coef_2020_double".
struct RoutineName {
  template <class Case> static std::string GetName(int) {
    std::string name = Case().entry;
    for (const auto& [option, choice] : Case().options)
      name += "_" + choice;
    return name + (Case::single ? "_single" : "_double");
  }
};

// Fields where the deck has them, the constant of the job, the middle of an axis where there is no
// such field.
template <class Routine> void expect_states_from_fields_and_constants(const Routine& r) {
  void* const function =
      r.routine("fields", four_axis(),
                {{"psi", "field:2"}, {"sigma_f_MPa", "constant:300"}, {"T_contact_C", "field:1"}});
  auto both = r.call_with_fields(2);
  r.run(both, function);
  EXPECT_CLOSE(r.stress(both, 0), four_axis_tau(1000, 50, 60, 4, 300), Routine::bound);
  EXPECT_CLOSE(r.stress(both, 1), four_axis_tau(1000, 50, 100, 7, 300), Routine::bound);
  auto one = r.call_with_fields(1);
  r.run(one, function);
  EXPECT_CLOSE(r.stress(one), four_axis_tau(1000, 50, 60, std::sqrt(20.0), 300), Routine::bound);
}

} // namespace frictab::test
