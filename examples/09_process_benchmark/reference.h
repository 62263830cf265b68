// What the finite elements are compared with: solutions that need none.
//
// No friction: the ring stays a ring. Rigid-plastic, so that the volume stays,
//   r = r0/sqrt(1 - reduction),   F = sigma_f(ln(h0/h)) pi (ro^2 - ri^2).
//
// Shear friction m: Avitzur's upper bound without bulge (Metal Forming: Processes and Analysis,
// 1968). The admissible field of a flat ring under platens that close with speed V is
//   v_z = -V z/h,   v_r = V/(2 h) (r - c/r);
// c is the square of the neutral radius, below 0 where all metal flows outwards.
// The c that costs the least power
//   J = int sigma_f eps dV + 2 int m sigma_f/sqrt(3) |v_r| dA
// is taken, the ring is compressed by a small step with it, and so on; sigma_f cancels.
#pragma once

#include "material.h"

struct RingSize {
  double inner_radius, outer_radius, height; // mm
};

RingSize frictionless_ring(RingSize start, double reduction);
double frictionless_force(RingSize start, double reduction, const Material& material); // kN
RingSize avitzur_ring(RingSize start, double reduction, double m);
