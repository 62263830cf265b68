// Each check is a function from a campaign to what it found.
#include "data/plausibility.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::data {

namespace {

constexpr double least_mu = 0.001, largest_mu = 1;
// Above every flow stress of a metal, and every contact that metals bear.
constexpr double largest_pressure_MPa = 20000;
constexpr double largest_psi = 100;
constexpr double kelvin_low = 270, room_in_kelvin = 330;
// A factor between two units of speed, not between two ways to measure it.
constexpr double same_speed = 5;
// Noise lifts a stuck contact above its shear yield stress by less.
constexpr double above_yield = 1.15;
constexpr std::size_t stuck_rows = 20;
// Tests of a campaign differ, by what it varies; not by this much more than all others.
constexpr double apart = 3;
constexpr std::size_t tests_to_compare = 5;

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Of rows with a coefficient: under load.
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

Implausible friction_coefficient(const Dataset& data) {
  const std::vector<double> mu = coefficients(data, 0, data.rows());
  const double typical = median(mu);
  return {"", count(mu, [](double x) { return !(x >= least_mu && x <= largest_mu); }), mu.size(),
          fmt::format("tau_R_MPa/sigma_n_MPa is outside {} to {}, {:.3g} in the middle", least_mu,
                      largest_mu, typical),
          coefficient_hint(data, typical)};
}

Implausible pressure(const Dataset& data) {
  const auto values = data.values("sigma_n_MPa");
  return {"", count(values, [](double x) { return x > largest_pressure_MPa; }), values.size(),
          fmt::format("sigma_n_MPa is above {}", thousands(std::size_t(largest_pressure_MPa))),
          "contact normal stress in Pa or kPa? unit = \"Pa\" where it is mapped"};
}

Implausible shear_yield(const Dataset& data) {
  if (!data.has("sigma_f_MPa")) return {};
  const auto tau = data.values("tau_R_MPa"), flow = data.values("sigma_f_MPa");
  std::size_t rows = 0;
  for (std::size_t i = 0; i < tau.size(); ++i)
    rows += tau[i] > above_yield * flow[i] / std::sqrt(3.0);
  return {"", rows, tau.size(), "tau_R_MPa is above the shear yield stress sigma_f_MPa/sqrt(3)",
          "a flow stress in GPa or before hardening, or a shear stress in another unit?"};
}

Implausible temperature(const Dataset& data) {
  Implausible worst;
  for (const char* name : {"T_contact_C", "T_tool_C"}) {
    if (!data.has(name)) continue;
    const auto values = data.values(name);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (*low > kelvin_low && *low < room_in_kelvin)
      worst = {
          "", values.size(), values.size(),
          fmt::format("{} is {:.4g} to {:.4g}, and never below {}", name, *low, *high, kelvin_low),
          "a temperature in K? unit = \"K\" where it is mapped"};
  }
  return worst;
}

// Against the path: one that was integrated from the speed agrees with its mean over each row.
Implausible speed(const Dataset& data) {
  if (!data.has("s_mm") || !data.has("time_s") || !data.has("v_rel_mm_s")) return {};
  const auto path = data.values("s_mm"), time = data.values("time_s"),
             v = data.values("v_rel_mm_s");
  std::size_t rows = 0, of = 0;
  std::vector<double> ratios;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e] + 1; i < data.first_row[e + 1]; ++i) {
      const double moved = std::abs(path[i] - path[i - 1]), lasted = time[i] - time[i - 1];
      const double mean = 0.5 * (v[i - 1] + v[i]);
      if (!(lasted > 0) || !(moved > 0) || !(mean > 0)) continue;
      const double ratio = moved / lasted / mean;
      ratios.push_back(ratio);
      ++of;
      rows += ratio > same_speed || ratio < 1 / same_speed;
    }
  return {"", rows, of,
          fmt::format("s_mm grows {:.3g} times as fast as v_rel_mm_s says", median(ratios)),
          "a speed in m/s, a path in m or um, a time in ms? `unit` where it is mapped"};
}

Implausible surface_expansion(const Dataset& data) {
  if (!data.has("psi")) return {};
  const auto values = data.values("psi");
  return {"", count(values, [](double x) { return x > largest_psi; }), values.size(),
          fmt::format("psi is above {}", largest_psi),
          "a surface expansion in percent? unit = \"%\" where it is mapped"};
}

