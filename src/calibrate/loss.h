// The three losses of a residual r in MPa: L2 r^2/2, Huber, and L1 smoothed to sqrt(r^2+eps^2).
#pragma once

#include <cmath>

#include "job/job.h"

namespace frictab {

// How sharply L1 is rounded off at 0 in the end: far below any tribometer's resolution.
constexpr double smallest_rounding_MPa = 0.003;

struct LossFunction {
  Loss kind = Loss::l2;
  double width_MPa = 10; // Huber: where it turns linear; L1: eps, where it is rounded off

  double cost(double r) const {
    switch (kind) {
    case Loss::l2:
      return 0.5 * r * r;
    case Loss::l1:
      return std::sqrt(r * r + width_MPa * width_MPa);
    case Loss::huber:
      return std::abs(r) <= width_MPa ? 0.5 * r * r : width_MPa * (std::abs(r) - 0.5 * width_MPa);
    }
    return 0;
  }
  // Weight of iteratively reweighted least squares: cost'(r)/r.
  double weight(double r) const {
    switch (kind) {
    case Loss::l2:
      return 1;
    case Loss::l1:
      return 1 / std::sqrt(r * r + width_MPa * width_MPa);
    case Loss::huber:
      return std::abs(r) <= width_MPa ? 1 : width_MPa / std::abs(r);
    }
    return 0;
  }
  double curvature(double r) const {
    switch (kind) {
    case Loss::l2:
      return 1;
    case Loss::l1: {
      const double s = std::sqrt(r * r + width_MPa * width_MPa);
      return width_MPa * width_MPa / (s * s * s);
    }
    case Loss::huber:
      return std::abs(r) <= width_MPa ? 1 : 0;
    }
    return 0;
  }
};

} // namespace frictab
