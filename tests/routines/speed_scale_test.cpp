// Simulations that run faster than their process: with the factor as a property the routine gives
// what it gives in a simulation at the process's own speed, bit for bit (the factor is 2^7).
#include <gtest/gtest.h>

#include "support/calls/usrfrc.h"
#include "support/calls/vfric.h"
#include "support/calls/vfric_coef.h"
#include "support/calls/vfriction.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/sample_tables.h"

namespace frictab::speed_scale_test {

namespace {

constexpr double factor = 128;

struct Routine {
  void* library = nullptr;
  void* function = nullptr;
  std::vector<double> properties; // the last is the factor, where there is one
  int states = 0;
};

// `scaled`: generated with the property.
Routine routine(const std::string& target, const std::string& entry, const table::Table& table,
                bool scaled) {
  codegen::ExportRequest request{table, "mm-t-s", {}, {}};
  if (scaled) request.options["speed_scale"] = "property";
  const codegen::Exporter& exporter = *codegen::find_exporter(target);
  const auto recipe = test::parse_json(exporter.generate(request).at("recipe.json"));
  Routine out;
  out.library =
      test::compiled(scaled ? "scaled" : "not scaled", exporter, request, "double", test::strict)
          ->handle();
  out.function = codegen::Library::address(out.library, entry + "_");
  out.properties.assign(recipe.at("properties").size(), 300);
  if (scaled) {
    EXPECT_EQ(recipe.at("properties").back().at("quantity"), "speed_scale");
    EXPECT_NE(recipe.at("input_deck")
                  .get<std::string>()
                  .find("<how many times faster than the process the simulation runs>"),
              std::string::npos);
    out.properties.back() = factor;
  }
  out.states = static_cast<int>(recipe.at("state_variables").size());
  return out;
}

class SpeedScale : public test::NeedsGfortran {
protected:
  // Forces and state variables of six increments of this length: `run(scaled, seconds)`. Equal at
  // the process's speed and with the property; not the same without it.
  template <class Run> static void expect_process(const Run& run) {
    constexpr double seconds = 0x1p-10;
    const std::vector<double> process = run(false, seconds);
    EXPECT_EQ(run(true, seconds / factor), process);
    EXPECT_NE(run(false, seconds / factor), process);
  }
};

template <class Call> void set_up(Call& c, const Routine& routine, double seconds) {
  c.time_increment = seconds;
  c.states = routine.states;
  c.temperatures = true;
  c.properties = routine.properties;
}

// Of one contact point that slides under 1000 MPa.
template <class Call> std::vector<double> six_increments(Call& c, const Routine& routine) {
  std::vector<double> out;
  c.normal[0] = 1000;
  c.temperature[0] = c.temperature_main[0] = 150;
  for (int i = 0; i < 6; ++i) {
    c.slip[0] = 0.01 * (1 + i);
    c.run(routine.function);
    out.push_back(c.tangential[0]);
    c.previous[0] = c.tangential[0];
  }
  out.insert(out.end(), c.state.begin(), c.state.end());
  return out;
}

template <class Call, class... Size>
std::vector<double> force_routine(const std::string& entry, bool scaled, double seconds,
                                  Size... size) {
  const Routine r = routine("abaqus_" + entry, entry, test::further_histories_table(), scaled);
  Call c;
  set_up(c, r, seconds);
  c.resize(size...);
  return six_increments(c, r);
}

TEST_F(SpeedScale, VfricWithThePropertyActsAsAtTheSpeedOfTheProcess) {
  expect_process([](bool scaled, double seconds) {
    return force_routine<calls::VfricCall<double>>("vfric", scaled, seconds, 1, 1);
  });
}

TEST_F(SpeedScale, VfrictionWithThePropertyActsAsAtTheSpeedOfTheProcess) {
  expect_process([](bool scaled, double seconds) {
    return force_routine<calls::VfrictionCall<double>>("vfriction", scaled, seconds, 1);
  });
}

TEST_F(SpeedScale, UsrfrcWithThePropertyActsAsAtTheSpeedOfTheProcess) {
  expect_process([&](bool scaled, double seconds) {
    const Routine r = routine("lsdyna_usrfrc", "usrfrc", test::further_histories_table(), scaled);
    // Temperatures are computed: other tests may share the library.
    *static_cast<std::int64_t*>(codegen::Library::address(r.library, "thropt_")) = 999;
    calls::UsrfrcCall<double, std::int64_t> c;
    c.rate = 1 / seconds;
    c.histories = r.states;
    c.constants = r.properties;
    c.resize(1);
    c.normal[0] = -1000;
    std::fill(c.temperature.begin(), c.temperature.end(), 150);
    std::vector<double> out;
    for (int i = 0; i < 6; ++i) {
      c.slip[0][0] = 0.01 * (1 + i);
      c.force[0][0] = 0;
      c.run(r.function);
      out.push_back(c.force[0][0]);
    }
    out.insert(out.end(), c.history.begin(), c.history.end());
    return out;
  });
}

TEST_F(SpeedScale, VfricCoefWithThePropertyActsAsAtTheSpeedOfTheProcess) {
  expect_process([&](bool scaled, double seconds) {
    const Routine r = routine("abaqus_vfric_coef", "vfric_coef", test::four_axis_table(), scaled);
    calls::VfricCoefCall<double> c;
    c.temperatures = true;
    c.properties = r.properties;
    c.resize(1);
    c.pressure[0] = 1000;
    c.temperature[0] = 150;
    c.slip_rate[0] = 0.01 / seconds;
    c.run(r.function);
    return std::vector<double>{c.coefficient[0]};
  });
}

codegen::SourceBundle generated(const codegen::Exporter& exporter, const table::Table& table,
                                bool scaled) {
  const test::SampleRequest sample(exporter, table, "mm-t-s");
  codegen::ExportRequest request = sample.get();
  if (scaled) request.options["speed_scale"] = "property";
  return exporter.generate(request);
}

TEST(SpeedScaleProperty, ChangesNoTargetThatDoesNotOfferIt) {
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    const table::Table table = test::four_axis_table();
    const bool same = generated(exporter, table, true) == generated(exporter, table, false);
    EXPECT_NE(same, exporter.offers("speed_scale")) << exporter.name;
  }
}

TEST(SpeedScaleProperty, IsTheOnlyOneListedWhereNoStateIsAProperty) {
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_vfric");
  const std::string source =
      generated(exporter, test::constant_table(), true).at("frictab_vfric.f");
  EXPECT_EQ(source.find("C     none\n"), std::string::npos);
  EXPECT_NE(source.find("C     1 how many times faster"), std::string::npos);
}

} // namespace

} // namespace frictab::speed_scale_test
