// Each check is a function from a campaign to its finding.
#include "data/plausibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/condense.h"
#include "data/dropouts.h"
#include "data/equal_tests.h"
#include "data/scale.h"
#include "data/tests_apart.h"

namespace frictab::data {

namespace {

// Coefficients above 1 have been measured for rubber and clean metals in vacuum, up to about 3.6
// for gold; below 0.001 only for fluid films.
constexpr double least_mu = 0.001, usual_mu = 1, largest_mu = 3.6;
// Above every flow stress of a metal, and every contact pressure that metals bear.
constexpr double largest_pressure_MPa = 20000;
constexpr double largest_psi = 100;
// Allowed ratio between a stress and the forces it comes from, due to rounding and smoothing.
constexpr double same_coefficient = 1.1;
// Backward steps of a path up to this share are not noise.
constexpr double rare_share = 0.05;
// Smallest factor between two units of speed, larger than between two ways to measure it; checked
// over enough rows for a noisy path to advance.
constexpr double same_speed = 5;
constexpr std::size_t path_rows = 100;
// Noise lifts a stuck contact above its shear yield stress by less than this factor.
constexpr double above_yield = 1.15;
constexpr std::size_t stuck_rows = 20, clipped_rows = 10;
// Shares of a test's load below which nothing, or little, is pressed; smallest relevant offset as a
// share of its friction.
constexpr double no_load = 0.05, half_load = 0.5, offset_share = 0.1;
constexpr std::size_t rows_without_contact = 5;
// Share of a test's friction, and coefficient, that count as none, in at least so many rows.
constexpr double still_share = 0.1, still_mu = 0.02;
constexpr std::size_t rows_at_rest = 5;

// Returns 0 for no values.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place = values.begin() + std::ptrdiff_t(share * double(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

// Coefficients of the rows under load.
std::vector<double> coefficients(const Dataset& data, std::size_t begin, std::size_t end) {
  const auto tau = data.values("tau_R_MPa"), pressure = data.values("sigma_n_MPa");
  std::vector<double> mu;
  for (std::size_t i = begin; i < end; ++i)
    if (pressure[i] > 0) mu.push_back(tau[i] / pressure[i]);
  return mu;
}

template <class Fails> std::size_t count(std::span<const double> values, const Fails& fails) {
  return std::size_t(std::count_if(values.begin(), values.end(), fails));
}

std::string coefficient_hint(const Dataset& data, double typical) {
  if (data.has("F_R_N") && data.has("F_N_N") && typical > 1 && typical < 1 / least_mu)
    return "F_R_N and F_N_N taken for each other? Or a force in another unit";
  if (typical > 1 && typical < 100)
    return "a coefficient in percent? unit = \"%\" where it is mapped";
  if (typical >= 100)
    return "contact normal stress in GPa, or shear stress in Pa or kPa? `unit` where it is mapped";
  return "contact normal stress in Pa or kPa, or shear stress in GPa? `unit` where it is mapped";
}

// ---- the checks ----

bool all_friction_zero(const Dataset& data) {
  const auto tau = data.values("tau_R_MPa");
  return std::all_of(tau.begin(), tau.end(), [](double value) { return value == 0; });
}

Implausible no_friction(const Dataset& data) {
  if (!all_friction_zero(data)) return {};
  return {"", data.source_rows(), data.source_rows(),
          "tau_R_MPa is 0 in every row: nothing was measured",
          "a channel that was not connected, or another column that holds the friction: map it in "
          "[data.columns]"};
}

// Finds friction where the load is exactly 0: its coefficient is undefined, so other checks miss
// it. (Noise around 0 does not count as friction.)
Implausible no_load_channel(const Dataset& data) {
  const auto tau = data.values("tau_R_MPa"), pressure = data.values("sigma_n_MPa");
  const double rubbing = offset_share * quantile({tau.begin(), tau.end()}, 0.9);
  std::vector<double> found;
  for (std::size_t i = 0; i < tau.size(); ++i)
    if (pressure[i] == 0 && tau[i] > 0 && tau[i] > rubbing) found.push_back(tau[i]);
  return {
      "", found.size(), tau.size(),
      fmt::format("sigma_n_MPa is 0 where tau_R_MPa is not, {:.3g} in the middle", median(found)),
      "a load channel that was not connected or dropped out? Such rows are left out with "
      "data.drop = { sigma_n_MPa = { below = 1 } }"};
}

// Checks eq. 1 if a file gives the stress and both forces.
Implausible forces(const Dataset& data) {
  if (!data.has("F_R_N") || !data.has("F_N_N")) return {};
  const auto friction = data.values("F_R_N"), normal = data.values("F_N_N"),
             tau = data.values("tau_R_MPa"), pressure = data.values("sigma_n_MPa");
  const double load = quantile({normal.begin(), normal.end()}, 0.9),
               rubbing = quantile({tau.begin(), tau.end()}, 0.9);
  std::size_t of = 0;
  std::vector<double> others; // ratios that are not 1
  for (std::size_t i = 0; i < data.rows(); ++i) {
    // A small stress is rounded: at rest a coefficient with two decimals is 0.00 or 0.01.
    if (!(normal[i] > half_load * load) || !(pressure[i] > 0) || !(tau[i] > offset_share * rubbing))
      continue;
    const double ratio = friction[i] / normal[i] / (tau[i] / pressure[i]);
    ++of;
    if (ratio > same_coefficient || ratio < 1 / same_coefficient) others.push_back(ratio);
  }
  const double middle = median(others);
  if (middle < same_coefficient && middle > 1 / same_coefficient) return {}; // they scatter about 1
  return {
      "", others.size(), of,
      fmt::format("F_R_N/F_N_N is {:.3g} times tau_R_MPa/sigma_n_MPa in the middle: they "
                  "contradict each other",
                  middle),
      "a shear stress of another column, or a force in another unit? Leave out which of the two "
      "is wrong: without tau_R_MPa it is computed from the forces"};
}

Implausible friction_coefficient(const Dataset& data) {
  const std::vector<double> mu = coefficients(data, 0, data.rows());
  const double typical = median(mu);
  const auto fails = [](double x) { // friction may scatter about 0
    return x < -largest_mu || (!(x <= 0) && !(x >= least_mu && x <= largest_mu));
  };
  return {"", count(mu, fails), mu.size(),
          fmt::format("tau_R_MPa/sigma_n_MPa is outside {} to {}, {:.3g} in the middle", least_mu,
                      largest_mu, typical),
          coefficient_hint(data, typical)};
}

Implausible high_coefficient(const Dataset& data) {
  const std::vector<double> mu = coefficients(data, 0, data.rows());
  std::vector<double> high;
  for (const double x : mu)
    if (x > usual_mu && x <= largest_mu) high.push_back(x);
  return {"",
          high.size(),
          mu.size(),
          fmt::format("tau_R_MPa/sigma_n_MPa is above {}, {:.3g} in the middle of these rows: "
                      "rubber, or clean metals in vacuum",
                      usual_mu, median(high)),
          coefficient_hint(data, median(high)),
          false};
}

Implausible no_coefficient(const Dataset& data) {
  if (all_friction_zero(data)) return {}; // reported already
  std::size_t rows = 0, tests = 0;
  std::string first;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::vector<double> mu = coefficients(data, data.first_row[e], data.first_row[e + 1]);
    const double mean = std::accumulate(mu.begin(), mu.end(), 0.0) / double(mu.size());
    if (!(mean <= 0)) continue; // also without rows under load
    if (tests++ == 0)
      first = fmt::format("the mean of tau_R_MPa/sigma_n_MPa is {:.3g} in test '{}'", mean,
                          data.experiments[e]);
    rows += data.source_rows(e);
  }
  if (tests == 0) return {};
  return {"",
          rows,
          data.source_rows(),
          first + and_more(tests - 1, "test"),
          "a zero point that was not set, or a force of the other sign?",
          false};
}

Implausible pressure(const Dataset& data) {
  const auto values = data.values("sigma_n_MPa");
  return {"", count(values, [](double x) { return x > largest_pressure_MPa; }), values.size(),
          fmt::format("sigma_n_MPa is above {}", thousands(std::size_t(largest_pressure_MPa))),
          "contact normal stress in Pa or kPa? unit = \"Pa\" where it is mapped"};
}

bool above_shear_yield(double tau, double flow) {
  return tau > above_yield * flow / std::sqrt(3.0);
}

Implausible shear_yield(const Dataset& data) {
  if (!data.has("sigma_f_MPa")) return {};
  const auto tau = data.values("tau_R_MPa"), flow = data.values("sigma_f_MPa");
  std::size_t rows = 0;
  for (std::size_t i = 0; i < tau.size(); ++i)
    rows += above_shear_yield(tau[i], flow[i]);
  return {"", rows, tau.size(), "tau_R_MPa is above the shear yield stress sigma_f_MPa/sqrt(3)",
          "a flow stress in GPa or before hardening, or a shear stress in another unit?"};
}

// Compares the speed with the path: a path integrated from the speed agrees with its mean over each
// row.
Implausible speed(const Dataset& data) {
  if (!data.has("s_mm") || !data.has("time_s") || !data.has("v_rel_mm_s")) return {};
  const auto path = data.values("s_mm"), time = data.values("time_s"),
             v = data.values("v_rel_mm_s");
  std::size_t rows = 0, of = 0;
  std::vector<double> ratios;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t first = data.first_row[e], steps = data.first_row[e + 1] - first - 1;
    const std::size_t parts = std::max<std::size_t>(1, steps / path_rows);
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t begin = first + part * steps / parts,
                        end = first + (part + 1) * steps / parts;
      double moved = 0, expected = 0;
      for (std::size_t i = begin; i < end; ++i)
        if (const double lasted = time[i + 1] - time[i]; lasted > 0) {
          moved += path[i + 1] - path[i];
          expected += 0.5 * (v[i] + v[i + 1]) * lasted;
        }
      if (moved == 0 || !(expected > 0)) continue;
      const double ratio = std::abs(moved) / expected;
      ratios.push_back(ratio);
      of += end - begin;
      if (ratio > same_speed || ratio < 1 / same_speed) rows += end - begin;
    }
  }
  return {"", rows, of,
          fmt::format("s_mm grows {:.3g} times as fast as v_rel_mm_s says", median(ratios)),
          "a speed in m/s, a path in m or um, a time in ms? `unit` where it is mapped"};
}

