// Claims: what the rows of a test show is called as it was made, over a generator of rigs' habits
// that is not the twin; each habit on and off, over many seeds.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "data/phases.h"

namespace frictab::phases_test {
namespace {

using data::Phase;
using data::phases_of;
using data::SpeedReading;
using data::TestPhases;

constexpr std::size_t seeds = 50;

// One test as a rig records it, and what its rows are.
struct Rig {
  std::vector<double> time, speed, load, friction;
  std::vector<Phase> truth;

  void add(double v, double f_n, double f_r, Phase phase) {
    time.push_back(0.01 * static_cast<double>(time.size()));
    speed.push_back(v);
    load.push_back(f_n);
    friction.push_back(f_r);
    truth.push_back(phase);
  }
  TestPhases phases() const { return phases_of({speed, time, load, {}, friction}); }
};

struct Habits {
  std::size_t unloaded = 0, rest = 0; // rows before the test slides
  std::size_t closing = 0;            // rows in which the load builds up, sliding
  double load_noise = 0.01, speed_noise = 0.01;
  double offset_N = 0;  // of the force cell
  double step_mm_s = 0; // of the speed's reading
  // Error of the speed at rest, relative to that in motion: its zero, and from row to row.
  double speed_zero = 0, rest_noise = 0;
};

double read(double value, double step) {
  return step > 0 ? step * std::round(value / step) : value;
}

// A test at one speed.
Rig one_way(const Habits& habits, std::uint64_t seed) {
  Random random(seed, 0);
  const double v = std::exp(std::log(1000.0) * random.uniform()),
               load = 500 + 500 * random.uniform(), mu = 0.05 + 0.2 * random.uniform();
  Rig rig;
  const auto add = [&](double speed, double force, double friction, Phase phase) {
    const double scatter = speed == 0
                               ? habits.rest_noise * v * random.normal() + habits.speed_zero * v
                               : habits.speed_noise * v * random.normal();
    rig.add(read(speed + scatter, habits.step_mm_s),
            force + habits.load_noise * load * random.normal(),
            friction * (1 + 0.02 * random.normal()) + habits.offset_N, phase);
  };
  for (std::size_t i = 0; i < habits.unloaded; ++i)
    add(v, 0, 0, Phase::unloaded);
  const double held = habits.speed_zero != 0 ? 0.1 : 1; // of the friction in motion
  for (std::size_t i = 0; i < habits.rest; ++i)
    add(0, load, held * mu * load * static_cast<double>(i) / static_cast<double>(habits.rest),
        Phase::rest);
  for (std::size_t i = 0; i < habits.closing; ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(habits.closing + 1);
    add(v, share * load, mu * share * load, Phase::closing);
  }
  for (std::size_t i = 0; i < 200; ++i)
    add(v, load, mu * load, Phase::sliding);
  return rig;
}

// Strokes there and back: at a constant speed that turns within a row, or as a sine.
Rig both_ways(std::size_t rows_of_stroke, bool sine, double offset, std::uint64_t seed) {
  Random random(seed, 1);
  const double v = 1 + 99 * random.uniform(), mu = 0.05 + 0.2 * random.uniform(), load = 500;
  Rig rig;
  for (std::size_t i = 0; i < 6 * rows_of_stroke; ++i) {
    const std::size_t stroke = i / rows_of_stroke;
    const double along = (static_cast<double>(i % rows_of_stroke) + 0.5) / double(rows_of_stroke);
    const double sign = stroke % 2 == 0 ? 1 : -1;
    const double speed = sign * v * (sine ? std::sin(std::numbers::pi * along) : 1);
    const double way = sine ? (1 - std::cos(std::numbers::pi * along)) / 2 : along;
    const bool ends = way < 0.05 || way > 0.95 || std::abs(speed) < 0.2 * v;
    rig.add(speed * (1 + 0.01 * random.normal()), load,
            sign * mu * load * (1 + 0.02 * random.normal()) + offset,
            ends ? Phase::turning : Phase::sliding);
  }
  return rig;
}

struct Calls {
  std::size_t rows = 0, missed = 0, wrongly = 0; // left out; of a phase that is fitted
};

// What matters: whether a row is fitted.
void count(Calls& calls, const Rig& rig) {
  const TestPhases found = rig.phases();
  for (std::size_t i = 0; i < rig.truth.size(); ++i) {
    ++calls.rows;
    const bool is = data::is_fitted(found.rows[i]), should = data::is_fitted(rig.truth[i]);
    calls.missed += is && !should;
    calls.wrongly += !is && should;
  }
}

Calls calls_of(const Habits& habits) {
  Calls calls;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    count(calls, one_way(habits, seed));
  return calls;
}

TEST(Phases, NothingIsCalledInTestsThatJustSlide) {
  for (const Habits& habits :
       {Habits{}, Habits{.speed_noise = 0.2}, Habits{.load_noise = 0.2}, Habits{.closing = 9},
        Habits{.offset_N = 30}, Habits{.speed_noise = 0.0}, Habits{.step_mm_s = 1}})
    EXPECT_EQ(calls_of(habits).wrongly, 0u);
}

TEST(Phases, RestAndRowsWithoutLoadAreFound) {
  const Calls rest = calls_of({.rest = 20}), unloaded = calls_of({.unloaded = 20}),
              all = calls_of({.unloaded = 15, .rest = 10, .closing = 12, .offset_N = 20});
  EXPECT_EQ(rest.missed, 0u);
  EXPECT_EQ(rest.wrongly, 0u);
  EXPECT_EQ(unloaded.missed, 0u);
  EXPECT_EQ(unloaded.wrongly, 0u);
  EXPECT_EQ(all.missed, 0u);
  EXPECT_LT(all.wrongly,
            all.rows / 200); // the first rows of a load that builds up: below 5 % of it
}

TEST(Phases, RestIsFoundByASpeedThatScattersThere) {
  for (const double noise : {0.0005, 0.002, 0.005})
    for (const std::size_t rows : {std::size_t(20), std::size_t(60), std::size_t(600)}) {
      const Calls calls = calls_of({.rest = rows, .rest_noise = noise});
      EXPECT_EQ(calls.wrongly, 0u);
      EXPECT_LE(calls.missed, calls.rows / 200) << noise << ", " << rows; // 3 errors from zero
    }
}

TEST(Phases, RestIsFoundByASpeedWhoseZeroIsOffWhereNothingRubs) {
  for (const double zero : {0.0005, 0.002, 0.01, -0.01})
    for (const std::size_t rows : {std::size_t(20), std::size_t(60), std::size_t(600)}) {
      const Calls calls = calls_of({.rest = rows, .speed_zero = zero, .rest_noise = 0.001});
      EXPECT_EQ(calls.wrongly, 0u);
      EXPECT_EQ(calls.missed, 0u) << zero << ", " << rows;
    }
}

TEST(Phases, AStartWhoseFrictionGrowsWithTheSpeedIsNoRest) {
  Rig rig;
  Random random(2, 4);
  for (std::size_t i = 0; i < 1000; ++i) { // a film: friction is in proportion to the speed
    const double v = 0.1 * double(i + 1);
    rig.add(v * (1 + 0.01 * random.normal()), 500, 0.5 * v * (1 + 0.02 * random.normal()),
            Phase::sliding);
  }
  Calls calls;
  count(calls, rig);
  EXPECT_EQ(calls.wrongly, 0u);
}

TEST(Phases, ClosingIsCountedAndFitted) {
  const Rig rig = one_way({.closing = 15}, 3);
  const TestPhases found = rig.phases();
  EXPECT_EQ(std::count(found.rows.begin(), found.rows.end(), Phase::closing), 14); // to 90 %
  Rig reversed = rig;
  for (auto* values : {&reversed.speed, &reversed.load, &reversed.friction})
    std::reverse(values->begin(), values->end());
  const TestPhases opening = reversed.phases();
  EXPECT_EQ(std::count(opening.rows.begin(), opening.rows.end(), Phase::opening), 14);
}

TEST(Phases, ALowLevelThatIsHeldSlides) {
  Rig rig;
  Random random(1, 2);
  for (const double load : {10.0, 100.0, 1000.0})
    for (std::size_t i = 0; i < 60; ++i)
      rig.add(10, load * (1 + 0.01 * random.normal()), 0.1 * load * (1 + 0.02 * random.normal()),
              Phase::sliding);
  Calls calls;
  count(calls, rig);
  EXPECT_EQ(calls.wrongly, 0u);
  Rig speeds;
  for (const double v : {0.01, 0.1, 1.0, 10.0, 100.0})
    for (std::size_t i = 0; i < 40; ++i)
      speeds.add(v * (1 + 0.01 * random.normal()), 100, 10, Phase::sliding);
  count(calls, speeds);
  EXPECT_EQ(calls.wrongly, 0u);
}

TEST(Phases, ASpeedThatIsTooCoarseOrTooNoisyCallsNothing) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Random random(seed, 3);
    Rig coarse, noisy, counted;
    for (std::size_t i = 0; i < 200; ++i) {
      coarse.add(std::floor(2 * random.uniform()), 100, 10, Phase::sliding);
      noisy.add(1 + 2 * random.normal(), 100, 10, Phase::sliding);
      counted.add(i % 40 == 39 ? 1 : 0, 100, 10, Phase::sliding); // a counter at a slow speed
    }
    EXPECT_EQ(coarse.phases().speed, SpeedReading::coarse);
    EXPECT_EQ(noisy.phases().speed, SpeedReading::noisy);
    EXPECT_EQ(counted.phases().speed, SpeedReading::coarse);
    Calls calls;
    for (const Rig* rig : {&coarse, &noisy, &counted})
      count(calls, *rig);
    EXPECT_EQ(calls.wrongly, 0u);
  }
}