// Whether the load or the speed changes over these rows: a measured stress would not stay the same.
bool something_changes(const Dataset& data, std::size_t begin, std::size_t end) {
  for (const char* name : {"sigma_n_MPa", "F_N_N", "v_rel_mm_s"}) {
    if (!data.has(name)) continue;
    const auto values = data.values(name).subspan(begin, end - begin);
    if (std::any_of(values.begin(), values.end(), [&](double x) { return x != values[0]; }))
      return true;
  }
  return false;
}

// The same number again and again where others change: a channel that is stuck, or at its end.
Implausible stuck_channel(const Dataset& data) {
  Implausible out;
  out.of = data.rows();
  std::string where;
  for (const char* name : {"tau_R_MPa", "F_R_N"}) {
    if (!data.has(name)) continue;
    const auto values = data.values(name);
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      for (std::size_t i = data.first_row[e], end = data.first_row[e + 1], from = i; i < end; ++i) {
        if (i + 1 < end && values[i + 1] == values[from]) continue;
        if (i + 1 - from >= stuck_rows && something_changes(data, from, i + 1)) {
          if (where.empty()) where = fmt::format("{} in test '{}'", name, data.experiments[e]);
          out.rows += i + 1 - from;
        }
        from = i + 1;
      }
    if (out.rows > 0) break; // tau_R_MPa may come from F_R_N
  }
  out.what = fmt::format("the same value {} times in a row or more, while load or speed change: {}",
                         stuck_rows, where);
  out.hint = "a channel that is stuck or clipped, or a mean written in every row?";
  return out;
}

Implausible test_apart(const Dataset& data) {
  std::vector<std::pair<double, std::size_t>> tests;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    tests.emplace_back(median(coefficients(data, data.first_row[e], data.first_row[e + 1])), e);
  if (tests.size() < tests_to_compare) return {};
  std::sort(tests.begin(), tests.end());
  const auto told = [&](const auto& test, const char* than, double other) {
    const std::size_t e = test.second;
    return Implausible{
        "", data.first_row[e + 1] - data.first_row[e], data.rows(),
        fmt::format("test '{}' stands apart: coefficient {:.3g} in its middle, {} of all others "
                    "is {:.3g}",
                    data.experiments[e], test.first, than, other),
        "look at it before it is fitted: another unit, another lubricant, a failed test?"};
  };
  const std::size_t last = tests.size() - 1;
  if (tests[last].first > apart * tests[last - 1].first)
    return told(tests[last], "the largest", tests[last - 1].first);
  if (apart * tests[0].first < tests[1].first)
    return told(tests[0], "the smallest", tests[1].first);
  return {};
}

struct Check {
  const char* name;
  Implausible (*find)(const Dataset& data);
};

constexpr Check checks[] = {{"pressure", pressure},
                            {"friction_coefficient", friction_coefficient},
                            {"shear_yield", shear_yield},
                            {"temperature", temperature},
                            {"speed", speed},
                            {"surface_expansion", surface_expansion},
                            {"stuck_channel", stuck_channel},
                            {"test_apart", test_apart}};

} // namespace

std::vector<std::string> plausibility_checks() {
  std::vector<std::string> names;
  for (const Check& check : checks)
    names.emplace_back(check.name);
  return names;
}

std::vector<Implausible> find_implausible(const Dataset& data) {
  std::vector<Implausible> found;
  for (const Check& check : checks) {
    Implausible one = check.find(data);
    if (one.rows == 0) continue;
    one.check = check.name;
    found.push_back(std::move(one));
  }
  return found;
}

void check_plausibility(Dataset& data, const std::vector<std::string>& allowed, const Place& place,
                        FaultList& faults) {
  for (const Implausible& one : find_implausible(data)) {
    const std::string text =
        fmt::format("{} ({} of {} rows)", one.what, thousands(one.rows), thousands(one.of));
    const bool is_allowed = std::find(allowed.begin(), allowed.end(), one.check) != allowed.end();
    if (one.most() && !is_allowed)
      faults.add(place, text,
                 fmt::format("{}; if it is right: data.allow_implausible = [\"{}\"]", one.hint,
                             one.check));
    else
      data.implausible.push_back(text);
  }
}

} // namespace frictab::data