// Number of rows in pieces of `width` whose mean is below that of an earlier piece by more than
// `by`.
std::size_t source_rows(std::span<const double> distance, std::size_t width, double by) {
  double farthest = -std::numeric_limits<double>::infinity();
  std::size_t behind = 0;
  for (std::size_t begin = 0; begin < distance.size(); begin += width) {
    const auto piece = distance.subspan(begin, std::min(width, distance.size() - begin));
    const double mean = std::accumulate(piece.begin(), piece.end(), 0.0) / double(piece.size());
    if (mean < farthest - by) behind += piece.size();
    farthest = std::max(farthest, mean);
  }
  return behind;
}

// Rows of a test that go back by more than a usual step. Many backward steps may be noise, so
// pieces are compared instead of rows; without a clock to confirm the order of rows, nothing is
// reported.
std::size_t source_rows(std::span<const double> distance, bool has_clock) {
  std::vector<double> steps;
  std::size_t back = 0;
  for (std::size_t i = 1; i < distance.size(); ++i) {
    steps.push_back(std::abs(distance[i] - distance[i - 1]));
    back += distance[i] < distance[i - 1];
  }
  if (back == 0) return 0;
  const bool may_be_noise = rare_share * double(distance.size()) < double(back);
  if (may_be_noise && !has_clock) return 0;
  return source_rows(distance, may_be_noise ? std::max<std::size_t>(1, distance.size() / 10) : 1,
                     median(std::move(steps)));
}

