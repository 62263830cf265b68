// The physics of the synthetic tribometer: one sliding compression test without noise.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frictab::twin {

// A parameter set of the twin. Tuned (by us) so that laws calibrated on it err about as much as the
// published ones do on measured data; it does not describe a measured material.
struct TwinParameters {
  std::string name;
  std::string title;
  std::array<double, 3> p_levels; // MPa, nominal contact normal stress of the factorial
  double K;                       // MPa, flow stress at strain 0.9 and 20 degC
  double s_r, c_s;                // MPa, 1: reference pressure and range of real-contact saturation
  double mu0;                     // coefficient of friction at s_r
  double aT, av, av2, apsi, axv;  // temperature, speed, speed^2, expansion, speed x temperature
  double rA, rL;                  // run-in: height and length in mm
  double wA, Lw;                  // film wear: height and length in mm
  double bA, b;                   // film breakdown when hot and stretched: height and position
  double s_test, s_ar;            // hidden factor per test, autocorrelated noise (standard dev.)
};

// Noise common to all sets.
inline constexpr double twin_ar_rho = 0.97; // correlation from row to row
inline constexpr double twin_white = 0.025; // white noise, relative standard deviation

std::span<const TwinParameters> twin_sets();
// Returns the set of this name. Throws InputError naming the known sets.
const TwinParameters& twin_set(std::string_view name);

// Contact normal stress over the stroke, as a share of the test's level.
enum class TwinProfile { constant, ramp, decay, pulse };

// One test: nominal stress in MPa, final expansion ratio, mm/s, degC.
struct TwinTest {
  double p, psi, v, T_tool;
  TwinProfile profile = TwinProfile::constant;
  double pulse_at = 0.5; // position of the pulse, as a share of the stroke
};

// Share of the level at position x (0 .. 1) of the stroke: always 1, or between 0.3 and 1.
double profile_share(const TwinTest& test, double x);

// State at one row, rounded as an instrument would record it, and the two pieces of the law:
// tau = limit * tanh(tau0 / limit).
struct TwinRow {
  double time_s, sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, T_tool_C, s_mm, sigma_f_MPa;
  double tau0_MPa, limit_MPa;
};

inline constexpr double twin_stroke_mm = 20;

// Computes row i of n of a test over a stroke of 20 mm.
TwinRow twin_row(const TwinParameters& set, const TwinTest& test, std::size_t i, std::size_t n);

// Returns limit * tanh(tau0 / limit), MPa.
double twin_tau(double tau0_MPa, double limit_MPa);

// Keeps `decimals` digits after the point.
double round_to(double value, int decimals);

} // namespace frictab::twin
