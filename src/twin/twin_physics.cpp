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

struct State {
  double sigma_n, psi, v, T_contact, T_tool, s, sigma_f;
};

// All influences except pressure, as one factor on mu.
double relative_friction(const TwinParameters& set, const State& now) {
  const double lv = std::log10(now.v / 50);
  const double lp = std::log(now.psi) / std::log(20.0);
  const double tn = (now.T_contact - 20) / 180;
  const double film = std::exp(-(now.s / set.Lw) * (now.sigma_n / set.s_r) *
                               std::sqrt(now.psi / 4.5) * std::exp((now.T_contact - 110) / 120));
  const double breakdown = 1 / (1 + std::exp(-12 * (lp * tn - set.b)));
  const double rates =
      std::exp(-set.aT * (now.T_contact - 110) / 90 + set.av * lv - set.av2 * lv * lv +
               set.apsi * (lp - 0.5) + set.axv * lv * (tn - 0.5));
  return rates * (1 + set.rA * std::exp(-now.s / set.rL)) * (1 + set.wA * (1 - film)) *
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
  State now{};
  now.v = test.v;
  now.T_tool = test.T_tool;
  now.s = round_to(twin_stroke_mm * x, 4);
  const double drift = 1 + 0.10 * std::log(test.psi) / std::log(20.0) * (x - 0.5);
  const double level = std::max(500.0, test.p * (1 - std::exp(-x / 0.018)) * drift);
  now.sigma_n = round_to(level * profile_share(test, x), 2);
  now.psi = round_to(1 + (test.psi - 1) * (1 - std::exp(-x / 0.03)), 4);
  now.T_contact = round_to(test.T_tool + std::min(60.0, 0.5 * std::sqrt(test.v * now.s)), 2);
  const double strain = 0.25 + 0.6 * std::log(now.psi);
  now.sigma_f = round_to(set.K * std::pow(strain / 0.9, 0.06) * (1 - 4e-4 * (test.T_tool - 20)), 2);

  // Real contact grows with pressure and saturates.
  const double contact = 1 - std::exp(-now.sigma_n / (set.c_s * set.s_r));
  const double reference = 1 - std::exp(-1 / set.c_s);
  TwinRow row{};
  row.tau0_MPa = set.mu0 * set.s_r * (contact / reference) * 0.72 * relative_friction(set, now);
  row.limit_MPa = limit_share * now.sigma_f / std::sqrt(3.0);
  row.time_s = round_to(now.s / test.v, 7);
  row.sigma_n_MPa = now.sigma_n;
  row.psi = now.psi;
  row.v_rel_mm_s = test.v;
  row.T_contact_C = now.T_contact;
  row.T_tool_C = test.T_tool;
  row.s_mm = now.s;
  row.sigma_f_MPa = now.sigma_f;
  return row;
}

std::span<const TwinParameters> twin_sets() {
  static const std::vector<TwinParameters> sets = {
      {"D",
       "soft low-carbon steel, narrow stress range (recommended)",
       {1725, 1865, 2005},
       441,
       1800,
       0.741,
       0.0898,
       .214,
       0,
       .0817,
       .0916,
       .0306,
       .079,
       .83,
       .223,
       2.45,
       .158,
       .59,
       .0806,
       .0236},
      {"W",
       "soft low-carbon steel, wide stress range",
       {1220, 1820, 2420},
       387,
       1800,
       0.764,
       0.0926,
       .075,
       .0025,
       .0857,
       .066,
       .0431,
       .098,
       1.09,
       .207,
       2.45,
       .103,
       .516,
       .0869,
       .0135},
      {"B",
       "unphysically hard material, kept for comparison",
       {949, 1087, 1226},
       1689,
       1090,
       0.593,
       0.1576,
       .148,
       .0095,
       .0563,
       .041,
       .0375,
       .097,
       .50,
       .134,
       1.39,
       .215,
       .661,
       .075,
       .0157}};
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