// Checks that s_mm only grows, as the distance since first contact does; a position goes back and
// forth.
Implausible path(const Dataset& data) {
  if (!data.has("s_mm") || speed(data).most()) return {}; // reported already
  std::size_t rows = 0, tests = 0;
  std::string first;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t begin = data.first_row[e];
    const std::size_t behind = source_rows(
        data.values("s_mm").subspan(begin, data.first_row[e + 1] - begin), data.has("time_s"));
    if (behind > 0 && tests++ == 0) first = data.experiments[e];
    rows += behind;
  }
  if (tests == 0) return {};
  return {"", rows, data.rows(),
          fmt::format("s_mm runs backwards in test '{}'{}", first, and_more(tests - 1, "test")),
          "a position, not the distance slid? Without a column s_mm it is integrated from "
          "v_rel_mm_s and time_s"};
}

Implausible surface_expansion(const Dataset& data) {
  if (!data.has("psi")) return {};
  const auto values = data.values("psi");
  return {"", count(values, [](double x) { return x > largest_psi; }), values.size(),
          fmt::format("psi is above {}", largest_psi),
          "a surface expansion in percent? unit = \"%\" where it is mapped"};
}

// True if the load or the speed changes over these rows, so that a measured stress would not stay
// constant.
bool something_changes(const Dataset& data, std::size_t begin, std::size_t end) {
  for (const char* name : {"sigma_n_MPa", "F_N_N", "v_rel_mm_s"}) {
    if (!data.has(name)) continue;
    const auto values = data.values(name).subspan(begin, end - begin);
    if (std::any_of(values.begin(), values.end(), [&](double x) { return x != values[0]; }))
      return true;
  }
  return false;
}

// Rows of one test with one value.
struct Run {
  std::size_t test, begin, end;
  std::size_t rows() const { return end - begin; }
};

std::vector<Run> runs_of_one_value(const Dataset& data, std::span<const double> values,
                                   std::size_t least) {
  std::vector<Run> runs;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e], end = data.first_row[e + 1], from = i; i < end; ++i) {
      if (i + 1 < end && values[i + 1] == values[from]) continue;
      if (i + 1 - from >= least) runs.push_back({e, from, i + 1});
      from = i + 1;
    }
  return runs;
}

// True if the other rows of these runs' tests go up and down from row to row, as measured values do
// and nominal values do not.
bool scatters_beside(const Dataset& data, std::span<const double> values,
                     const std::vector<Run>& runs) {
  const double level = values[runs.front().begin];
  std::set<std::size_t> tests;
  for (const Run& run : runs)
    tests.insert(run.test);
  std::size_t turns = 0, of = 0;
  for (const std::size_t e : tests)
    for (std::size_t i = data.first_row[e] + 2; i < data.first_row[e + 1]; ++i) {
      const double a = values[i - 2], b = values[i - 1], c = values[i];
      if (a == level || b == level || c == level) continue;
      ++of;
      turns += (b - a) * (c - b) < 0;
    }
  return tests.size() > 1 && of >= clipped_rows && 5 * turns >= of;
}