TEST(Phases, StrokesHaveADirectionAndTheirEndsTurn) {
  Calls calls;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    for (const bool sine : {false, true})
      for (const double offset : {0.0, 10.0}) {
        const Rig rig = both_ways(60, sine, offset, seed);
        const TestPhases found = rig.phases();
        ASSERT_EQ(found.strokes.size(), 6u) << seed;
        for (std::size_t s = 0; s < 6; ++s) {
          EXPECT_EQ(found.strokes[s].direction, s % 2 == 0 ? 1 : -1);
          EXPECT_NEAR(static_cast<double>(found.strokes[s].begin), static_cast<double>(60 * s), 1);
        }
        count(calls, rig);
      }
  EXPECT_LT(calls.wrongly, calls.rows / 100); // a row beside the limit, here or there
  EXPECT_LT(calls.missed, calls.rows / 30);   // the start of the first stroke, the end of the last
}

TEST(Phases, TheForceSaysTheDirectionWhereTheSpeedHasNoSign) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Rig rig = both_ways(60, false, 5, seed);
    for (double& v : rig.speed)
      v = std::abs(v);
    const TestPhases found = rig.phases();
    ASSERT_EQ(found.strokes.size(), 6u);
    EXPECT_EQ(found.strokes[1].direction, -1);
  }
  Rig about_zero; // noise about no friction is no stroke
  Random random(5, 4);
  for (std::size_t i = 0; i < 300; ++i)
    about_zero.add(10, 100, random.normal(), Phase::sliding);
  EXPECT_FALSE(about_zero.phases().both_directions());
}

