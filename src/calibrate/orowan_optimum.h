// Exact least squares for tau_R = min(mu sigma_N, m k).
#pragma once

#include <span>
#include <vector>

namespace frictab::calibrate {

// Rows of a campaign: contact normal stress, shear yield stress, measured shear stress in MPa.
struct OrowanRows {
  std::span<const double> sigma_n;
  std::span<const double> k;
  std::span<const double> tau;
  std::span<const double> weights = {}; // in the sum of squares; empty: equal
};

struct OrowanPoint {
  double mu = 0;
  double m = 0;
};

// Returns points {mu, m} in [0,1]^2. The first is the global optimum: between two neighbours in the
// order of sigma_N/k the sum of squares is a quadratic in mu plus one in m, so its minimum on that
// wedge has a closed form, and prefix sums give all wedges in one pass. The others are the best
// points with the kink m/mu at `breaks` places, evenly spaced in the rows, as starts for other
// losses.
std::vector<OrowanPoint> orowan_optimum(const OrowanRows& rows, std::size_t breaks);

} // namespace frictab::calibrate