// Finds a channel that stays at its largest or smallest value in several tests and at no value in
// between: the end of an amplifier's range. A real plateau has another height in another test, or
// scatters; a nominal or coarse column stays at other values too. At 0 nothing is lost.
std::vector<Run> clipped_runs(const Dataset& data, std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  std::vector<Run> at_low, at_high;
  std::size_t held = 0, between = 0;
  for (const Run& run : runs_of_one_value(data, values, clipped_rows)) {
    const double value = values[run.begin];
    if (value == *high) at_high.push_back(run);
    if (value == *low) at_low.push_back(run);
    (value == *high || value == *low ? held : between) += run.rows();
  }
  std::vector<Run> out;
  if (10 * between > held) return out;
  for (const auto& [level, runs] : {std::pair(*high, at_high), std::pair(*low, at_low)})
    if (level != 0 && !runs.empty() && scatters_beside(data, values, runs))
      out.insert(out.end(), runs.begin(), runs.end());
  return out;
}

Implausible clipped_channel(const Dataset& data) {
  Implausible out;
  out.of = data.rows();
  out.hint = "an amplifier at the end of its range? Measure again, or leave these rows out: "
             "data.drop";
  for (const char* name : {"F_R_N", "F_N_N", "tau_R_MPa", "sigma_n_MPa"}) {
    if (!data.has(name) || out.rows > 0) continue; // stresses may come from forces
    const auto values = data.values(name);
    const std::vector<Run> runs = clipped_runs(data, values);
    std::set<std::size_t> tests;
    for (const Run& run : runs) {
      out.rows += run.rows();
      tests.insert(run.test);
    }
    if (!runs.empty())
      out.what = fmt::format("{} stays at {:.6g}, beyond which it never goes, {} times in a row or "
                             "more: in {} tests, first in '{}'",
                             name, values[runs.front().begin], clipped_rows, tests.size(),
                             data.experiments[*tests.begin()]);
  }
  return out;
}

// True if most rows of a test outside its runs repeat the value before: then the channel is too
// coarse, and constant values are plausible.
bool is_coarse(const Dataset& data, std::span<const double> values, const std::vector<Run>& runs,
               std::size_t test) {
  std::size_t repeats = 0, of = 0;
  auto run =
      std::partition_point(runs.begin(), runs.end(), [&](const Run& r) { return r.test < test; });
  for (std::size_t i = data.first_row[test] + 1; i < data.first_row[test + 1]; ++i) {
    while (run != runs.end() && run->test == test && run->end <= i)
      ++run;
    if (run != runs.end() && run->test == test && i > run->begin) continue;
    ++of;
    repeats += values[i] == values[i - 1];
  }
  return 2 * repeats > of;
}

// Finds a stuck channel: one number repeated while other columns change.
Implausible stuck_channel(const Dataset& data) {
  if (all_friction_zero(data)) return {}; // reported already
  Implausible out;
  out.of = data.rows();
  std::string where;
  for (const char* name : {"tau_R_MPa", "F_R_N"}) {
    if (!data.has(name) || out.rows > 0) continue; // tau_R_MPa may come from F_R_N
    const auto values = data.values(name);
    if (!clipped_runs(data, values).empty()) continue; // reported already
    const std::vector<Run> runs = runs_of_one_value(data, values, stuck_rows);
    std::optional<std::size_t> test;
    bool coarse = false;
    for (const Run& run : runs) {
      if (test != run.test) coarse = is_coarse(data, values, runs, run.test);
      test = run.test;
      if (coarse || !something_changes(data, run.begin, run.end)) continue;
      if (where.empty()) where = fmt::format("{} in test '{}'", name, data.experiments[run.test]);
      out.rows += run.rows();
    }
  }
  out.what = fmt::format("the same value {} times in a row or more, while load or speed change: {}",
                         stuck_rows, where);
  out.hint = "a channel that is stuck or clipped, or a mean written in every row?";
  return out;
}

// The forces of one test, or its stresses where no forces are given, and their values under load.
struct Forces {
  std::span<const double> normal, friction, speed; // speed is empty if unknown
  double load = 0, rubbing = 0;

  static bool are_given(const Dataset& data) { return data.has("F_R_N") && data.has("F_N_N"); }
  static const char* name(const Dataset& data, bool of_friction) {
    if (are_given(data)) return of_friction ? "F_R_N" : "F_N_N";
    return of_friction ? "tau_R_MPa" : "sigma_n_MPa";
  }

  Forces(const Dataset& data, std::size_t test) {
    const std::size_t begin = data.first_row[test], rows = data.first_row[test + 1] - begin;
    normal = data.values(name(data, false)).subspan(begin, rows);
    friction = data.values(name(data, true)).subspan(begin, rows);
    if (data.has("v_rel_mm_s")) speed = data.values("v_rel_mm_s").subspan(begin, rows);
    load = quantile({normal.begin(), normal.end()}, 0.9);
    std::vector<double> under_load;
    for (std::size_t i = 0; i < rows; ++i)
      if (normal[i] > half_load * load) under_load.push_back(std::abs(friction[i]));
    rubbing = median(under_load);
  }

  // Rows before (or after) the first (last) one with this share of the load.
  std::pair<std::size_t, std::size_t> ends(bool front, double share) const {
    std::size_t begin = 0, end = normal.size();
    if (front)
      for (end = 0; end < normal.size() && normal[end] < share * load;)
        ++end;
    else
      for (begin = normal.size(); begin > 0 && normal[begin - 1] < share * load;)
        --begin;
    return {begin, end};
  }
};