TEST(Phases, AForceThatBuildsUpTheOtherWayTurns) {
  Rig rig;
  for (std::size_t i = 0; i < 240; ++i) {
    const double sign = i / 60 % 2 == 0 ? 1 : -1;
    const double built = std::min(1.0, static_cast<double>(i % 60) / 8);
    rig.add(sign * 10, 500, sign * 50 * (2 * built - 1),
            built < 0.95 ? Phase::turning : Phase::sliding);
  }
  const TestPhases found = rig.phases();
  for (const std::size_t i : {60u, 63u, 66u, 120u, 126u})
    EXPECT_EQ(found.rows[i], Phase::turning) << i;
  EXPECT_EQ(found.rows[90], Phase::sliding);
}

// Loops of a cell and no clock: only the force shows where it turns. Between, it builds up over
// rows from one sign to the other, about a zero that is off; the first stroke is cut off.
TEST(Phases, AForceThatAloneShowsTheReversalTurnsBeforeAndBehindIt) {
  for (const double zero : {0.0, 0.06, -0.06}) {
    std::vector<double> friction;
    std::vector<Phase> truth;
    for (std::size_t i = 85; i < 500; ++i) {
      const double sign = i / 100 % 2 == 0 ? 1 : -1;
      const double built = std::min(1.0, static_cast<double>(i % 100) / 18);
      friction.push_back(sign * 0.2 * (2 * built - 1) + zero);
      truth.push_back(built < 1 ? Phase::turning : Phase::sliding);
    }
    const std::vector<double> load(friction.size(), 1);
    const TestPhases found = phases_of({{}, {}, load, {}, friction});
    ASSERT_TRUE(found.both_directions());
    for (std::size_t i = 15; i < friction.size(); ++i) {
      const bool is_full = std::abs(friction[i] - zero) > 0.16; // nearly built up
      if (truth[i] == Phase::turning && !is_full) {
        EXPECT_EQ(found.rows[i], Phase::turning) << zero << " row " << i;
      }
    }
    EXPECT_GT(std::count(found.rows.begin(), found.rows.end(), Phase::sliding), 280) << zero;
  }
}

