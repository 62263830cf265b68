// Rows of every test, then files of them.
#include "support/rig.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/random.h"

namespace frictab::test {

namespace {

constexpr std::size_t tests = 16, sliding_rows = 80, rest_rows = 15, stroke_rows = 20;
constexpr double step_s = 0.1, area_mm2 = 20, radius_mm = 15;

struct Row {
  double t, load, friction, speed, position, temperature;
};

struct Test {
  std::string name;
  std::vector<Row> rows;
};

std::vector<Row> sliding(std::uint64_t seed, std::size_t test) {
  Random random(seed, 1000 + test);
  const double pressure = 10 * std::pow(2.2, double(test % 4)),
               speed = 5 * std::pow(4, double(test % 3));
  const double start_C = 25 + 35 * double(test / 4 % 3), gain = 0.03 * random.normal();
  std::vector<Row> rows;
  double slow = 0;
  for (std::size_t i = 0; i < sliding_rows; ++i) {
    slow = 0.9 * slow + 0.006 * random.normal();
    const double p = pressure * (1 + 0.01 * random.normal());
    const double mu = 0.12 * std::pow(p / 50, -0.15) * std::pow(speed / 20, -0.06) *
                      std::exp(gain + slow + 0.008 * random.normal());
    const double t = step_s * double(i);
    rows.push_back({t, p * area_mm2, mu * p * area_mm2, speed, speed * t, start_C + 0.3 * t});
  }
  return rows;
}

// The load is on, and the force builds up to half of what sliding takes.
void rest_before(std::vector<Row>& rows) {
  const Row first = rows.front();
  std::vector<Row> all;
  for (std::size_t i = 0; i < rest_rows; ++i)
    all.push_back({step_s * double(i), first.load, 0.5 * first.friction * double(i) / rest_rows, 0,
                   0, first.temperature});
  for (Row row : rows) {
    row.t += step_s * rest_rows;
    all.push_back(row);
  }
  rows = std::move(all);
}

// Strokes of equal length, two seconds each.
void go_back_and_forth(std::vector<Row>& rows, double offset) {
  double position = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double sense = i / stroke_rows % 2 == 0 ? 1 : -1;
    if (i > 0) position += sense * rows[i].speed * step_s;
    rows[i].position = position;
    rows[i].friction = sense * rows[i].friction + offset * rows[i].friction;
  }
}

std::vector<Test> tests_of(std::uint64_t seed, Habit habit) {
  std::vector<Test> all;
  for (std::size_t t = 0; t < tests; ++t) {
    Test test{fmt::format("S{:02}", t + 1), sliding(seed, t)};
    if (habit == Habit::rest) rest_before(test.rows);
    if (habit == Habit::reversals) go_back_and_forth(test.rows, 0);
    if (habit == Habit::spikes && t == 6) test.rows[37].friction *= 30;
    if (habit == Habit::kelvin && t == 9)
      for (Row& row : test.rows)
        row.temperature += 273.15;
    all.push_back(std::move(test));
  }
  if (habit == Habit::offset) { // one zero of the cell, in N, for all tests
    for (Test& test : all) {
      go_back_and_forth(test.rows, 0);
      for (Row& row : test.rows)
        row.friction += 1.5;
    }
  }
  if (habit == Habit::copied_test) all.push_back({"S17", all[4].rows});
  return all;
}

bool is_reciprocating(Habit habit) {
  return habit == Habit::reversals || habit == Habit::offset;
}

std::string header(Habit habit) {
  std::string text = habit == Habit::kilonewtons ? "Time [s];Load [kN];Friction [kN]"
                                                 : "Time [s];Load [N];Friction [N]";
  text += is_reciprocating(habit) ? ";Position [mm]" : ";Speed [mm/s]";
  text += ";Temperature [degC]";
  if (habit == Habit::raw_channels) text += ";Torque [Nmm];Cell [%];Drive [mW]";
  if (habit == Habit::coefficient_beside) text += ";COF";
  if (habit == Habit::torque) text += ";Torque [Nmm];Arm [mm]";
  return text + "\n";
}

std::string line(const Row& row, Habit habit, Random& random) {
  const double force_unit = habit == Habit::kilonewtons ? 1000 : 1;
  std::string text = fmt::format(
      "{:.2f};{:.9g};{:.9g};{:.9g};{:.2f}", row.t, row.load / force_unit, row.friction / force_unit,
      is_reciprocating(habit) ? row.position : row.speed, row.temperature);
  const auto read = [&](double value) { return value * (1 + 0.002 * random.normal()); };
  if (habit == Habit::raw_channels)
    text += fmt::format(";{:.6g};{:.5g};{:.6g}", read(row.friction * radius_mm),
                        read(row.friction / 5), read(row.friction * row.speed));
  if (habit == Habit::coefficient_beside) text += fmt::format(";{:.5f}", row.friction / row.load);
  if (habit == Habit::torque)
    text += fmt::format(";{:.9g};{}", row.friction * radius_mm, radius_mm);
  return text + "\n";
}

std::string job_of(Habit habit) {
  const bool from_torque = habit == Habit::torque;
  return fmt::format(
      R"([data]
training = "rig/*.csv"
experiment = "{}"
[data.columns]
time_s = "Time"
F_N_N = "Load"
F_R_N = {}
sigma_n_MPa = {{ column = "Load", area_mm2 = {} }}
v_rel_mm_s = {}
T_contact_C = "Temperature"
[models]
use = ["wzl"]
[calibration]
bootstrap = 0
[output]
directory = "out"
)",
      habit == Habit::intervals ? "interval" : "file",
      from_torque ? "{ formula = \"Torque__Nmm_/Arm\" }" : "\"Friction\"", area_mm2,
      is_reciprocating(habit) ? "{ column = \"Position\", slope_rows = 3 }" : "\"Speed\"");
}

} // namespace

std::vector<Habit> habits() {
  std::vector<Habit> all;
  for (int i = 1; i <= static_cast<int>(Habit::copied_test); ++i)
    all.push_back(static_cast<Habit>(i));
  return all;
}

const char* name_of(Habit habit) {
  static const char* const names[] = {
      "none",   "raw_channels", "coefficient_beside", "torque", "rest",   "reversals",
      "offset", "intervals",    "kilonewtons",        "kelvin", "spikes", "copied_test"};
  return names[static_cast<int>(habit)];
}

void write_rig(const TemporaryDirectory& directory, std::uint64_t seed, Habit habit) {
  Random random(seed, 5);
  std::string several;
  const std::vector<Test> all = tests_of(seed, habit);
  for (std::size_t t = 0; t < all.size(); ++t) {
    std::string text = header(habit);
    for (const Row& row : all[t].rows)
      text += line(row, habit, random);
    if (habit != Habit::intervals) {
      directory.write("rig/" + all[t].name + ".csv", text);
      continue;
    }
    several += text;
    if (t % 4 == 3)
      directory.write(fmt::format("rig/R{}.csv", t / 4 + 1), std::exchange(several, ""));
  }
  directory.write("job.toml", job_of(habit));
}

} // namespace frictab::test