struct Level {
  double middle, spread;
};
Level level_of(std::span<const double> values) {
  const double middle = median({values.begin(), values.end()});
  std::vector<double> off;
  for (const double value : values)
    off.push_back(std::abs(value - middle));
  return {middle, median(off)};
}

// Friction force without contact, if it is an offset: larger than its scatter, and larger than any
// coefficient gives for the remaining load.
double friction_offset(const Forces& forces, bool front) {
  const auto [begin, end] = forces.ends(front, no_load);
  if (end - begin < rows_without_contact) return 0;
  const auto [friction, scatter] = level_of(forces.friction.subspan(begin, end - begin));
  const double pressed = std::abs(level_of(forces.normal.subspan(begin, end - begin)).middle);
  const bool is_offset = std::abs(friction) > offset_share * forces.rubbing &&
                         std::abs(friction) > usual_mu * pressed &&
                         scatter < 0.5 * std::abs(friction);
  return is_offset ? friction : 0;
}

// Normal force while the contact slides without friction, if it is an offset; a load at rest may be
// real.
double normal_offset(const Forces& forces, bool front) {
  const auto [begin, end] = forces.ends(front, half_load);
  if (end - begin < rows_without_contact || forces.speed.empty()) return 0;
  const std::span<const double> speed = forces.speed.subspan(begin, end - begin);
  if (std::any_of(speed.begin(), speed.end(), [](double v) { return !(v > 0); })) return 0;
  const auto [normal, scatter] = level_of(forces.normal.subspan(begin, end - begin));
  const double friction = std::abs(level_of(forces.friction.subspan(begin, end - begin)).middle);
  const bool is_offset = normal > no_load * forces.load && scatter < offset_share * normal &&
                         friction < offset_share * normal * forces.rubbing / forces.load;
  return is_offset ? normal : 0;
}

// Finds force offsets: before or after contact a force should be zero, and an offset there is
// present under load as well.
Implausible force_offset(const Dataset& data) {
  std::size_t rows = 0, tests = 0;
  std::string first;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const Forces forces(data, e);
    for (const bool front : {true, false}) {
      const double friction = friction_offset(forces, front),
                   normal = Forces::are_given(data) ? normal_offset(forces, front) : 0;
      if (friction == 0 && normal == 0) continue;
      if (tests++ == 0)
        first = fmt::format("{} is {:.3g} {} {} contact in test '{}'",
                            Forces::name(data, friction != 0), friction != 0 ? friction : normal,
                            Forces::are_given(data) ? "N" : "MPa", front ? "before" : "after",
                            data.experiments[e]);
      rows += forces.normal.size();
      break; // once per test
    }
  }
  if (tests == 0) return {};
  return {"", rows, data.rows(), fmt::format("{}, not 0{}", first, and_more(tests - 1, "test")),
          "a zero point that was not set? Take it off where the force is mapped: "
          "{ formula = \"COLUMN - 3.2\" }, in the unit of the file"};
}

// Counts the rows with next to no friction at both ends of the part of a test under load.
std::size_t rows_without_friction(const Forces& forces) {
  const double rubs = quantile({forces.friction.begin(), forces.friction.end()}, 0.75);
  const auto is_still = [&](std::size_t i) {
    const double size = std::abs(forces.friction[i]);
    return size < still_share * rubs && size < still_mu * forces.normal[i] &&
           forces.normal[i] > half_load * forces.load;
  };
  const std::size_t rows = forces.normal.size(), first = forces.ends(true, half_load).second,
                    end = forces.ends(false, half_load).first;
  std::size_t front = 0, back = 0;
  while (first + front < rows && is_still(first + front))
    ++front;
  while (first + front + back < end && is_still(end - 1 - back))
    ++back;
  return (front >= rows_at_rest ? front : 0) + (back >= rows_at_rest ? back : 0);
}

// Whether the speed of a test is one value throughout, and its path only follows from it.
bool is_speed_set(const Dataset& data, std::size_t test) {
  constexpr double rounding = 1e-6;
  const std::size_t begin = data.first_row[test], end = data.first_row[test + 1];
  const auto speed = data.values("v_rel_mm_s").subspan(begin, end - begin);
  if (std::any_of(speed.begin(), speed.end(), [&](double v) { return v != speed[0]; }))
    return false;
  if (!data.has("s_mm") || !data.has("time_s")) return true;
  const auto path = data.values("s_mm"), time = data.values("time_s");
  for (std::size_t i = begin + 1; i < end; ++i) {
    const double way = speed[0] * (time[i] - time[i - 1]);
    if (!(std::abs(path[i] - path[i - 1] - way) <= rounding * (std::abs(path[i]) + way)))
      return false;
  }
  return true;
}

