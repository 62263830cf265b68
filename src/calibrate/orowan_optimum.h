// Least squares for tau_R = min(mu sigma_N, m k), exactly.
#pragma once

#include <span>
#include <vector>

namespace frictab::calibrate {

// Rows of a campaign: contact normal stress, shear yield stress, measured shear stress in MPa.
struct OrowanRows {
  std::span<const double> sigma_n;
  std::span<const double> k;
  std::span<const double> tau;
  std::span<const double> weights = {}; // in the sum of squares; empty: all alike
};

struct OrowanPoint {
  double mu = 0;
  double m = 0;
};

// {mu, m} in [0,1]^2. The first is the global optimum: between two neighbours in the order of
// sigma_N/k the sum of squares is a quadratic in mu plus one in m, so its least value on that wedge
// is known in closed form, and prefix sums give all wedges in one pass. The others are the best
// points at `breaks` evenly spaced places of the kink m/mu, as starts for other losses.
std::vector<OrowanPoint> orowan_optimum(const OrowanRows& rows, std::size_t breaks);

} // namespace frictab::calibrate
