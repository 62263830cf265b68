#include "reference.h"

#include <cmath>

namespace {

constexpr int radial_points = 400, increments = 400;

// The power J/(2 pi) per V, sigma_f and unit of the height's rate.
double power(const RingSize& ring, double c, double m) {
  const double width = (ring.outer_radius - ring.inner_radius) / radial_points;
  double sum = 0;
  for (int i = 0; i < radial_points; ++i) {
    const double r = ring.inner_radius + (i + 0.5) * width, squared = c / (r * r);
    // Strain rates by h/V: radial (1 + c/r^2)/2, hoop (1 - c/r^2)/2, axial -1.
    const double rate = std::sqrt(1 + squared * squared / 3);
    const double friction = m / std::sqrt(3.0) * std::abs(r - c / r) / ring.height;
    sum += (rate + friction) * r * width;
  }
  return sum;
}

// Golden section: the power is convex in c.
double best_field(const RingSize& ring, double m) {
  const double golden = 0.6180339887498949, outer = ring.outer_radius * ring.outer_radius;
  double low = -3 * outer, high = outer;
  while (high - low > 1e-9 * outer) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (power(ring, a, m) < power(ring, b, m))
      high = b;
    else
      low = a;
  }
  return 0.5 * (low + high);
}

} // namespace

RingSize frictionless_ring(RingSize start, double reduction) {
  const double wider = 1 / std::sqrt(1 - reduction);
  return {start.inner_radius * wider, start.outer_radius * wider, start.height * (1 - reduction)};
}

double frictionless_force(RingSize start, double reduction, const Material& material) {
  const RingSize now = frictionless_ring(start, reduction);
  const double area =
      M_PI * (now.outer_radius * now.outer_radius - now.inner_radius * now.inner_radius);
  return material.flow_stress(-std::log(1 - reduction), 20) * area / 1e3;
}

RingSize avitzur_ring(RingSize start, double reduction, double m) {
  RingSize ring = start;
  for (int i = 0; i < increments; ++i) {
    const double share = reduction * start.height / increments / ring.height; // of the height
    const double c = best_field(ring, m);
    // The field conserves r^2 - c over a step: d(r^2)/dh = -(r^2 - c)/h.
    for (double* r : {&ring.inner_radius, &ring.outer_radius})
      *r = std::sqrt(c + (*r * *r - c) / (1 - share));
    ring.height *= 1 - share;
  }
  return ring;
}