// Finds rows that may be at rest where no column shows motion.
Implausible no_motion(const Dataset& data) {
  const bool has_speed = data.has("v_rel_mm_s");
  if (!has_speed && data.has("s_mm") && data.has("time_s")) return {};
  std::size_t rows = 0, tests = 0;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    if (has_speed && !is_speed_set(data, e)) continue;
    const std::size_t found = rows_without_friction(Forces(data, e));
    rows += found;
    tests += found > 0;
  }
  if (tests == 0) return {};
  return {
      "",
      rows,
      data.rows(),
      fmt::format("next to no friction in the first or last rows of {}, under load, and {}: rows "
                  "at rest are fitted as sliding",
                  tests == 1 ? "a test" : thousands(tests) + " tests",
                  has_speed ? "v_rel_mm_s is one value throughout, a set one"
                            : "no column shows motion"),
      "map a measured v_rel_mm_s, or s_mm with time_s (an angle, a position, a distance), or "
      "leave such "
      "rows out with data.drop = { tau_R_MPa = { below = 1 } }",
      false};
}

Implausible test_apart(const Dataset& data) {
  const std::vector<TestApart> apart = find_tests_apart(data);
  if (apart.empty()) return {};
  std::size_t rows = 0;
  for (const TestApart& one : apart)
    rows += data.source_rows(one.test);
  return {
      "", rows, data.source_rows(),
      fmt::format("test '{}' stands apart: its friction is {:.2g} times what the other {} tests "
                  "say of its states{}",
                  data.experiments[apart.front().test], apart.front().factor,
                  data.experiments.size() - 1, and_more(apart.size() - 1, "test")),
      fmt::format("another unit, another lubricant, a failed test? data.drop = {{ experiment = "
                  "[\"{}\"] }} leaves it out",
                  data.experiments[apart.front().test])};
}

Implausible copied_test(const Dataset& data) {
  const auto same = tests_of_equal_rows(data, data);
  std::size_t rows = 0, copies = 0;
  std::string first;
  for (std::size_t e = 0; e < same.size(); ++e) {
    if (!same[e]) continue;
    rows += data.source_rows(e);
    if (*same[e] > e) continue; // the original of the copies
    if (copies++ > 0) continue;
    const std::size_t own = data.first_row[e + 1] - data.first_row[e],
                      other = data.first_row[*same[e] + 1] - data.first_row[*same[e]];
    const auto [part, whole] = std::pair(own <= other ? e : *same[e], own <= other ? *same[e] : e);
    first =
        fmt::format("test '{}' has the {}rows of test '{}', value by value", data.experiments[part],
                    own == other ? "" : fmt::format("first {} ", thousands(std::min(own, other))),
                    data.experiments[whole]);
  }
  if (copies == 0) return {};
  return {"", rows, data.source_rows(), first + and_more(copies - 1, "test"),
          "no test is measured twice alike: keep one (is a file there under two names?)"};
}

// ---- rows that no rig can measure ----

// Limits of spikes, explained in plausibility.h.
constexpr double spike_height = 1.5, spike_height_at_ends = 3, spike_scatter = 8;
constexpr std::size_t spike_rows = 3, spike_window = 11, rows_of_end = 5;

// Running medians of a test, its scatter about them, and its overall median.
struct Course {
  std::vector<double> middle;
  double scatter = 0, typical = 0;

  explicit Course(std::span<const double> values)
      : typical(median({values.begin(), values.end()})) {
    std::vector<double> off;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t begin =
          std::min(i - std::min(i, spike_window / 2), values.size() - spike_window);
      const auto near = values.subspan(begin, spike_window);
      middle.push_back(median({near.begin(), near.end()}));
      off.push_back(std::abs(values[i] - middle.back()));
    }
    scatter = std::max(1.4826 * median(std::move(off)), 1e-3 * typical);
  }
};

// Spikes among the rows of one test; `place`: row of each in its file.
std::vector<std::size_t> spikes_of(std::span<const double> tau, std::span<const double> pressure,
                                   std::span<const std::size_t> place) {
  std::vector<std::size_t> found;
  const std::size_t rows = tau.size();
  if (rows < 2 * spike_window) return found;
  const double typical = median({tau.begin(), tau.end()});
  if (!(typical > 0) ||
      std::none_of(tau.begin(), tau.end(), [&](double x) { return x > spike_height * typical; }))
    return found;
  const Course course(tau), load(pressure);
  const auto is_end = [&](std::size_t i) {
    return i < rows_of_end || i + rows_of_end >= rows ||
           place[i + rows_of_end] != place[i - rows_of_end] + 2 * rows_of_end;
  };
  const auto is_high = [&](std::size_t i) {
    const double height = is_end(i) ? spike_height_at_ends : spike_height;
    return tau[i] - course.middle[i] > spike_scatter * course.scatter &&
           tau[i] > height * std::max(course.middle[i], typical) &&
           tau[i] / pressure[i] > height * course.middle[i] / load.middle[i];
  };
  for (std::size_t i = 0; i < rows; ++i) {
    std::size_t end = i;
    while (end < rows && is_high(end))
      ++end;
    for (std::size_t j = i; end - i <= spike_rows && j < end; ++j)
      found.push_back(j);
    i = std::max(i, end);
  }
  return found;
}

// Upper limit of a test's scatter from row to row. If a whole test is above a limit, none of its
// rows stands out; the checks above report such a test.
double end_of_noise(std::span<const double> tau) {
  constexpr double deviations = 4;
  const double middle = median({tau.begin(), tau.end()});
  return tau.size() < spike_window ? spike_height * middle
                                   : middle + deviations * Course(tau).scatter;
}