// A set speed goes on where the drive has stopped. `start`: shares of the friction in the first
// rows; `end`: in the last.
TestPhases beside_a_set_speed(const std::vector<double>& start, const std::vector<double>& end,
                              std::size_t rows = 60, double last_speed = 20) {
  Rig rig;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t left = rows - i;
    const double share = i < start.size() ? start[i] : left <= end.size() ? end[left - 1] : 1;
    rig.add(left <= 5 ? last_speed : 20, 500, share * (50 + double(i % 3)), Phase::sliding);
  }
  return rig.phases();
}

std::size_t rows_at_rest(const TestPhases& found) {
  return std::size_t(std::count(found.rows.begin(), found.rows.end(), Phase::rest));
}

TEST(Phases, AFewRowsWithoutFrictionAtAnEndAreRestBesideASetSpeed) {
  const TestPhases both = beside_a_set_speed({0.1}, {0.01, 0.02, 0.01});
  EXPECT_EQ(rows_at_rest(both), 4u);
  EXPECT_EQ(both.still_by_friction, 4u);
  EXPECT_EQ(both.rows[0], Phase::rest);
  EXPECT_EQ(both.rows[57], Phase::rest);
  EXPECT_EQ(both.rows[1], Phase::sliding);
  Rig unknown; // no speed at all
  for (std::size_t i = 0; i < 60; ++i)
    unknown.add(0, 500, i < 2 ? 0.5 : 50, Phase::sliding);
  EXPECT_EQ(rows_at_rest(phases_of({{}, unknown.time, unknown.load, {}, unknown.friction})), 2u);
}

TEST(Phases, FrictionThatBeginsLowForAReasonSlides) {
  EXPECT_EQ(rows_at_rest(beside_a_set_speed({0.33, 0.35, 0.4, 0.6, 0.8}, {})), 0u) << "runs in";
  std::vector<double> film(20, 0.05), slow;
  EXPECT_EQ(rows_at_rest(beside_a_set_speed(film, {})), 0u) << "a film that breaks down";
  for (int i = 0; i < 30; ++i)
    slow.push_back(0.1 + 0.03 * i);
  EXPECT_EQ(rows_at_rest(beside_a_set_speed(slow, {})), 0u) << "a slow rise";
  EXPECT_EQ(rows_at_rest(beside_a_set_speed({}, {0.05, 0.05, 0.05, 0.05, 0.05}, 200, 400)), 0u)
      << "another set speed";
  Rig measured; // its speed shows that it slides
  for (std::size_t i = 0; i < 60; ++i)
    measured.add(20 + 0.1 * double(i % 7), 500, i < 2 ? 0.5 : 50, Phase::sliding);
  EXPECT_EQ(rows_at_rest(measured.phases()), 0u);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) { // friction within its noise
    Random random(seed, 11);
    Rig noise;
    for (std::size_t i = 0; i < 60; ++i)
      noise.add(20, 500, random.normal(), Phase::sliding);
    EXPECT_EQ(noise.phases().still_by_friction, 0u) << seed;
  }
}

TEST(Phases, AReadingOfTheSpeedBesideASetOneShowsRestWhereNothingRubs) {
  for (const double held : {0.02, 0.9}) { // of the friction, at rest
    Rig rig;
    std::vector<double> rpm;
    for (std::size_t i = 0; i < 90; ++i) {
      const bool rests = i / 15 == 2;
      rpm.push_back(rests ? 0.1 * double(i % 2) : 72 + double(i % 3));
      rig.add(20, 500, (rests ? held : 1) * 50, Phase::sliding);
    }
    const TestPhases found = phases_of({rig.speed, rig.time, rig.load, {}, rig.friction, rpm});
    EXPECT_EQ(rows_at_rest(found), held < 0.5 ? 15u : 0u) << held;
    EXPECT_EQ(found.still_by_other_speed, rows_at_rest(found));
  }
}

TEST(Phases, APathStandsForASpeedThatIsNotRecorded) {
  std::vector<double> time, path, load;
  Random random(2, 5);
  for (std::size_t i = 0; i < 200; ++i) {
    time.push_back(0.1 * static_cast<double>(i));
    path.push_back(i < 50 ? 0 : 0.5 * static_cast<double>(i - 50));
    load.push_back(100);
  }
  const TestPhases found = phases_of({{}, time, load, path, {}});
  EXPECT_EQ(found.rows[20], Phase::rest);
  EXPECT_EQ(found.rows[100], Phase::sliding);
  EXPECT_EQ(std::count(found.rows.begin() + 55, found.rows.end(), Phase::sliding), 145);
}

