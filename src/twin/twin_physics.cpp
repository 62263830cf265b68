// The physics of the synthetic tribometer: pressure build-up, surface expansion, heating, film wear
// and breakdown, real-contact saturation, shear limit. The equations are ours.
#include "twin/twin_physics.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace frictab::twin {

namespace {

// Slightly below the shear yield stress: the softest layer shears at less stress than the bulk.
constexpr double limit_share = 0.95;

// All influences except pressure, as one factor on mu.
double relative_friction(const TwinParameters& set, const TwinRow& now) {
  const double lv = std::log10(now.v_rel_mm_s / 50);
  const double lp = std::log(now.psi) / std::log(20.0);
  const double tn = (now.T_contact_C - 20) / 180;
  const double film = std::exp(-(now.s_mm / set.Lw) * (now.sigma_n_MPa / set.s_r) *
                               std::sqrt(now.psi / 4.5) * std::exp((now.T_contact_C - 110) / 120));
  const double breakdown = 1 / (1 + std::exp(-12 * (lp * tn - set.b)));
  const double rates =
      std::exp(-set.aT * (now.T_contact_C - 110) / 90 + set.av * lv - set.av2 * lv * lv +
               set.apsi * (lp - 0.5) + set.axv * lv * (tn - 0.5));
  return rates * (1 + set.rA * std::exp(-now.s_mm / set.rL)) * (1 + set.wA * (1 - film)) *
         (1 + set.bA * breakdown);
}

} // namespace

double round_to(double value, int decimals) {
  static constexpr double powers[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7};
  const double power = powers[std::clamp(decimals, 0, 7)];
  return std::round(value * power) / power;
}

double twin_tau(double tau0_MPa, double limit_MPa) {
  return limit_MPa * std::tanh(tau0_MPa / limit_MPa);
}

double profile_share(const TwinTest& test, double x) {
  switch (test.profile) {
  case TwinProfile::constant:
    return 1;
  case TwinProfile::ramp:
    return 0.3 + 0.7 * x;
  case TwinProfile::decay:
    return 1 - 0.7 * x;
  case TwinProfile::pulse:
    return 0.4 + 0.6 * std::exp(-0.5 * std::pow((x - test.pulse_at) / 0.1, 2));
  }
  return 1;
}

TwinRow twin_row(const TwinParameters& set, const TwinTest& test, std::size_t i, std::size_t n) {
  const double x = static_cast<double>(i) / static_cast<double>(n);
  TwinRow row{};
  row.v_rel_mm_s = test.v;
  row.T_tool_C = test.T_tool;
  row.s_mm = round_to(twin_stroke_mm * x, 4);
  row.time_s = round_to(row.s_mm / test.v, 7);
  const double drift = 1 + 0.10 * std::log(test.psi) / std::log(20.0) * (x - 0.5);
  const double level = std::max(500.0, test.p * (1 - std::exp(-x / 0.018)) * drift);
  row.sigma_n_MPa = round_to(level * profile_share(test, x), 2);
  row.psi = round_to(1 + (test.psi - 1) * (1 - std::exp(-x / 0.03)), 4);
  row.T_contact_C = round_to(test.T_tool + std::min(60.0, 0.5 * std::sqrt(test.v * row.s_mm)), 2);
  const double strain = 0.25 + 0.6 * std::log(row.psi);
  row.sigma_f_MPa =
      round_to(set.K * std::pow(strain / 0.9, 0.06) * (1 - 4e-4 * (test.T_tool - 20)), 2);

  // Real contact grows with pressure and saturates.
  const double contact = 1 - std::exp(-row.sigma_n_MPa / (set.c_s * set.s_r));
  const double reference = 1 - std::exp(-1 / set.c_s);
  row.tau0_MPa = set.mu0 * set.s_r * (contact / reference) * 0.72 * relative_friction(set, row);
  row.limit_MPa = limit_share * row.sigma_f_MPa / std::sqrt(3.0);
  return row;
}

std::span<const TwinParameters> twin_sets() {
  static const std::vector<TwinParameters> sets = {
      {.name = "D",
       .title = "soft low-carbon steel, narrow stress range (recommended)",
       .p_levels = {1725, 1865, 2005},
       .K = 441,
       .s_r = 1800,
       .c_s = 0.741,
       .mu0 = 0.0898,
       .aT = .214,
       .av = 0,
       .av2 = .0817,
       .apsi = .0916,
       .axv = .0306,
       .rA = .079,
       .rL = .83,
       .wA = .223,
       .Lw = 2.45,
       .bA = .158,
       .b = .59,
       .s_test = .0806,
       .s_ar = .0236},
      {.name = "W",
       .title = "soft low-carbon steel, wide stress range",
       .p_levels = {1220, 1820, 2420},
       .K = 387,
       .s_r = 1800,
       .c_s = 0.764,
       .mu0 = 0.0926,
       .aT = .075,
       .av = .0025,
       .av2 = .0857,
       .apsi = .066,
       .axv = .0431,
       .rA = .098,
       .rL = 1.09,
       .wA = .207,
       .Lw = 2.45,
       .bA = .103,
       .b = .516,
       .s_test = .0869,
       .s_ar = .0135},
      {.name = "B",
       .title = "unphysically hard material, kept for comparison",
       .p_levels = {949, 1087, 1226},
       .K = 1689,
       .s_r = 1090,
       .c_s = 0.593,
       .mu0 = 0.1576,
       .aT = .148,
       .av = .0095,
       .av2 = .0563,
       .apsi = .041,
       .axv = .0375,
       .rA = .097,
       .rL = .50,
       .wA = .134,
       .Lw = 1.39,
       .bA = .215,
       .b = .661,
       .s_test = .075,
       .s_ar = .0157}};
  return sets;
}

const TwinParameters& twin_set(std::string_view name) {
  std::vector<std::string> names;
  for (const TwinParameters& set : twin_sets()) {
    if (set.name == name) return set;
    names.push_back(set.name);
  }
  throw InputError({"--set-name"}, "unknown parameter set '" + std::string(name) + "'",
                   "known: " + join(names, ", "));
}

} // namespace frictab::twin