// Finds nothing: such rows are left out during reading.
Implausible left_out_already(const Dataset&) {
  return {};
}

Implausible units_of_tests(const Dataset& data) {
  const Dataset* const one = &data;
  return mixed_units({&one, 1});
}

// Data that a check needs at once: any rows with its columns; whole tests, all of whose rows it
// counts; or a whole campaign.
enum class Sees { rows, tests, campaign };

struct Check {
  const char* name;
  Implausible (*find)(const Dataset& data);
  Sees sees;
};

constexpr Check checks[] = {{"no_friction", no_friction, Sees::campaign},
                            {"no_load", no_load_channel, Sees::rows},
                            {"pressure", pressure, Sees::rows},
                            {"friction_coefficient", friction_coefficient, Sees::rows},
                            {"high_coefficient", high_coefficient, Sees::rows},
                            {"no_coefficient", no_coefficient, Sees::tests},
                            {"shear_yield", shear_yield, Sees::rows},
                            {"spike", left_out_already, Sees::rows},
                            {"dropout", left_out_already, Sees::rows},
                            {"temperature", temperature, Sees::campaign},
                            {"speed", speed, Sees::rows},
                            {"sliding_speed", sliding_speed, Sees::rows},
                            {"elapsed_time", elapsed_time, Sees::tests},
                            {"sliding_path", sliding_path, Sees::tests},
                            {"flow_stress", normal_to_flow, Sees::campaign},
                            {"mixed_units", units_of_tests, Sees::campaign},
                            {"path", path, Sees::tests},
                            {"surface_expansion", surface_expansion, Sees::rows},
                            {"clipped_channel", clipped_channel, Sees::tests},
                            {"stuck_channel", stuck_channel, Sees::tests},
                            {"force_offset", force_offset, Sees::tests},
                            {"no_motion", no_motion, Sees::tests},
                            {"forces", forces, Sees::rows},
                            {"test_apart", test_apart, Sees::campaign},
                            {"copied_test", copied_test, Sees::campaign}};

const Implausible* counted_by(const Check& check, const std::vector<Implausible>& counted) {
  for (const Implausible& one : counted)
    if (one.check == check.name) return &one;
  return nullptr;
}

// Result over the present rows, or the count made before rows were left out, if that is larger.
Implausible found_in_rows(const Check& check, const Dataset& data) {
  Implausible found = check.find(data);
  const Implausible* const before = counted_by(check, data.counted);
  return before && before->rows > found.rows ? *before : found;
}

// Result for a campaign; for a condensed one, the count made before its rows were discarded.
Implausible found_by(const Check& check, const Dataset& data) {
  if (!data.condensed || check.sees == Sees::campaign) return found_in_rows(check, data);
  const Implausible* const counted = counted_by(check, data.condensed->implausible);
  return counted ? *counted : Implausible{};
}

} // namespace

std::vector<std::string> plausibility_checks() {
  std::vector<std::string> names;
  for (const Check& check : checks)
    names.emplace_back(check.name);
  return names;
}

std::vector<Implausible> find_implausible(const Dataset& data) {
  std::vector<Implausible> found;
  bool rubs = true;
  for (const Check& check : checks) {
    if (check.find == friction_coefficient && !rubs) continue; // reported already
    Implausible one = found_by(check, data);
    if (one.rows == 0) continue;
    if (check.find == no_friction) rubs = false;
    one.check = check.name;
    found.push_back(std::move(one));
  }
  return found;
}

void count_implausible(const Dataset& rows, std::vector<Implausible>& counted) {
  std::vector<Implausible> here;
  for (const Check& check : checks) {
    if (check.sees == Sees::campaign || rows.rows() == 0) continue;
    here.push_back(found_in_rows(check, rows));
    here.back().check = check.name;
    if (check.sees == Sees::tests) here.back().of = rows.rows();
  }
  merge_implausible(here, counted);
}

void merge_implausible(const std::vector<Implausible>& more, std::vector<Implausible>& counted) {
  for (const Implausible& one : more) {
    const auto known = std::find_if(counted.begin(), counted.end(), [&](const Implausible& other) {
      return other.check == one.check;
    });
    if (known == counted.end()) {
      counted.push_back(one);
      continue;
    }
    if (one.rows > known->rows) { // keeps the words of the part with most such rows
      known->what = one.what;
      known->hint = one.hint;
      known->certain = one.certain;
    }
    known->rows += one.rows;
    known->of += one.of;
  }
}

void count_unloaded(Dataset& data) {
  Implausible found = force_offset(data);
  found.check = "force_offset";
  if (found.rows > 0) data.counted = {std::move(found)};
}