// A drive that stands, slides, stands, slides on and stands, and the reading of its path.
struct Drive {
  double noise = 0, step = 0; // of the reading, in ways of a row
  std::size_t held = 1;       // rows for which a slow recorder repeats its reading
  bool set_speed = false;     // recorded as the speed

  Rig rig(std::uint64_t seed, std::vector<double>& path) const {
    Random random(seed, 7);
    const double way = std::exp(4 * random.uniform() - 2);
    Rig out;
    double at = 0, shown = 0;
    const auto add = [&](std::size_t rows, double speed) {
      for (std::size_t i = 0; i < rows; ++i) {
        at += speed * way;
        if (out.time.size() % held == 0)
          shown = read(at + noise * way * random.normal(), step * way);
        path.push_back(shown);
        out.add(set_speed ? 100 * way : 0, 500, speed > 0 ? 50 : 0,
                speed > 0 ? Phase::sliding : Phase::rest);
      }
    };
    add(40, 0);
    add(150, 1);
    add(70, 0);
    add(100, 1);
    add(30, 0);
    if (!set_speed) out.speed.clear();
    return out;
  }
};

TEST(Phases, APathThatStandsIsRestBesideASetSpeedToo) {
  for (const bool set_speed : {false, true})
    for (const Drive& drive : {Drive{0, 0, 1, set_speed}, Drive{0.01, 0, 1, set_speed},
                               Drive{0, 0.01, 1, set_speed}, Drive{0.03, 0.01, 1, set_speed},
                               Drive{0, 1, 1, set_speed}, Drive{0, 0.01, 4, set_speed}}) {
      std::size_t missed = 0, wrongly = 0, rests = 0;
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        std::vector<double> path;
        const Rig rig = drive.rig(seed, path);
        const TestPhases found = phases_of({rig.speed, rig.time, rig.load, path, rig.friction});
        for (std::size_t i = 0; i < rig.truth.size(); ++i) {
          const bool is = found.rows[i] == Phase::rest, should = rig.truth[i] == Phase::rest;
          missed += should && !is;
          wrongly += is && !should;
          rests += should;
        }
      }
      const std::string name = "noise " + std::to_string(drive.noise) + ", step " +
                               std::to_string(drive.step) + ", held " + std::to_string(drive.held);
      const std::size_t edges =
          4 * seeds; // a row at each start and stop, longer where readings repeat
      EXPECT_LE(wrongly, edges * drive.held) << name;
      EXPECT_LE(missed, drive.noise > 0  ? rests / 50
                        : drive.held > 1 ? edges * drive.held
                                         : 0)
          << name;
    }
}

TEST(Phases, ThreeRowsAtRestAreFoundWhereTheReadingAdvancesEveryRow) {
  Rig rig;
  std::vector<double> path;
  for (int i = 0; i < 90; ++i) {
    path.push_back(40.0 * std::max(i - 2, 0));
    rig.add(20, 500, i < 3 ? 0 : 50, i < 3 ? Phase::rest : Phase::sliding);
  }
  EXPECT_EQ(phases_of({rig.speed, rig.time, rig.load, path, rig.friction}).rows, rig.truth);
}

TEST(Phases, SlowSlidingIsNoRestByItsPath) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    for (const double noise : {0.0, 0.0005}) {
      Random random(seed, 8);
      Rig rig;
      std::vector<double> path;
      double at = 0;
      for (const double speed : {1.0, 0.01, 0.1, 0.003, 1.0, 0.03})
        for (std::size_t i = 0; i < 100; ++i) {
          path.push_back((at += speed) + noise * random.normal());
          rig.add(speed, 500, 50, Phase::sliding);
        }
      const TestPhases of_path = phases_of({{}, rig.time, rig.load, path, rig.friction});
      EXPECT_EQ(std::count(of_path.rows.begin(), of_path.rows.end(), Phase::rest), 0) << noise;
      const TestPhases set = phases_of({rig.speed, rig.time, rig.load, path, rig.friction});
      EXPECT_EQ(std::count(set.rows.begin(), set.rows.end(), Phase::rest), 0) << noise;
    }
}

TEST(Phases, WhatIsNoNumberIsSkipped) {
  Rig rig = one_way({}, 1);
  rig.speed[10] = rig.load[20] = rig.friction[30] = std::nan("");
  const TestPhases found = rig.phases();
  EXPECT_EQ(std::count(found.rows.begin(), found.rows.end(), Phase::sliding), 200);
  EXPECT_EQ(phases_of({}).rows.size(), 0u);
}

} // namespace
} // namespace frictab::phases_test