std::vector<ImpossibleRow> impossible_rows(const Dataset& data, std::span<const std::size_t> place,
                                           const std::set<std::string>& allowed) {
  const auto tau = data.values("tau_R_MPa"), pressure = data.values("sigma_n_MPa");
  const auto flow = data.has("sigma_f_MPa") ? data.values("sigma_f_MPa") : tau;
  const bool by_yield = data.has("sigma_f_MPa") && allowed.count("shear_yield") == 0,
             by_coefficient = allowed.count("friction_coefficient") == 0;
  std::vector<ImpossibleRow> found;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t begin = data.first_row[e], rows = data.first_row[e + 1] - begin;
    std::vector<char> is_found(rows, 0);
    std::optional<double> usual; // usual coefficient, if computed
    std::optional<double> noise_ends;
    const auto beyond_noise = [&](double x) {
      if (!noise_ends) noise_ends = end_of_noise(tau.subspan(begin, rows));
      return std::abs(x) > *noise_ends;
    };
    const auto add = [&](std::size_t i, const char* check, double value) {
      found.push_back({i, check, value});
      is_found[i - begin] = 1;
    };
    for (std::size_t i = begin; i < begin + rows; ++i) {
      if (by_yield && above_shear_yield(tau[i], flow[i]) && beyond_noise(tau[i])) {
        add(i, "shear_yield", tau[i]);
      } else if (by_coefficient && pressure[i] > 0 && std::abs(tau[i]) > largest_mu * pressure[i]) {
        if (!usual) usual = median(coefficients(data, begin, begin + rows));
        const double mu = tau[i] / pressure[i];
        if (std::abs(mu) > spike_height * *usual && beyond_noise(tau[i]))
          add(i, "friction_coefficient", mu);
      }
    }
    for (const char* name : {"T_contact_C", "T_tool_C"}) {
      if (allowed.count("dropout") > 0 || !data.has(name)) continue;
      const auto temperature = data.values(name).subspan(begin, rows);
      for (const std::size_t i : dropouts_in(temperature))
        if (!is_found[i]) add(begin + i, "dropout", temperature[i]);
    }
    if (allowed.count("spike") > 0) continue;
    for (const std::size_t i : spikes_of(tau.subspan(begin, rows), pressure.subspan(begin, rows),
                                         place.subspan(begin, rows)))
      if (!is_found[i]) add(begin + i, "spike", tau[begin + i]);
  }
  std::sort(found.begin(), found.end(),
            [](const ImpossibleRow& a, const ImpossibleRow& b) { return a.row < b.row; });
  return found;
}

std::string impossible_text(const std::string& check) {
  if (check == "shear_yield") return "tau_R_MPa above the shear yield stress sigma_f_MPa/sqrt(3)";
  if (check == "spike") return "a spike: tau_R_MPa far above the rows around it";
  if (check == "dropout")
    return "a temperature that jumps to one value and back: a sensor that drops out";
  return fmt::format("tau_R_MPa/sigma_n_MPa above {} in size and far from that of its test",
                     largest_mu);
}

namespace {

// Whether what a check finds in some rows changes what is fitted, so that it is named first.
bool changes_results(const std::string& check) {
  return check == "test_apart" || check == "no_motion";
}

std::size_t rows_with_apart(const Dataset& data) {
  std::size_t rows = data.source_rows();
  for (const RowsApart& one : data.apart)
    rows += one.rows;
  return rows;
}

void tell(const Implausible& one, Dataset& data, const std::vector<std::string>& allowed,
          const Place& place, FaultList& faults) {
  const std::string text =
      fmt::format("{} ({} of {} rows)", one.what, thousands(one.rows), thousands(one.of));
  const bool is_allowed = std::find(allowed.begin(), allowed.end(), one.check) != allowed.end();
  if (one.most() && !is_allowed)
    faults.add(
        place, text,
        fmt::format("{}; if it is right: data.allow_implausible = [\"{}\"]", one.hint, one.check));
  else if (changes_results(one.check) && !is_allowed)
    data.cautions.push_back(one.what + "; " + one.hint);
  else // a finding that is only a note includes its hint
    data.implausible.push_back(one.certain && !is_allowed ? text + ": " + one.hint : text);
}

} // namespace

bool is_more_than_few(const RowsApart& apart, const Dataset& data) {
  constexpr double few = 0.05;
  return apart.check != "dropout" && // a sensor of its own, which says nothing of the stresses
         static_cast<double>(apart.rows) > few * static_cast<double>(rows_with_apart(data));
}

void check_plausibility(Dataset& data, const std::vector<std::string>& allowed, const Place& place,
                        FaultList& faults) {
  ask_for_units(data);
  for (const Implausible& one : find_implausible(data))
    tell(one, data, allowed, place, faults);
  for (const RowsApart& one : data.apart)
    if (is_more_than_few(one, data))
      faults.add(place,
                 fmt::format("{}: {} of {} rows, too many to leave out: {}", one.what,
                             thousands(one.rows), thousands(rows_with_apart(data)),
                             join(one.first, ", ")),
                 fmt::format("a stress or a force in another unit, or another column? If they are "
                             "right: data.allow_implausible = [\"{}\"]",
                             one.check));
}

void check_units_between(Dataset& training, const Dataset& validation,
                         const std::vector<std::string>& allowed, const Place& place,
                         FaultList& faults) {
  Implausible one = mixed_units(std::array<const Dataset*, 2>{&training, &validation});
  one.check = "mixed_units";
  const bool told = units_of_tests(training).rows + units_of_tests(validation).rows > 0;
  if (one.rows > 0 && !told) tell(one, training, allowed, place, faults);
}

} // namespace frictab::data
